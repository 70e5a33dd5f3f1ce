#include <debond/campaigns/accurate_run.h>
#include <debond/campaigns/run_scene.h>
#include <debond/input/input_file.h>
#include <debond/models/resumed_run.h>
#include <debond/output/reference_comparison.h>
#include <debond/output/result_files.h>
#include <debond/scene/scene.h>
#include <debond/support/input_error.h>
#include <debond/support/interruption.h>
#include <debond/support/laboratory.h>
#include <debond/support/number_text.h>
#include <debond/support/processor.h>
#include <debond/support/progress.h>
#include <debond/support/provenance.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>
#include <debond/system/memory_estimate.h>

#include <deal.II/base/config.h>
#include <deal.II/base/exceptions.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <map>
#include <new>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

// The program: words of the command line become a scene, and the scene is run.
// All that is known of implants, contact and friction is in the library; this
// file decides which part of it is asked for, and turns what went wrong into an
// exit code that scripts can count on.
//
// What belongs to a model is nowhere here. A program of one's own can do
// without this file: it makes a Scene, gives it to a Simulation and looks at
// the rows (doc/example/torque_curve.cc).
using namespace Debond;


namespace
{
  // <h3>The command line</h3>
  //
  // What is said here is all that a user has to know to begin with; the entries
  // of a scene explain themselves with --print-parameters.
  //
  // Options change how a run is done, not what is computed: threads, jobs, the
  // directory that may be written to. All that changes a result is an entry of
  // the scene, and so is in the parameters.prm beside the results. --set is no
  // exception, as what it sets becomes an entry.
  const char *const help_text =
    R"(usage: debond [OPTIONS] SCENE.prm
       debond --resume DIR [OPTIONS] [SCENE.prm]
       debond --compare DIR CURVE [--columns LIST] [--over COLUMN]
       debond --report DIR

Simulates how an implant comes off bone, as the scene file describes it, and
writes curves, summary and fields into the directory that the scene names. A
scene whose entries hold several values, {{a|b|c}}, is a study: all variants are
run and gathered in study.csv. `mpirun -np N debond ...` deals a large bone out
among N processes.

