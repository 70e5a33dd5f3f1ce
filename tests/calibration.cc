// Calibrations of made-up curves whose parameters are known, with closed forms:
// curves without noise give them back; intervals hold the true values as often
// as they say in 1000 curves with noise; what a torque curve cannot tell is
// named, and which test would.

#include <debond/campaigns/calibration.h>
#include <debond/input/parameter_loop.h>
#include <debond/models/closed_form_solution.h>
#include <debond/support/input_error.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "checks.h"

using namespace Debond;

/** Rigid bodies, 585 and 700 MPa/mm, mu 0.4 and 0.58, 22 um, 0.74, 4.9 um. */
std::string
scene_text(const std::string &law,
           const std::string &depth,
           const std::string &more)
{
  return "set Model = foundation\n"
         "subsection Bone\n  set Material = rigid\nend\n"
         "subsection Implant\n  set Material = rigid\nend\n"
         "subsection Interface\n" +
         law +
         "end\n"
         "subsection Chuck\n"
         "  subsection Translation z\n    set Value = -" +
         depth +
         " * min(t, 1)\n  end\n"
         "  subsection Rotation z\n    set Value = 10 * max(t - 1, 0)\n  end\n"
         "end\n"
         "subsection Load steps\n  set Steps = 1, 200\nend\n" +
         more;
}

const std::string truth = "  set Friction coefficient unbroken = 0.58\n"
                          "  set Sliding threshold = 0.022\n"
                          "  set Transition factor = 0.74\n"
                          "  set Penalty stiffness = 585\n"
                          "  set Tangential penalty stiffness = 700\n";

const std::string five =
  "  set Friction coefficient unbroken = <<0.5 in 0.3..1.2>>\n"
  "  set Sliding threshold = <<0.01 in 0.004..0.1 log>>\n"
  "  set Transition factor = <<0.5 in 0.1..3>>\n"
  "  set Penalty stiffness = <<400 in 100..3000 log>>\n"
  "  set Tangential penalty stiffness = <<400 in 100..3000 log>>\n";



/** A measured curve, as the scene with these values predicts it: angles [deg],
 *  torque [N mm], axial force [N] at 200 angles, seen through a rig. */
void
measure(const std::string &filename,
        const std::string &scene,
        const double       angle_offset  = 0.,
        const double       torque_offset = 0.)
{
  const ClosedFormSolution solution(Scene::from_text(scene));
  std::ofstream            file(filename);
  file.precision(15);
  file << "angle_deg,torque_Nmm,chuck_Fz_N\n";
  for (const TorqueRow &row : solution.rows)
    if (row.angle_deg > 0.)
      file << row.angle_deg + angle_offset << ','
           << row.torque_Nmm + torque_offset << ',' << row.chuck_reaction[2]
           << '\n';
}



std::string
calibration_of(const std::string &file, const std::string &entries)
{
  static unsigned int n = 0;
  return "subsection Calibration\n" + entries +
         "end\n"
         "subsection Output\n  set Directory = results/" +
         std::to_string(++n) + "\n  set Reference curve = " + file + "\nend\n";
}



/** What a calibration prints but for seconds and counts, and its results. */
nlohmann::ordered_json
calibrate(const std::string &name, const std::string &text, const bool show)
{
  std::ostringstream out;
  const auto  entries = read_scene_text("set Task = calibrate\n" + text, name);
  std::string directory;
  for (const SceneEntry &entry : entries)
    if (entry.name == "Directory")
      directory = entry.value;
  try
    {
      run_calibration(entries, name, 2, true, out);
    }
  catch (const std::exception &error)
    {
      std::cout << name << ": " << error.what() << '\n';
    }
  std::istringstream lines(out.str());
  std::string        line;
  // words, and no numbers that are rounding
  while (show && std::getline(lines, line))
    if (line.rfind("warning: the curves", 0) == 0 ||
        line.rfind("Experiment", 0) == 0)
      std::cout << "  " << line.substr(0, line.find_first_of("(+")) << '\n';
  std::ifstream file(directory + "/calibration.json");
  return file ? nlohmann::ordered_json::parse(file) : nlohmann::ordered_json();
}



void
check_values(const std::string                                 &name,
             const nlohmann::ordered_json                      &result,
             const std::vector<std::pair<std::string, double>> &expected)
{
  for (const auto &[unknown, value] : expected)
    report(name + ": " + unknown,
           std::abs(result["unknowns"][unknown]["value"].get<double>() -
                    value) /
             std::max(1e-3, std::abs(value)),
           1e-4);
}

const std::string mu_ub = "Interface / Friction coefficient unbroken",
                  a_s   = "Interface / Sliding threshold",
                  b_s   = "Interface / Transition factor",
                  eps_n = "Interface / Penalty stiffness",
                  eps_t = "Interface / Tangential penalty stiffness";



