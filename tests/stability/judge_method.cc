// Runs a scene of the stability suite with one of the methods that its comments
// list, and says whether what comes out is what they expect:
//
//   # judge: T_max_Nmm = 50.32 within 0.1 %  (where the number is from)
//   # method: default: right
//   # method: explicit: wrong --set "Expert/Friction update=explicit"
//   # comes to: T_max_Nmm = 52.1 within 1 %  (where the number is from)
//   # method: brittle: refused "not unique" --set ...
//   # slow method: fine: right --set "Load steps/Steps=1, 1000"
//
// An outcome is `right' if the run ends and everything is as judged, `wrong' if
// it ends and something is not, `refused' if it stops with a message that
// contains the words in quotes, and `failed' if it does so because a step could
// not be solved. Judgements (expectations.h) that follow a method are for that
// one alone and replace those of the others. What a wrong method comes to is
// judged as well. Slow methods are in the table, but no tests.
//
//   judge_method SCENE.prm METHOD DIRECTORY
//
// Results go to the directory. Prints the judgements and, as the last line, the
// row of doc/evidence/stability.md. Exit code 0 if the outcome is the expected
// one.

#include <debond/campaigns/run_scene.h>
#include <debond/scene/scene.h>
#include <debond/support/input_error.h>
#include <debond/support/runtime.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "../verification/expectations.h"

namespace
{
  using namespace Expectations;

  /** A method as the comments of a scene have it. */
  struct Method
  {
    std::string              name;
    std::string              outcome; ///< expected
    std::string              message; ///< part of it, where it stops
    std::vector<std::string> overrides;
    std::vector<std::string> judgements;
    std::vector<std::string> comes_to; ///< where it is wrong
  };



  Method
  read_method(const std::string &text)
  {
    const std::regex pattern(
      "([^ :]+): (right|wrong|refused|failed)(?: \"([^\"]+)\")?((?: --set .*)?)");
    std::smatch match;
    if (!std::regex_match(text, match, pattern) ||
        match[3].matched != (match[2] == "refused" || match[2] == "failed"))
      throw std::runtime_error("cannot read the method '" + text + "'");
    return {match[1], match[2], match[3], overrides(match[4]), {}, {}};
  }



  Method
  find_method(const std::string &scene_text, const std::string &name)
  {
    const std::regex pattern(
      "\\s*#\\s*(judge|comes to|method|slow method):\\s*(.*?)\\s*");
    std::vector<std::string> judgements;
    std::vector<Method>      methods;
    std::istringstream       lines(scene_text);
    std::string              line;
    std::smatch              match;
    while (std::getline(lines, line))
      {
        if (!std::regex_match(line, match, pattern))
          continue;
        if (match[1] == "comes to" && !methods.empty())
          methods.back().comes_to.push_back(match[2]);
        else if (match[1] != "judge")
          methods.push_back(read_method(match[2]));
        else if (methods.empty())
          judgements.push_back(match[2]);
        else
          methods.back().judgements.push_back(match[2]);
      }
    const auto found =
      std::find_if(methods.begin(), methods.end(), [&](const Method &method) {
        return method.name == name;
      });
    if (found == methods.end())
      throw std::runtime_error("the scene has no method " + name);
    if (found->judgements.empty())
      found->judgements = judgements;
    if (found->judgements.empty() && found->outcome != "refused")
      throw std::runtime_error("nothing says what is right with " + name);
    if (found->comes_to.empty() != (found->outcome != "wrong"))
      throw std::runtime_error("what " + name +
                               " comes to is for methods that are wrong, and "
                               "has to be there for those");
    return *found;
  }



  struct Outcome
  {
    std::string name;
    std::string detail; ///< of what makes it this outcome
    Results     results;
  };



  /** Why a run stopped. */
  struct Stop
  {
    std::string message; ///< empty if it did not
    bool        in_a_step = false;
  };



  Stop
  run(const std::string &scene_file, const std::vector<std::string> &overrides)
  {
    try
      {
        Debond::Scene scene = Debond::Scene::from_entries(
          Debond::with_overrides(Debond::read_scene_file(scene_file),
                                 overrides),
          scene_file);
        scene.output.overwrite_other_results = true;
        Debond::run_scene(scene);
      }
    catch (const Debond::InputError &error)
      {
        return {error.what(), false};
      }
    catch (const Debond::RunError &error)
      {
        return {error.what(), true};
      }
    return {};
  }



  /** What a judgement is about: all before its relation. */
  std::string
  quantity(const std::string &judgement)
  {
    std::string result = judgement.substr(0, judgement.find(" = "));
    for (const std::string relation : {" above ", " below "})
      result = result.substr(0, result.find(relation));
    return result;
  }



