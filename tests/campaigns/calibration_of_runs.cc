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
#include <iomanip>
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



/** All but what a clock has told: how long, and when. */
std::string
without_seconds(nlohmann::ordered_json result)
{
  result.erase("seconds");
  result["provenance"].erase("date");
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



/** 2 % noise, independent from row to row; in few steps, as each fit takes some
 *  fifty runs. */
void
check_intervals()
{
  std::string text =
    scene_text(five, output_of("noise", "  set Noise = 0.02\n"));
  text.replace(text.find("1, 200"), 6, "1, 50");
  const auto     entries = study_variants(read_scene_text(text, "scene"));
  const Unknowns unknowns(entries);
  Misfit         misfit(unknowns, 1, "scene");
  const Eigen::VectorXd start =
    Eigen::Map<const Eigen::VectorXd>(true_values.data(), 5);
  const Eigen::VectorXd clean =
    misfit.evaluate(start, Experiment::By::scene, false).values;
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



/** A number within a modulus that depends on the place: closed forms know no
 *  such bone, and runs are compared, by multigrid one at a time. */
void
check_varying_modulus(const std::string &solver)
{
  const auto scene = [&](const std::string &factor, const std::string &more) {
    return scene_text(truth, more)
      .replace(scene_text(truth, "").find("  set Cells = 8, 8, 2\n"),
               0,
               "  set Young modulus = max(20, " + factor +
                 " * (x + 8)^2)\n  set Bulk solver = " + solver + "\n");
  };
  Simulation simulation(Scene::from_text(scene("10", "")));
  simulation.run();
  std::ofstream("varying.csv") << torque_table(simulation.rows());
  const auto result =
    calibrate(scene("<<c: 8 in 2..40 log>>",
                    "subsection Calibration\n  set Starts = 1\nend\n"
                    "subsection Output\n  set Directory = results/varying\n"
                    "  set Reference curve = varying.csv\nend\n"),
              "varying",
              2,
              true);
  report("a number within a varying modulus, " + solver,
         std::abs(result["unknowns"]["c"]["value"].get<double>() / 10. - 1.),
         1e-4);
}



/** A bond that breaks too fast for the closed form, not for the bodies. */
void
check_without_closed_form()
{
  const auto scene = [](const std::string &a_s, const std::string &more) {
    return scene_text("  set Friction coefficient unbroken = 1\n"
                      "  set Sliding threshold = " +
                        a_s +
                        "\n"
                        "  set Transition factor = 0.3\n"
                        "  set Penalty stiffness = 585\n"
                        "  set Tangential penalty stiffness = 2000\n",
                      more);
  };
  Simulation simulation(Scene::from_text(scene("0.0025", "")));
  simulation.run();
  std::ofstream("fast.csv") << torque_table(simulation.rows());
  const auto result =
    calibrate(scene("<<a_s: 0.0024 in 0.0023..0.0026>>",
                    "subsection Calibration\n  set Starts = 1\nend\n"
                    "subsection Output\n  set Directory = results/fast\n"
                    "  set Reference curve = fast.csv\nend\n"),
              "fast",
              1,
              true);
  report("no closed form at any start: a_s",
         std::abs(result["unknowns"]["a_s"]["value"].get<double>() / 0.0025 -
                  1.),
         1e-4);
}



/** Rigid bodies that are turned. */
std::string
turning_scene(const std::string &rotation,
              const std::string &times,
              const std::string &interface,
              const std::string &more)
{
  return "subsection Bone\n  set Cells = 8, 8, 2\n  set Material = rigid\nend\n"
         "subsection Implant\n  set Cells = 2, 2\n  set Material = rigid\nend\n"
         "subsection Interface\n  set Quadrature points = 4\n" +
         interface +
         "end\n"
         "subsection Chuck\n"
         "  subsection Translation z\n    set Value = -0.0049 * min(t, 1)\n  end\n"
         "  subsection Rotation z\n    set Value = " +
         rotation +
         "\n  end\n"
         "end\n"
         "subsection Load steps\n" +
         times + "end\n" + more;
}



/** To and fro, seen through a rig: the formulas of Experiment, written down
 *  anew. */
void
check_reversal()
{
  const auto scene = [](const std::string &interface, const std::string &more) {
    return turning_scene("4 * max(t - 1, 0) - 7 * max(t - 2, 0)",
                         "  set Times = 0, 1, 2, 3\n  set Steps = 1, 80, 80\n",
                         interface,
                         more);
  };
  Simulation simulation(Scene::from_text(scene(truth, "")));
  simulation.run();
  constexpr double offset = 0.3, slack = 0.4, compliance = 0.01;
  std::ofstream    file("reversal.csv");
  file << "angle_deg,torque_Nmm\n" << std::setprecision(15);
  for (const TorqueRow &row : simulation.rows())
    if (row.step > 1)
      file << row.angle_deg + offset + (row.torque_Nmm >= 0. ? slack : 0.) +
                compliance * row.torque_Nmm
           << ',' << row.torque_Nmm << '\n';
  file.close();
  const auto result = calibrate(
    scene("  set Friction coefficient unbroken = <<mu_ub: 0.5 in 0.4..0.8>>\n"
          "  set Sliding threshold = 0.022\n"
          "  set Transition factor = 0.74\n"
          "  set Penalty stiffness = 585\n"
          "  set Tangential penalty stiffness = 400\n",
          "subsection Calibration\n"
          "  set Angle offset       = <<offset: 0.2 in 0..1>>\n"
          "  set Slack              = <<slack: 0.3 in 0..1>>\n"
          "  set Machine compliance = <<compliance: 0.005 in 0..0.05>>\n"
          "  set Starts             = 1\n"
          "end\n"
          "subsection Output\n  set Directory = results/reversal\n"
          "  set Reference curve = reversal.csv\nend\n"),
    "reversal",
    1,
    true);
  const std::vector<std::pair<std::string, double>> expected{{"mu_ub", 0.58},
                                                             {"offset", offset},
                                                             {"slack", slack},
                                                             {"compliance",
                                                              compliance}};
  for (const auto &[name, value] : expected)
    report("to and fro: " + name,
           std::abs(result["unknowns"][name]["value"].get<double>() / value -
                    1.),
           1e-4);
}



/** A turn back by an eightieth of the range. */
void
check_small_turn()
{
  const auto scene = [](const std::string &interface, const std::string &more) {
    return turning_scene(
      "4 * max(t - 1, 0) - 4.1 * max(t - 2, 0) + 4.2 * max(t - 3, 0) - "
      "12.1 * max(t - 4, 0)",
      "  set Times = 0, 1, 2, 3, 4, 5\n  set Steps = 1, 40, 10, 40, 80\n",
      interface,
      more);
  };
  Simulation simulation(Scene::from_text(scene(truth, "")));
  simulation.run();
  std::ofstream("small_turn.csv") << torque_table(simulation.rows());
  std::string law = truth;
  law.replace(law.find("0.58"), 4, "<<mu_ub: 0.5 in 0.4..0.8>>");
  const auto result =
    calibrate(scene(law,
                    "subsection Calibration\n  set Starts = 1\nend\n"
                    "subsection Output\n  set Directory = results/small\n"
                    "  set Reference curve = small_turn.csv\nend\n"),
              "small",
              1,
              true);
  report("a small turn: mu_ub",
         std::abs(result["unknowns"]["mu_ub"]["value"].get<double>() / 0.58 -
                  1.),
         1e-4);
}



/** Pressed and lifted: force over depth, of a column that is not the torque. */
void
check_press()
{
  const auto scene = [](const std::string &eps_n, const std::string &more) {
    return "subsection Bone\n  set Cells = 8, 8, 2\n  set Material = linear\nend\n"
           "subsection Implant\n  set Cells = 2, 2\n  set Material = linear\nend\n"
           "subsection Interface\n  set Quadrature points = 4\n"
           "  set Penalty stiffness = " +
           eps_n +
           "\nend\n"
           "subsection Chuck\n"
           "  subsection Translation z\n"
           "    set Value = -0.005 * min(t, 1) + 0.006 * max(t - 1, 0)\n  end\n"
           "  subsection Rotation z\n    set Value = 0\n  end\n"
           "end\n"
           "subsection Load steps\n  set Times = 0, 1, 2\n"
           "  set Steps = 10, 12\nend\n" +
           more;
  };
  Simulation simulation(Scene::from_text(scene("585", "")));
  simulation.run();
  std::ofstream("press.csv") << torque_table(simulation.rows());
  const auto result =
    calibrate(scene("<<eps_n: 1000 in 100..5000 log>>",
                    "subsection Calibration\n"
                    "  set Curves = chuck_Fz_N\n  set Over   = chuck_uz_mm\n"
                    "end\n"
                    "subsection Output\n  set Directory = results/press\n"
                    "  set Reference curve = press.csv\nend\n"),
              "press",
              1,
              true);
  report("force over depth: eps_n",
         std::abs(result["unknowns"]["eps_n"]["value"].get<double>() / 585. -
                  1.),
         1e-4);
  report("rows of press and lift but the one at the turn",
         result["measured_values"].get<unsigned int>() == 22);
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
  for (const std::string solver : {"direct", "multigrid"})
    check_varying_modulus(solver);
  check_without_closed_form();
  check_reversal();
  check_small_turn();
  check_press();
}