void
check_exact_curves()
{
  const std::string both = "  set Curves = torque_Nmm, chuck_Fz_N\n";
  measure("clean.csv", scene_text(truth, "0.0049", ""));
  check_values(
    "five unknowns",
    calibrate("five",
              scene_text(five, "0.0049", calibration_of("clean.csv", both)),
              false),
    {{mu_ub, 0.58}, {a_s, 0.022}, {b_s, 0.74}, {eps_n, 585}, {eps_t, 700}});

  // the rig, with the friction coefficient tied to another unknown
  measure("rig.csv", scene_text(truth, "0.0049", ""), 0.2, 1.5);
  check_values(
    "rig and tie",
    calibrate(
      "rig",
      scene_text(
        "  set Friction coefficient broken = <<mu_b: 0.3 in 0.1..0.8>>\n"
        "  set Friction coefficient unbroken = <<1.45 * mu_b>>\n"
        "  set Sliding threshold = <<0.01 in 0.004..0.1 log>>\n"
        "  set Tangential penalty stiffness = 700\n",
        "0.0049",
        calibration_of("rig.csv",
                       "  set Angle offset = <<0 in -1..1>>\n"
                       "  set Torque offset = <<0 in -5..5>>\n")),
      false),
    {{"mu_b", 0.4},
     {a_s, 0.022},
     {"Calibration / Angle offset", 0.2},
     {"Calibration / Torque offset", 1.5}});

  // two loads, which share the friction and not the offset
  measure("double.csv", scene_text(truth, "0.0098", ""), -0.1);
  check_values(
    "two experiments",
    calibrate(
      "two",
      scene_text("  set Friction coefficient broken = <<0.3 in 0.1..0.8>>\n"
                 "  set Sliding threshold = <<0.01 in 0.004..0.1 log>>\n"
                 "  set Tangential penalty stiffness = 700\n",
                 "{{0.0049||0.0098}}",
                 calibration_of("{{clean.csv||double.csv}}",
                                "  set Angle offset = "
                                "{{0||<<0 in -1..1>>}}\n")),
      false),
    {{"Interface / Friction coefficient broken", 0.4},
     {a_s, 0.022},
     {"Calibration / Angle offset (experiment 2)", -0.1}});
}



/** Of 1000 curves of torque and force with a noise of 2 % of their largest
 *  values: how often the 95 % intervals hold the true values. */
void
check_coverage()
{
  const auto            entries = study_variants(read_scene_text(
    scene_text(five,
               "0.0049",
               calibration_of("clean.csv",
                              "  set Curves = torque_Nmm, chuck_Fz_N\n"
                                         "  set Noise = 0.02\n")),
    "coverage"));
  const Unknowns        unknowns(entries);
  Misfit                misfit(unknowns, 1, "coverage", nullptr);
  const Eigen::VectorXd clean = misfit.measured;
  Eigen::VectorXd       true_values(5);
  true_values << 0.58, 0.022, 0.74, 585, 700;
  Eigen::VectorXd            held = Eigen::VectorXd::Zero(5);
  std::mt19937               generator(1);
  std::normal_distribution<> normal;
  constexpr unsigned int     n = 1000;
  for (unsigned int i = 0; i < n; ++i)
    {
      misfit.measured = clean.unaryExpr([](const double) { return 0.; });
      for (Eigen::Index k = 0; k < clean.size(); ++k)
        misfit.measured[k] = clean[k] + normal(generator) / misfit.weights[k];
      const Optimum best =
        minimise(misfit, true_values, Experiment::By::closed_form);
      const FitStatistics statistics(
        misfit,
        best.unknowns,
        misfit.evaluate(best.unknowns, Experiment::By::closed_form, true));
      for (unsigned int j = 0; j < 5; ++j)
        held[j] += statistics.unknowns[j].lower <= true_values[j] &&
                   true_values[j] <= statistics.unknowns[j].upper;
    }
  for (unsigned int j = 0; j < 5; ++j)
    report("95 % interval of " + unknowns.list[j].name + " holds in " +
             "93 to 97 % of 1000 curves",
           std::abs(held[j] / n - 0.95) <= 0.02);
}



/** Friction coefficients and load appear as products. */
void
check_what_cannot_be_told()
{
  const std::string products =
    "  set Friction coefficient broken = <<mu_b: 0.3 in 0.1..0.8 log>>\n"
    "  set Friction coefficient unbroken = <<1.45 * mu_b>>\n"
    "  set Tangential penalty stiffness = 700\n";
  const std::string depth = "<<depth: 0.006 in 0.002..0.02 log>>";
  std::cout << "torque alone:\n";
  auto result =
    calibrate("product",
              scene_text(products, depth, calibration_of("clean.csv", "")),
              true);
  std::cout << "and what the axial force would tell:\n";
  result = calibrate("candidate",
                     scene_text(products,
                                depth,
                                calibration_of("{{clean.csv||}}",
                                               "  set Curves = "
                                               "{{torque_Nmm||torque_Nmm, "
                                               "chuck_Fz_N}}\n")),
                     true);
  std::cout << "no fit:\n";
  calibrate(
    "no fit",
    scene_text("  set Friction coefficient broken = <<0.5 in 0.6..0.8>>\n",
               "0.0049",
               calibration_of("clean.csv", "")),
    false);
  calibrate(
    "no fit",
    scene_text("  set Friction coefficient broken = <<0.7 in 0.6..0.8>>\n",
               "0.0049",
               calibration_of("clean.csv", "")),
    false);
}



int
main()
{
  std::filesystem::remove_all("results");
  check_exact_curves();
  check_coverage();
  check_what_cannot_be_told();
}
