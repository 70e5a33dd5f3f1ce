// Runs a scene and checks its results against what comments in the scene
// expect, reading the result files as a user would:
//
//   # expect: T_max_Nmm = 50.32 within 0.1 %  (where the number is from)
//   # run: --set "Implant/Cells=12, 2" --set "Bone/Material=rigid"
//
// expectations.h says what may be expected. Prints a line for each expectation.
//
//   check_scene SCENE.prm              exit code 0 if the scene could be run
//   check_scene SCENE.prm DIRECTORY    results go there; exit code 0 only if
//                                      all expectations are met

#include <debond/campaigns/run_scene.h>
#include <debond/scene/scene.h>
#include <debond/support/laboratory.h>
#include <debond/support/runtime.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "expectations.h"

namespace
{
  using namespace Expectations;



  /** The arguments of `--set` in the `run` comments. */
  std::vector<std::string>
  overrides_of(const std::string &scene_text)
  {
    std::vector<std::string> result;
    for (const std::string &line : comments(scene_text, "run"))
      for (const std::string &override : overrides(line))
        result.push_back(override);
    result.push_back("Output/Console=quiet");
    return result;
  }



  /** Runs a scene or a study and reads its results. */
  std::vector<Results>
  run(const std::string              &scene_file,
      const std::string              &scene_text,
      const std::vector<std::string> &more_overrides)
  {
    const std::vector<Debond::SceneEntry> entries = Debond::with_overrides(
      Debond::with_overrides(Debond::read_scene_file(scene_file),
                             overrides_of(scene_text)),
      more_overrides);
    std::map<std::string, std::string> values;
    for (const Debond::SceneEntry &entry : entries)
      values[entry.full_name()] = entry.value;
    const bool is_study =
      std::any_of(entries.begin(), entries.end(), [](const auto &entry) {
        return entry.value.find("{{") != std::string::npos;
      });
    if (const bool is_calibration = values["Task"] == "calibrate";
        is_calibration || is_study)
      {
        std::vector<std::string> words{scene_file, "--threads=2", "--force"};
        for (const Debond::SceneEntry &entry : entries)
          words.push_back("--set=" + entry.full_name() + "=" + entry.value);
        std::string said;
        const int   code =
          Debond::Laboratory::run(is_calibration ? "calibrate" : "study",
                                  words,
                                  said);
        // 2: study.csv says which variant failed
        if (code != 0 && (is_calibration || code != 2))
          throw Debond::RunError("it failed: " + said);
        const std::string directory =
          values.count("Output / Directory") > 0 ?
            values["Output / Directory"] :
            Debond::OutputParameters().directory;
        if (is_calibration)
          return {read_calibration(directory)};
        return read_study(directory);
      }

    Debond::Scene scene = Debond::Scene::from_entries(entries, scene_file);
    scene.output.overwrite_other_results = true;
    Debond::run_scene(scene);
    return {read_results(scene.output.directory)};
  }



  /** Whether all expectations are met. What was measured goes to @p directory,
   *  the results only if @p more_overrides say so. */
  bool
  check(const std::string              &scene_file,
        const std::string              &directory,
        const std::vector<std::string> &more_overrides)
  {
    const std::string scene_text = contents_of(scene_file);
    const auto        results    = run(scene_file, scene_text, more_overrides);
    const std::vector<std::string> expectations =
      comments(scene_text, "expect");
    bool                 all_met = !expectations.empty();
    std::vector<Verdict> verdicts;
    for (const std::string &expectation : expectations)
      {
        verdicts.push_back(judge(expectation, results));
        std::cout << verdicts.back().line << '\n';
        all_met = all_met && verdicts.back().is_met;
      }
    write_verdicts(verdicts, directory);
    if (expectations.empty())
      std::cout << "FAILED: the scene expects nothing\n";
    return all_met;
  }
} // namespace



int
main(int argc, char *argv[])
{
  Debond::set_up_libraries();
  if (const char *const n_threads = std::getenv("DEBOND_TEST_THREADS"))
    Debond::set_number_of_threads(std::stoi(n_threads)); // tests/spread.py
  if (argc != 2 && argc != 3)
    {
      std::cerr << "usage: check_scene SCENE.prm [DIRECTORY]\n";
      return 1;
    }
  try
    {
      if (argc == 2)
        {
          check(argv[1], ".", {});
          return 0;
        }
      const std::string directory = argv[2];
      return check(argv[1], directory, {"Output/Directory=" + directory}) ? 0 :
                                                                            1;
    }
  catch (const std::exception &error)
    {
      std::cout << error.what() << std::endl;
      return 1;
    }
}
