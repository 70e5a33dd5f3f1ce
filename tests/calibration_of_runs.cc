// Calibrations by finite elements, on a small mesh: a curve without noise gives
// its parameters back; the 95 % intervals of 25 curves with noise hold the true
// values; one that was interrupted goes on, with two threads as with one, to
// the same digits; parameters that runs cannot be differentiated by.

#include <debond/campaigns/calibration.h>
#include <debond/models/simulation.h>
#include <debond/support/input_error.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "checks.h"

using namespace Debond;

std::string
scene_text(const std::string &entries, const std::string &more)
{
  return "subsection Bone\n  set Cells = 8, 8, 2\n  set Material = linear\nend\n"
         "subsection Implant\n  set Cells = 2, 2\n  set Material = linear\nend\n"
         "subsection Interface\n  set Quadrature points = 4\n" +
         entries +
         "end\n"
         "subsection Chuck\n"
         "  subsection Translation z\n    set Value = -0.0049 * min(t, 1)\n  end\n"
         "  subsection Rotation z\n    set Value = 10 * max(t - 1, 0)\n  end\n"
         "end\n"
         "subsection Load steps\n  set Steps = 1, 200\nend\n" +
         more;
}

const std::string truth = "  set Friction coefficient unbroken = 0.58\n"
                          "  set Sliding threshold = 0.022\n"
                          "  set Transition factor = 0.74\n"
                          "  set Penalty stiffness = 585\n"
                          "  set Tangential penalty stiffness = 400\n";

const std::string five =
  "  set Friction coefficient unbroken = <<0.5 in 0.3..1.2>>\n"
  "  set Sliding threshold = <<0.015 in 0.006..0.1 log>>\n"
  "  set Transition factor = <<0.5 in 0.1..3>>\n"
  "  set Penalty stiffness = <<400 in 100..3000 log>>\n"
  "  set Tangential penalty stiffness = <<300 in 100..3000 log>>\n";

const std::vector<double> true_values{0.58, 0.022, 0.74, 585, 400};



std::string
output_of(const std::string &directory, const std::string &calibration = "")
{
  return "subsection Calibration\n  set Curves = torque_Nmm, chuck_Fz_N\n" +
         calibration +
         "end\n"
         "subsection Output\n  set Directory = results/" +
         directory + "\n  set Reference curve = clean.csv\nend\n";
}



nlohmann::ordered_json
calibrate(const std::string &text,
          const std::string &directory,
          const unsigned int n_threads,
          const bool         force)
{
  std::ostringstream out;
  run_calibration(read_scene_text("set Task = calibrate\n" + text, "scene"),
                  "scene",
                  n_threads,
                  force,
                  out);
  std::ifstream file("results/" + directory + "/calibration.json");
  return nlohmann::ordered_json::parse(file);
}



void
check_values(const std::string &name, const nlohmann::ordered_json &result)
{
  double      worst = 0.;
  std::size_t j     = 0;
  for (const auto &unknown : result["unknowns"])
    {
      grow(worst,
           std::abs(unknown["value"].get<double>() / true_values[j] - 1.));
      ++j;
    }
  report(name + ": parameters", worst, 1e-4);
}



/** All but what a clock has told. */
std::string
without_seconds(nlohmann::ordered_json result)
{
  result.erase("seconds");
  return result.dump();
}



void
check_interrupted()
{
  const std::string text = scene_text(five, output_of("five"));
  const auto        once = calibrate(text, "five", 1, true);
  check_values("five unknowns", once);
  report("with two threads the same digits",
         without_seconds(once) ==
           without_seconds(calibrate(text, "five", 2, true)));

  // as if it had been killed while it wrote its fourth evaluation
  const std::string log = "results/five/evaluations.jsonl";
  std::ifstream     whole(log);
  std::string       line, begun;
  for (unsigned int i = 0; i < 3 && std::getline(whole, line); ++i)
    begun += line + "\n";
  begun += "{\"key\":";
  whole.close();
  std::ofstream(log) << begun;
  report("interrupted, the same digits",
         without_seconds(once) ==
           without_seconds(calibrate(text, "five", 2, false)));
}



/** 2 % noise, independent from row to row. */
void
check_intervals()
{
  const auto            entries = study_variants(read_scene_text(
    scene_text(five, output_of("noise", "  set Noise = 0.02\n")), "scene"));
  const Unknowns        unknowns(entries);
  Misfit                misfit(unknowns, 1, "scene");
  const Eigen::VectorXd clean = misfit.measured;
  const Eigen::VectorXd start =
    Eigen::Map<const Eigen::VectorXd>(true_values.data(), 5);
  std::vector<unsigned int>  held(5, 0);
  std::mt19937               generator(1);
  std::normal_distribution<> normal;
  for (unsigned int i = 0; i < 25; ++i)
    {
      for (Eigen::Index k = 0; k < clean.size(); ++k)
        misfit.measured[k] = clean[k] + normal(generator) / misfit.weights[k];
      const Optimum       best = minimise(misfit, start, Experiment::By::scene);
      const FitStatistics statistics(misfit,
                                     best.unknowns,
                                     misfit.evaluate(best.unknowns,
                                                     Experiment::By::scene,
                                                     true));
      for (unsigned int j = 0; j < 5; ++j)
        held[j] += statistics.unknowns[j].lower <= start[j] &&
                   start[j] <= statistics.unknowns[j].upper;
    }
  for (unsigned int j = 0; j < 5; ++j)
    report("95 % interval of " + unknowns.list[j].name +
             " holds in at least 21 of 25 curves",
           held[j] >= 21);
}



/** The radius changes the mesh: runs are compared. */
void
check_differences()
{
  const std::string text =
    scene_text(truth, output_of("radius"))
      .replace(scene_text(truth, "").find("  set Cells = 2, 2\n"),
               0,
               "  set Radius = <<2.4 in 2.2..2.7>>\n");
  const auto result = calibrate(text, "radius", 1, true);
  report("radius",
         std::abs(
           result["unknowns"]["Implant / Radius"]["value"].get<double>() - 2.5),
         2.5e-4);
}



int
main()
{
  std::filesystem::remove_all("results");
  {
    Simulation simulation(Scene::from_text(scene_text(truth, "")));
    simulation.run();
    std::ofstream("clean.csv") << torque_table(simulation.rows());
  }
  check_interrupted();
  check_intervals();
  check_differences();
}