  /** Throws if a judgement cannot be evaluated. */
  Verdict
  judge_or_throw(const std::string &judgement, const Results &results)
  {
    const Verdict verdict = judge(judgement, {results});
    if (!verdict.is_readable)
      throw std::runtime_error(verdict.line);
    return verdict;
  }



  /** The outcome of a run that stopped. */
  Outcome
  outcome_of_stop(const Method &method, const Stop &stop)
  {
    std::cout << stop.message << '\n';
    Outcome    outcome;
    const bool is_known =
      !method.message.empty() &&
      stop.message.find(method.message) != std::string::npos;
    outcome.name = !is_known ? "stopped" :
                   method.outcome == "failed" && !stop.in_a_step ?
                               "refused" :
                               method.outcome;
    outcome.detail =
      "\"... " + (is_known ? method.message : stop.message) + " ...\"";
    return outcome;
  }



  Outcome
  outcome_of(const Method      &method,
             const Stop        &stop,
             const std::string &directory)
  {
    Outcome outcome;
    if (!stop.message.empty())
      outcome = outcome_of_stop(method, stop);
    if (std::filesystem::exists(directory + "/summary.json"))
      outcome.results = read_results(directory);
    if (!stop.message.empty())
      return outcome;
    outcome.name = "right";
    std::vector<Verdict> verdicts;
    for (const std::string &judgement : method.judgements)
      {
        const Verdict verdict = judge_or_throw(judgement, outcome.results);
        std::cout << verdict.line << '\n';
        verdicts.push_back(verdict);
        const bool first_bad = outcome.name == "right" && !verdict.is_met;
        if (first_bad)
          outcome.name = "wrong";
        if (first_bad || outcome.detail.empty())
          outcome.detail = quantity(judgement) + ": " + verdict.measured;
      }
    for (const std::string &value : method.comes_to)
      {
        const Verdict verdict = judge_or_throw(value, outcome.results);
        std::cout << "comes to: " << verdict.line << '\n';
        verdicts.push_back(verdict);
        if (!verdict.is_met)
          outcome.name += " in another way";
      }
    write_verdicts(verdicts, directory);
    return outcome;
  }



  std::string
  row(const std::string &scene_file,
      const std::string &method,
      const Outcome     &outcome)
  {
    const auto &summary = outcome.results.summary;
    const auto  number  = [&](const std::string &name) {
      std::ostringstream text;
      text << std::setprecision(2);
      if (summary.count(name) == 0)
        return std::string();
      if (name == "newton_iterations")
        text << std::setprecision(8);
      text << summary.at(name);
      return text.str();
    };
    const Table      &table = outcome.results.table;
    std::size_t const warnings =
      std::count_if(table.rows.begin(), table.rows.end(), [&](const auto &row) {
        return row[table.column("warnings")] > 0;
      });
    std::string scene = scene_file.substr(scene_file.rfind('/') + 1);
    scene             = scene.substr(0, scene.rfind('.'));
    return "| " + scene + " | " + method + " | " + outcome.name + " | " +
           outcome.detail + " | " + number("newton_iterations") + " | " +
           number("smallest_step") + " | " + number("largest_energy_defect") +
           " | " + std::to_string(warnings) + " |";
  }
} // namespace



int
main(int argc, char *argv[])
{
  Debond::set_up_libraries();
  if (const char *const n_threads = std::getenv("DEBOND_TEST_THREADS"))
    Debond::set_number_of_threads(std::stoi(n_threads)); // tests/spread.py
  if (argc != 4)
    {
      std::cerr << "usage: judge_method SCENE.prm METHOD DIRECTORY\n";
      return 1;
    }
  try
    {
      const std::string scene_file = argv[1], name = argv[2],
                        directory = argv[3];
      Method method               = find_method(contents_of(scene_file), name);
      method.overrides.push_back("Output/Directory=" + directory);
      method.overrides.push_back("Output/Console=quiet");
      // a scene that is refused must not be judged by an earlier run
      std::filesystem::remove(directory + "/summary.json");
      const Outcome outcome =
        outcome_of(method, run(scene_file, method.overrides), directory);
      const bool as_expected = outcome.name == method.outcome;
      if (!as_expected)
        std::cout << "FAILED: expected was '" << method.outcome << "'\n";
      std::cout << row(scene_file, name, outcome) << std::endl;
      return as_expected ? 0 : 1;
    }
  catch (const std::exception &error)
    {
      std::cout << error.what() << std::endl;
      return 1;
    }
}
