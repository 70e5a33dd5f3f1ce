#include <debond/campaigns/run_scene.h>
#include <debond/campaigns/study.h>
#include <debond/input/parameter_loop.h>
#include <debond/models/debonding_problem.h>
#include <debond/models/memory_estimate.h>
#include <debond/models/resumed_run.h>
#include <debond/scene/scene.h>
#include <debond/support/input_error.h>
#include <debond/support/interruption.h>
#include <debond/support/runtime.h>

#include <deal.II/base/config.h>
#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace
{
  const char *const help_text =
    R"(usage: debond [OPTIONS] SCENE.prm
       debond --resume DIR [OPTIONS] [SCENE.prm]

Simulates the tangential debonding of an implant from bone as the scene file
describes it, and writes torque curve, summary and fields into the directory
that the scene names. A scene whose entries hold several values, {{a|b|c}}, is a
study: all variants are run and gathered in study.csv.

  --set ENTRY=VALUE   override an entry of the scene; may be repeated
                      --set "Interface/Penalty stiffness=1800"
  --force             write into a directory that holds results of another
                      scene, or the checkpoint of an interrupted run, which is
                      lost then; run variants of a study again that are done
  --resume DIR        go on with the interrupted run whose results are in DIR, from
                      its last checkpoint; with SCENE.prm only if that is the
                      same scene
  --jobs N            run N variants of a study at a time (default: as many as
                      there are processors)
  --threads N         use N threads (default: as many as there are processors, in
                      a study shared among the variants that run at a time)
  --check             read the scene, build the meshes, say what to expect, and
                      run nothing
  --print-parameters  print all entries with documentation and values: those of
                      SCENE.prm, or the defaults if no scene is given
  --help              print this text
  --version           print the version

SIGINT, SIGTERM and SIGHUP end a run after the step at work and leave a checkpoint
for --resume; a second one ends it at once.

Exit codes: 0 success, 1 wrong usage or scene, 2 the run failed or its files could
not be written, 3 internal error, 128 + N interrupted by signal N.
)";



  struct Arguments
  {
    enum class Action
    {
      run,
      check,
      print_parameters,
      help,
      version
    };
    Action                   action = Action::run;
    std::string              scene_file;
    std::string              directory_to_resume;
    std::vector<std::string> overrides;
    bool                     force     = false;
    unsigned int             n_jobs    = 0; ///< 0: as many as processors
    unsigned int             n_threads = 0; ///< 0: as many as processors
  };



  [[noreturn]] void
  refuse_usage(const std::string &message)
  {
    throw Debond::InputError("debond: " + message + " (see debond --help)");
  }



  unsigned int
  read_number(const std::string &option, const std::string &word)
  {
    if (word.empty() || word.size() > 4 ||
        word.find_first_not_of("0123456789") != std::string::npos ||
        std::stoi(word) == 0)
      refuse_usage(option + " needs a whole number from 1 to 9999, not '" +
                   word + "'");
    return std::stoi(word);
  }



  Arguments
  read_arguments(const std::vector<std::string> &words)
  {
    using Action = Arguments::Action;
    Arguments arguments;
    for (std::size_t i = 0; i < words.size(); ++i)
      {
        const std::string &word = words[i];
        if (word == "--help" || word == "-h")
          arguments.action = Action::help;
        else if (word == "--version")
          arguments.action = Action::version;
        else if (word == "--check")
          arguments.action = Action::check;
        else if (word == "--print-parameters")
          arguments.action = Action::print_parameters;
        else if (word == "--force")
          arguments.force = true;
        else if (word == "--set")
          {
            if (i + 1 == words.size())
              refuse_usage("--set needs ENTRY=VALUE");
            arguments.overrides.push_back(words[++i]);
          }
        else if (word == "--resume")
          {
            if (i + 1 == words.size() || words[i + 1].empty())
              refuse_usage("--resume needs the directory of a run");
            arguments.directory_to_resume = words[++i];
          }
        else if (word == "--jobs" || word == "--threads")
          (word == "--jobs" ? arguments.n_jobs : arguments.n_threads) =
            read_number(word, i + 1 == words.size() ? "" : words[++i]);
        else if (word.size() > 1 && word[0] == '-')
          refuse_usage("unknown option '" + word + "'");
        else if (!arguments.scene_file.empty())
          refuse_usage("one scene at a time: '" + arguments.scene_file +
                       "' or '" + word + "'?");
        else
          arguments.scene_file = word;
      }

    const bool resumes     = !arguments.directory_to_resume.empty();
    const bool needs_scene = !resumes && (arguments.action == Action::run ||
                                          arguments.action == Action::check ||
                                          !arguments.overrides.empty());
    if (resumes && (arguments.action == Action::check ||
                    arguments.action == Action::print_parameters ||
                    arguments.force || arguments.n_jobs > 0))
      refuse_usage("--resume goes with SCENE.prm, --set and --threads only");
    if (needs_scene && arguments.scene_file.empty() &&
        arguments.action != Action::help && arguments.action != Action::version)
      refuse_usage("no scene file is given");
    return arguments;
  }



  unsigned int
  n_processors()
  {
    return std::max(1U, std::thread::hardware_concurrency());
  }



  void
  run_study(const std::vector<Debond::SceneEntry> &entries,
            const Arguments                       &arguments)
  {
    Debond::Study study(entries, arguments.scene_file);
    if (arguments.action == Arguments::Action::check)
      study.check(std::cout);
    else
      {
        const unsigned int n_jobs =
          arguments.n_jobs > 0 ? arguments.n_jobs : n_processors();
        Debond::set_number_of_threads(arguments.n_threads > 0 ?
                                        arguments.n_threads :
                                        std::max(1U, n_processors() / n_jobs));
        Debond::catch_interruptions();
        study.run(n_jobs, arguments.force, std::cout);
      }
  }



  void
  set_threads(const Arguments &arguments)
  {
    Debond::set_number_of_threads(
      arguments.n_threads > 0 ? arguments.n_threads : n_processors());
  }



  void
  resume(const Arguments &arguments)
  {
    const auto run = Debond::find_interrupted_run(arguments.directory_to_resume,
                                                  arguments.scene_file,
                                                  arguments.overrides);
    if (!run)
      {
        std::cout << "The run in " << arguments.directory_to_resume
                  << " is finished: there is nothing to go on with\n";
        return;
      }
    for (const std::string &remark : run->remarks)
      std::cout << "warning: " << remark << ", the other checkpoint is used\n";
    set_threads(arguments);
    Debond::catch_interruptions();
    Debond::DebondingProblem(run->scene).resume(run->checkpoint);
  }



  void
  act(const Arguments &arguments)
  {
    using Action = Arguments::Action;
    if (arguments.action == Action::help)
      {
        std::cout << help_text;
        return;
      }
    if (arguments.action == Action::version)
      {
        std::cout << "debond " << DEBOND_VERSION << " (deal.II "
                  << DEAL_II_PACKAGE_VERSION << ")\n";
        return;
      }
    if (!arguments.directory_to_resume.empty())
      return resume(arguments);
    if (arguments.scene_file.empty())
      return Debond::print_parameters(std::cout);

    const std::vector<Debond::SceneEntry> entries =
      Debond::with_overrides(Debond::read_scene_file(arguments.scene_file),
                             arguments.overrides);
    if (Debond::is_study(entries) &&
        arguments.action != Action::print_parameters)
      return run_study(entries, arguments);

    Debond::Scene scene =
      Debond::Scene::from_entries(entries, arguments.scene_file);
    if (arguments.action == Action::print_parameters)
      return Debond::print_parameters(std::cout, &scene);

    set_threads(arguments);
    for (const auto &[is_set, name] :
         {std::make_pair(scene.study.repetitions > 1, "Repetitions"),
          std::make_pair(scene.study.factors_at_once > 0,
                         "Factors varied at once")})
      if (is_set)
        throw scene.with_place(Debond::EntryError(
          std::string("Study / ") + name,
          "this is for studies, and no entry of this scene holds several "
          "values, {{a|b}}"));
    scene.output.overwrite_other_results = arguments.force;
    if (arguments.action == Action::check)
      return Debond::check_scene(scene, std::cout);
    // the closed forms are done before they could be asked to stop
    if (scene.model == Debond::ModelKind::finite_elements ||
        scene.model == Debond::ModelKind::automatic)
      Debond::catch_interruptions();
    Debond::run_scene(scene);
  }



  /** deal.II's account of an error in one line. */
  std::string
  one_line(const dealii::ExceptionBase &error)
  {
    std::stringstream text;
    error.print_info(text);
    std::string line = error.get_exc_name(), word;
    while (text >> word)
      line += " " + word;
    return line;
  }
} // namespace



int
main(int argc, char *argv[])
{
  Debond::set_up_libraries();
  try
    {
      act(read_arguments({argv + 1, argv + argc}));
      return 0;
    }
  catch (const Debond::InputError &error)
    {
      std::cerr << error.what() << std::endl;
      return 1;
    }
  catch (const Debond::Interrupted &error)
    {
      std::cerr << error.what() << std::endl;
      return 128 + error.signal;
    }
  catch (const Debond::RunError &error)
    {
      std::cerr << error.what() << std::endl;
      return 2;
    }
  catch (const dealii::ExceptionBase &error)
    {
      std::cerr << "debond: internal error: " << one_line(error) << std::endl;
      return 3;
    }
  catch (const std::bad_alloc &)
    {
      std::cerr << "debond: " << Debond::out_of_memory << std::endl;
      return 2;
    }
  catch (const std::exception &error)
    {
      std::cerr << "debond: internal error: " << error.what() << std::endl;
      return 3;
    }
}
