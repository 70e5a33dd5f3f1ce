#include <debond/debonding_problem.h>
#include <debond/input_error.h>
#include <debond/runtime.h>
#include <debond/scene.h>

#include <deal.II/base/config.h>
#include <deal.II/base/exceptions.h>

#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <vector>

namespace
{
  const char *const help_text =
    R"(usage: debond [OPTIONS] SCENE.prm

Simulates the tangential debonding of an implant from bone as the scene file
describes it, and writes torque curve, summary and fields into the directory
that the scene names.

  --set ENTRY=VALUE   override an entry of the scene; may be repeated
                      --set "Interface/Penalty stiffness=1800"
  --force             write into a directory that holds results of another scene
  --check             read the scene, build the meshes, say what to expect, and
                      run nothing
  --print-parameters  print all entries with documentation and values: those of
                      SCENE.prm, or the defaults if no scene is given
  --help              print this text
  --version           print the version

Exit codes: 0 success, 1 wrong usage or scene, 2 the run failed, 3 internal error.
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
    std::vector<std::string> overrides;
    bool                     force = false;
  };



  [[noreturn]] void
  refuse_usage(const std::string &message)
  {
    throw Debond::InputError("debond: " + message + " (see debond --help)");
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
        else if (word.size() > 1 && word[0] == '-')
          refuse_usage("unknown option '" + word + "'");
        else if (!arguments.scene_file.empty())
          refuse_usage("one scene at a time: '" + arguments.scene_file +
                       "' or '" + word + "'?");
        else
          arguments.scene_file = word;
      }

    const bool needs_scene = arguments.action == Action::run ||
                             arguments.action == Action::check ||
                             !arguments.overrides.empty();
    if (needs_scene && arguments.scene_file.empty() &&
        arguments.action != Action::help && arguments.action != Action::version)
      refuse_usage("no scene file is given");
    return arguments;
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
    if (arguments.scene_file.empty())
      return Debond::print_parameters(std::cout);

    Debond::Scene scene =
      Debond::Scene::from_file(arguments.scene_file, arguments.overrides);
    if (arguments.action == Action::print_parameters)
      return Debond::print_parameters(std::cout, &scene);

    scene.output.overwrite_other_results = arguments.force;
    Debond::DebondingProblem problem(scene);
    if (arguments.action == Action::check)
      problem.check(std::cout);
    else
      problem.run();
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
      std::cerr << "debond: out of memory" << std::endl;
      return 3;
    }
  catch (const std::exception &error)
    {
      std::cerr << "debond: internal error: " << error.what() << std::endl;
      return 3;
    }
}