  --set ENTRY=VALUE   override an entry of the scene; may be repeated
                      --set "Interface/Normal stiffness=1800"
  --force             write into a directory that holds results of another
                      scene, or the checkpoint of an interrupted run, which is
                      lost then; run variants of a study again that are done
  --resume DIR        go on with the interrupted run whose results are in DIR, from
                      its last checkpoint; with SCENE.prm or --set only if that
                      is the same scene, or one that goes on to later times
  --compare DIR CURVE compare the curves in DIR, of a run, a study or an ensemble,
                      with a measured one; nothing is run
  --columns LIST      which columns of CURVE are angle and torque, as Output /
                      Reference columns: "2 [deg], 3 [N m]"; with
                      "3 [-N m]" torques of the other sign
  --over COLUMN       compare over machine_angle_deg or machine_uz_mm, where a soft
                      machine is, and not over the implant
  --report DIR        write report.html of the results in DIR anew; nothing is run
  --jobs N            run N variants of a study at a time (default: as many as
                      there are processors)
  --threads N         use N threads (default: as many as there are processors, in
                      a study shared among the variants that run at a time)
  --verbose           print where the time went
  --check             read the scene, build the meshes, say what to expect, and
                      run nothing
  --print-parameters  print all entries with documentation and values: those of
                      SCENE.prm, or the defaults if no scene is given
  --help              print this text
  --version           print the version

SIGINT, SIGTERM, SIGHUP and SIGUSR1 end a run after the step at work and leave a
checkpoint for --resume; a second one ends it at once.

Exit codes: 0 success, 1 wrong usage or scene, 2 the run failed or its files could
not be written, 3 internal error, 128 + N interrupted by signal N.
)";



  // Results belong to a version of this program and of deal.II: both are said.
  //
  // A checkpoint of another version is refused.
  const char *const version_text =
    "debond " DEBOND_VERSION " (deal.II " DEAL_II_PACKAGE_VERSION ")\n";



  // What the words amount to. Nothing is decided yet.
  struct Arguments
  {
    std::string scene_file;
    std::string directory_to_resume;  ///< empty: a run begins anew
    std::string directory_to_compare; ///< with the curve in scene_file
    std::string directory_to_report;
    std::string columns;                ///< of that curve; empty: recognised
    std::string over;                   ///< its place; empty: the implant's
    std::vector<std::string> overrides; ///< "Subsection/Entry=value", in order
    bool force = false, check = false, print_parameters = false, help = false,
         version = false, verbose = false;
    unsigned int n_jobs    = 0; ///< 0: as many as processors
    unsigned int n_threads = 0; ///< 0: as many as processors
  };



  // A mistake on the command line is an InputError as one in a scene is: exit
  // code 1, and nothing has been run or written.
  [[noreturn]] void
  refuse_usage(const std::string &message)
  {
    throw InputError("debond: " + message + " (see debond --help)");
  }



  // Strictly: std::stoi alone would take "4x" for a number.
  //
  // Four digits are enough for threads and jobs, and cannot overflow. 0 is
  // refused, as it could be meant as "none" or as "all".
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



  // What makes no sense together is refused, not ignored. A run that goes on is
  // what it was: its scene may not change, and so its checks are done. --force
  // would remove the very checkpoint that is to be used, and --jobs is for
  // studies, which are not resumed but run again: what is done in them is kept.
  void
  refuse_combinations(const Arguments &arguments, const std::size_t n_words)
  {
    const bool resumes = !arguments.directory_to_resume.empty();
    if (resumes && (arguments.check || arguments.print_parameters ||
                    arguments.force || arguments.n_jobs > 0))
      refuse_usage(
        "--resume goes with SCENE.prm, --set, --threads and --verbose only");
    const bool compares = !arguments.directory_to_compare.empty();
    if (compares && (resumes || arguments.check || arguments.print_parameters ||
                     arguments.force || !arguments.overrides.empty()))
      refuse_usage("--compare goes with a curve, --columns and --over only");
    if (compares && arguments.scene_file.empty())
      refuse_usage("--compare needs a measured curve: --compare DIR CURVE.csv");
    const bool reports = !arguments.directory_to_report.empty();
    if (reports && n_words != 2)
      refuse_usage("--report goes with nothing else");
    if (!compares && !arguments.columns.empty())
      refuse_usage("--columns is for --compare; a scene has Output / Reference "
                   "columns");
    if (!compares && !arguments.over.empty())
      refuse_usage("--over is for --compare");
    // With --print-parameters alone the defaults are printed.
    const bool needs_no_scene =
      resumes || reports || arguments.help || arguments.version ||
      (arguments.print_parameters && arguments.overrides.empty());
    if (arguments.scene_file.empty() && !needs_no_scene)
      refuse_usage("no scene file is given");
  }



  // Options are few, so that tables of their names and a loop over the words
  // read them. What has no dash in front is the scene file.
  //
  // deal.II's ParameterHandler is for what stands in a scene; a command line
  // has an order, and words without names.
  Arguments
  read_arguments(const std::vector<std::string> &words)
  {
    Arguments                           arguments;
    const std::map<std::string, bool *> flags{{"--help", &arguments.help},
                                              {"-h", &arguments.help},
                                              {"--version", &arguments.version},
                                              {"--check", &arguments.check},
                                              {"--print-parameters",
                                               &arguments.print_parameters},
                                              {"--verbose", &arguments.verbose},
                                              {"--force", &arguments.force}};
    // The tables point to where a word is to be kept, so that a new flag or
    // number is one line here and one in the help text.
    const std::map<std::string, unsigned int *> numbers{
      {"--jobs", &arguments.n_jobs}, {"--threads", &arguments.n_threads}};
    // The texts, with what an option that has none needs.
    const std::map<std::string, std::pair<std::string *, const char *>> texts{
      {"--resume", {&arguments.directory_to_resume, "the directory of a run"}},
      {"--compare",
       {&arguments.directory_to_compare, "a directory of results"}},
      {"--report", {&arguments.directory_to_report, "a directory of results"}},
      {"--columns",
       {&arguments.columns, "two columns, the angle and the torque"}},
      {"--over", {&arguments.over, "machine_angle_deg or machine_uz_mm"}}};
    // From left to right: of an entry that is set twice the last value counts.
    for (auto word = words.begin(); word != words.end(); ++word)
      {
        // Some options take the next word as their value. The lambda moves on
        // to that word. An option at the end of the line has none, and is
        // refused with what it needs, for a number by read_number().
        const std::string option = *word;
        const auto        value  = [&](const std::string &what) {
          const std::string text = word + 1 == words.end() ? "" : *++word;
          if (text.empty() && !what.empty())
            refuse_usage(option + " needs " + what);
          return text;
        };
        // An option that is not known is refused: a mistyped --force must not
        // become the name of a scene.
        if (flags.count(option) > 0)
          *flags.at(option) = true;
        else if (numbers.count(option) > 0)
          *numbers.at(option) = read_number(option, value(""));
        else if (option == "--set")
          arguments.overrides.push_back(utf8(value("ENTRY=VALUE")));
        else if (texts.count(option) > 0)
          *texts.at(option).first = value(texts.at(option).second);
        else if (option.size() > 1 && option[0] == '-')
          refuse_usage("unknown option '" + option + "'");
        else if (!arguments.scene_file.empty())
          refuse_usage("one scene at a time: '" + arguments.scene_file +
                       "' or '" + option + "'?" +
                       (option.find('=') == option.npos ?
                          "" :
                          " An entry with blanks stands in quotes: --set "
                          "\"SUBSECTION/ENTRY=VALUE\""));
        else
          arguments.scene_file = option;
      }

    refuse_combinations(arguments, words.size());
    return arguments;
  }



  // What is not asked for is what the machine has. hardware_concurrency() is 0
  // where the system does not tell.
  //
  // It knows nothing of the limits of processor time that a container may have:
  // --threads and --jobs are there for that.
  // Ranks of MPI on one machine share its processors.
  unsigned int
  or_processors(const unsigned int n)
  {
    return n > 0 ? n :
                   std::max(1U,
                            std::thread::hardware_concurrency() /
                              Ranks::number_on_this_machine());
  }



  // <h3>What can be run</h3>
  //
  // Studies, fits, comparisons and pages are written in Python, where processes
  // and statistics are at home; what they need of the program is its library,
  // as a module. A study is a scene whose entries hold several values, {{a|b}};
  // a calibration says so, and may have several values for its experiments.
  std::string
  command_for(const std::vector<SceneEntry> &entries)
  {
    std::string command;
    for (const SceneEntry &entry : entries)
      if (entry.full_name() == "Task" && entry.value == "calibrate")
        return "calibrate";
      else if (entry.value.find("{{") != std::string::npos)
        command = "study";
    return command;
  }

  // The command of Python with the words that this program was given; a number
  // that was not said it chooses itself.
  [[noreturn]] void
  become(const std::string &command, const Arguments &arguments)
  {
    // it reads the scene again, which a pipe does not give twice
    if (!std::filesystem::is_regular_file(arguments.scene_file))
      throw InputError(arguments.scene_file +
                       ": a study or a calibration has to be a regular file");
    std::vector<std::string> words{arguments.scene_file};
    if (arguments.n_threads > 0)
      words.push_back("--threads=" + std::to_string(arguments.n_threads));
    if (arguments.n_jobs > 0 && command == "study")
      words.push_back("--jobs=" + std::to_string(arguments.n_jobs));
    for (const std::string &text : arguments.overrides)
      words.push_back("--set=" + text);
    if (arguments.force)
      words.push_back("--force");
    if (arguments.check)
      words.push_back("--check");
    Laboratory::become(command, words);
  }



  // What has been run is shown on a page, however it has ended: what failed is
  // what people want to look at first. A page that cannot be written is no
  // reason to lose sight of why the run failed.
  template <typename Run>
  void
  with_report(const Scene &scene, const Run &run)
  {
    const auto report = [&] {
      const std::string &directory = scene.output.directory;
      if (!scene.output.report)
        return;
      const bool has_page = write_page(directory);
      if (!scene.output.quiet && has_page)
        std::cout << "Open " << directory << "/report.html in a browser"
                  << (scene.output.fields_every > 0 &&
                          scene.model == ModelKind::finite_elements ?
                        ", interface.pvd and bulk.pvd there in ParaView" :
                        "")
                  << std::endl;
    };
    const auto time_of_summary = [&scene] {
      std::error_code none;
      return std::filesystem::last_write_time(scene.output.directory +
                                                "/summary.json",
                                              none);
    };
    const auto before = time_of_summary();
    try
      {
        run();
      }
    catch (const std::exception &)
      {
        // a scene that was refused has left nothing
        if (time_of_summary() != before)
          try
            {
              report();
            }
          catch (const std::exception &)
            {}
        throw;
      }
    report();
  }



  // A run that was interrupted goes on from its last checkpoint, to the same
  // files, to the last bit, as if it never had been.
  //
  // Friction depends on the path, so that the state at a time cannot be found
  // again without the steps before it; see
  // doc/howto/resume.md.
  void
  resume(const Arguments &arguments)
  {
    // The directory says what was run, and how far. If a scene is given it must
    // be the same one, but for what changes no result (the title, the console):
    // else the rows before and after would not be of one curve. It may go on to
    // later times, also from the end of a run that was finished.
    const auto run = find_interrupted_run(arguments.directory_to_resume,
                                          arguments.scene_file,
                                          arguments.overrides);
    if (!run)
      {
        const std::string &directory = arguments.directory_to_resume;
        if (compare_anew_if_changed(
              Scene::from_file(directory + "/parameters.prm").output,
              directory))
          std::cout << "The content of its reference has changed: the "
                       "distances from it are computed anew.\n";
        std::cout << "The run in " << directory
                  << " is finished. A scene, or --set, with further Load steps "
                     "/ Times and Steps extends it.\n";
        return;
      }
    // There are two checkpoints, written in turn. One may be damaged, if the
    // power failed while it was written.
    for (const std::string &remark : run->remarks)
      std::cout << "warning: " << remark << ", the other checkpoint is used\n";
    set_number_of_threads(or_processors(arguments.n_threads));
    catch_interruptions();
    Scene scene          = run->scene;
    scene.output.timings = arguments.verbose;
    with_report(scene,
                [&] { run_to_accuracy(scene, nullptr, &*run->checkpoint); });
  }



  // From what needs least to what needs most: texts, a run that goes on, the
  // scene's entries, a study, one scene.
  //
  // Each of them is done and returns; what is left at the end is one scene that
  // is to be run. Whatever goes wrong is thrown, and main() makes an exit code
  // of it.
  void
  act(const Arguments &arguments)
  {
    // What needs no scene.
    if (arguments.help || arguments.version)
      {
        std::cout << (arguments.help ? help_text : version_text);
        return;
      }
    if (!arguments.directory_to_resume.empty())
      return resume(arguments);
    if (!arguments.directory_to_compare.empty())
      Laboratory::become("compare",
                         {arguments.directory_to_compare,
                          arguments.scene_file,
                          "--columns=" + arguments.columns,
                          "--over=" + arguments.over});
    if (!arguments.directory_to_report.empty())
      Laboratory::become("page", {arguments.directory_to_report});
    if (arguments.scene_file.empty())
      return print_parameters(std::cout);

    // The file is read as a list of entries with their places, which --set may
    // replace. Whether it is a study shows before any value is understood.
    const std::vector<SceneEntry> entries =
      with_overrides(read_scene_file(arguments.scene_file),
                     arguments.overrides);
    // A calibration's entries hold <<unknowns>>, a study's {{a|b}}: each of its
    // variants is a scene, they themselves are none.
    if (const std::string command = command_for(entries);
        !command.empty() && !arguments.print_parameters)
      {
        if (Ranks::number() > 1)
          refuse_usage("studies and calibrations are processes of one "
                       "machine: leave out mpirun, or deal variants out to "
                       "many machines in Python (doc/howto/cluster.md)");
        become(command, arguments);
      }

    // Here text becomes a plain value, with all numbers in mm, N and MPa. What
    // is not allowed, or makes no sense together, is refused with its place.
    // From here on nothing is read as text any more: the models take this
    // value, and could have got it from anywhere.
    Scene scene = Scene::from_entries(entries, arguments.scene_file);
    if (arguments.print_parameters)
      return print_parameters(std::cout, &scene);

    // One scene has all threads; how many there are changes no result.
    set_number_of_threads(or_processors(arguments.n_threads));
    // Entries that would have no effect are refused, so that nobody takes one
    // run for the median of several.
    if (scene.study.repetitions > 1 || scene.study.factors_at_once > 0)
      throw scene.with_place(EntryError(
        scene.study.repetitions > 1 ? "Expert / Study / Repetitions" :
                                      "Expert / Study / Factors varied at once",
        "this is for studies, and no entry of this scene holds several "
        "values, {{a|b}}"));
    // A directory that holds results of another scene is left alone, unless the
    // user says otherwise.
    scene.output.overwrite_other_results = arguments.force;
    scene.output.timings                 = arguments.verbose;
    // --check goes as far as building the meshes, so that it finds everything
    // that a run would refuse.
    if (arguments.check)
      return run_scene(scene, nullptr, &std::cout);
    // Closed forms are done before they could be asked to stop. Finite elements
    // leave a checkpoint after the step at work.
    if (scene.model == ModelKind::finite_elements)
      catch_interruptions();
    // Finite elements or a closed form, as the entry `Model` says. It throws
    // RunError where the load cannot be followed and Interrupted after a
    // signal; the rows before are on the disk by then.
    with_report(scene, [&] { run_scene(scene); });
  }



  // <h3>What went wrong</h3>
  //
  // The library's own errors are worded where they are found and printed as
  // they are. deal.II's go over several lines, of which programs that gather
  // messages would only keep the first: they are joined.
  //
  // Memory that runs out has a message of its own, as std::bad_alloc says
  // nothing that would help.
  std::string
  message_of(const std::exception &error, const bool is_internal)
  {
    if (dynamic_cast<const std::bad_alloc *>(&error) != nullptr)
      return std::string("debond: ") + out_of_memory;
    std::string line = error.what(), word;
    // Name of the exception and its text, word by word; where it was thrown
    // would say nothing to a user.
    if (const auto *const of_library =
          dynamic_cast<const dealii::ExceptionBase *>(&error))
      {
        Classic<std::stringstream> text;
        of_library->print_info(text);
        line = of_library->get_exc_name();
        while (text >> word)
          line += " " + word;
      }
    return (is_internal ? "debond: internal error: " : "") + line;
  }



  // Mostly all ranks have met the same, and the first one says it. What one
  // rank alone has met, as a lack of memory, it says itself, if the first one
  // does not end the program before: others wait for it in a sum that it will
  // never add to. That a signal has come all know, and the first one, which may
  // still be writing, says it. What has been said takes a moment to get through
  // mpirun.
  [[noreturn]] void
  end_of_ranks(const std::string &message, const int code)
  {
    if (!Ranks::is_first() && code > 128)
      Ranks::meet();
    if (!Ranks::is_first())
      std::this_thread::sleep_for(std::chrono::seconds(3));
    std::cerr << (Ranks::is_first() ?
                    "" :
                    "rank " + std::to_string(Ranks::own()) + ": ")
              << message << std::endl;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    Ranks::end_all(code);
  }



  // The first code of all that runs, before the constructors of the libraries:
  // some of what they call, templates, the linker takes from this program, and
  // they catch signals.
  void
  before_libraries()
  {
    require_instructions();
    remember_ignored_signals();
  }

  __attribute__((section(".preinit_array"),
                 used)) void (*const first_call)() = before_libraries;
} // namespace



