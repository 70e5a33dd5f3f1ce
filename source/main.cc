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
#include <map>
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
    std::string              scene_file;
    std::string              directory_to_resume;
    std::vector<std::string> overrides;
    bool force = false, check = false, print_parameters = false, help = false,
         version           = false;
    unsigned int n_jobs    = 0; ///< 0: as many as processors
    unsigned int n_threads = 0; ///< 0: as many as processors
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
  read_words(const std::vector<std::string> &words)
  {
    Arguments                           arguments;
    const std::map<std::string, bool *> flags{{"--help", &arguments.help},
                                              {"-h", &arguments.help},
                                              {"--version", &arguments.version},
                                              {"--check", &arguments.check},
                                              {"--print-parameters",
                                               &arguments.print_parameters},
                                              {"--force", &arguments.force}};
    for (auto word = words.begin(); word != words.end(); ++word)
      {
        const std::string option = *word;
        const auto        value  = [&](const std::string &what) {
          const std::string text = word + 1 == words.end() ? "" : *++word;
          if (text.empty() && !what.empty())
            refuse_usage(option + " needs " + what);
          return text;
        };
        if (flags.count(option) > 0)
          *flags.at(option) = true;
        else if (option == "--set")
          arguments.overrides.push_back(value("ENTRY=VALUE"));
        else if (option == "--resume")
          arguments.directory_to_resume = value("the directory of a run");
        else if (option == "--jobs")
          arguments.n_jobs = read_number(option, value(""));
        else if (option == "--threads")
          arguments.n_threads = read_number(option, value(""));
        else if (option.size() > 1 && option[0] == '-')
          refuse_usage("unknown option '" + option + "'");
        else if (!arguments.scene_file.empty())
          refuse_usage("one scene at a time: '" + arguments.scene_file +
                       "' or '" + option + "'?");
        else
          arguments.scene_file = option;
      }
    return arguments;
  }



  Arguments
  read_arguments(const std::vector<std::string> &words)
  {
    const Arguments arguments = read_words(words);
    const bool      resumes   = !arguments.directory_to_resume.empty();
    if (resumes && (arguments.check || arguments.print_parameters ||
                    arguments.force || arguments.n_jobs > 0))
      refuse_usage("--resume goes with SCENE.prm, --set and --threads only");
    const bool needs_no_scene =
      resumes || arguments.help || arguments.version ||
      (arguments.print_parameters && arguments.overrides.empty());
    if (arguments.scene_file.empty() && !needs_no_scene)
      refuse_usage("no scene file is given");
    return arguments;
  }



  /** @p n, or the number of processors if that is 0. */
  unsigned int
  or_processors(const unsigned int n)
  {
    return n > 0 ? n : std::max(1U, std::thread::hardware_concurrency());
  }



  void
  run_study(const std::vector<Debond::SceneEntry> &entries,
            const Arguments                       &arguments)
  {
    Debond::Study study(entries, arguments.scene_file);
    if (arguments.check)
      return study.check(std::cout);
    const unsigned int n_jobs = or_processors(arguments.n_jobs);
    Debond::set_number_of_threads(arguments.n_threads > 0 ?
                                    arguments.n_threads :
                                    std::max(1U, or_processors(0) / n_jobs));
    Debond::catch_interruptions();
    study.run(n_jobs, arguments.force, std::cout);
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
    Debond::set_number_of_threads(or_processors(arguments.n_threads));
    Debond::catch_interruptions();
    Debond::DebondingProblem(run->scene).resume(run->checkpoint);
  }



  void
  act(const Arguments &arguments)
  {
    if (arguments.help)
      {
        std::cout << help_text;
        return;
      }
    if (arguments.version)
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
    if (Debond::is_study(entries) && !arguments.print_parameters)
      return run_study(entries, arguments);

    Debond::Scene scene =
      Debond::Scene::from_entries(entries, arguments.scene_file);
    if (arguments.print_parameters)
      return Debond::print_parameters(std::cout, &scene);

    Debond::set_number_of_threads(or_processors(arguments.n_threads));
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
    if (arguments.check)
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
  const auto end_with = [](const int code, const std::string &message) {
    std::cerr << message << std::endl;
    return code;
  };
  Debond::set_up_libraries();
  try
    {
      act(read_arguments({argv + 1, argv + argc}));
      return 0;
    }
  catch (const Debond::InputError &error)
    {
      return end_with(1, error.what());
    }
  catch (const Debond::Interrupted &error)
    {
      return end_with(128 + error.signal, error.what());
    }
  catch (const Debond::RunError &error)
    {
      return end_with(2, error.what());
    }
  catch (const dealii::ExceptionBase &error)
    {
      return end_with(3, "debond: internal error: " + one_line(error));
    }
  catch (const std::bad_alloc &)
    {
      return end_with(2, std::string("debond: ") + Debond::out_of_memory);
    }
  catch (const std::exception &error)
    {
      return end_with(3,
                      std::string("debond: internal error: ") + error.what());
    }
}