// Four kinds of ends can be told apart by scripts: what the user can mend (1),
// what the load or the machine did not allow (2), what is a mistake of this
// program (3), and a signal (128 and its number, as shells count).
int
main(int argc, char *argv[])
{
  // One thread to begin with; deal.II's errors as exceptions, not aborts. How
  // many threads there are to be is said once it is known what is run.
  set_up_libraries();
  note_command(argc, argv);
  // a pipe that nobody reads any more, as of `| head`, ends no run: files count
  std::signal(SIGPIPE, SIG_IGN);
  // mpirun writes to a terminal of its own, whatever becomes of it
  if (isatty(STDOUT_FILENO) && !Ranks::are_launched())
    show_progress_on_terminal();
  // As one of several processes of MPI all of them do the same, and the first
  // one speaks.
  if (Ranks::are_launched())
    {
      Ranks::start();
      if (!Ranks::is_first())
        std::cout.rdbuf(nullptr); // which takes all, and shows nothing
    }
  try
    {
      act(read_arguments({argv + 1, argv + argc}));
      Ranks::finish();
      return exit_code(0);
    }
  catch (const std::exception &error)
    {
      // What a signal has ended is as it should be, and can go on. A run that
      // failed leaves the rows before, and summary.json says why.
      const auto *const interrupted = dynamic_cast<const Interrupted *>(&error);
      const bool        fails_to_run =
        dynamic_cast<const RunError *>(&error) != nullptr ||
        dynamic_cast<const std::bad_alloc *>(&error) != nullptr;
      // What is none of these was not foreseen: a failed assertion of a
      // library, a bug. It is printed as an internal error, so that it is
      // reported as one.
      const int code = dynamic_cast<const InputError *>(&error) != nullptr ? 1 :
                       interrupted != nullptr ? 128 + interrupted->signal :
                       fails_to_run           ? 2 :
                                                3;
      const std::string message = message_of(error, code == 3);
      hide_progress();
      if (Ranks::number() == 1)
        {
          std::cerr << message << std::endl;
          return exit_code(code);
        }
      end_of_ranks(message, code);
    }
}
