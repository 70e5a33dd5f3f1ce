// Calibrations of made-up curves whose parameters are known, with closed forms:
// curves without noise give them back; intervals hold the true values as often
// as they say in 1000 curves with noise; what a torque curve cannot tell is
// named, and which test would.

#include <debond/campaigns/calibration.h>
#include <debond/input/parameter_loop.h>
#include <debond/models/closed_form_solution.h>
#include <debond/output/report_page.h>
#include <debond/support/input_error.h>

#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
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



unsigned int n_calibrations = 0;

std::string
calibration_of(const std::string &file, const std::string &entries)
{
  return "subsection Calibration\n" + entries +
         "end\n"
         "subsection Output\n  set Directory = results/" +
         std::to_string(++n_calibrations) +
         "\n  set Reference curve = " + file + "\nend\n";
}



/** The warnings of all calibrations that were shown on the console are those
 *  of calibration.json and of the page. */
bool one_list = true;

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
  std::istringstream       lines(out.str());
  std::string              line;
  std::vector<std::string> warnings;
  const std::string        warning = "warning: ";
  while (std::getline(lines, line))
    {
      if (line.rfind(warning, 0) == 0)
        warnings.push_back(line.substr(warning.size()));
      // words, and no numbers that are rounding
      if (show && (line.rfind("warning: the curves", 0) == 0 ||
                   line.rfind("Experiment", 0) == 0))
        std::cout << "  " << line.substr(0, line.find_first_of("(+")) << '\n';
    }
  std::ifstream file(directory + "/calibration.json");
  if (!file)
    return {};
  auto               json = nlohmann::ordered_json::parse(file);
  std::ifstream      page(directory + "/report.html");
  std::ostringstream html;
  html << page.rdbuf();
  one_list = one_list && json["warnings"] == warnings;
  for (const std::string &said : warnings)
    one_list = one_list && html.str().find("<li>" + ReportPage::escaped(said) +
                                           "</li>") != std::string::npos;
  return json;
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
                                "{{<<0 in -1..1>>||<<0 in -1..1>>}}\n")),
      false),
    {{"Interface / Friction coefficient broken", 0.4},
     {a_s, 0.022},
     {"Calibration / Angle offset (experiment 1)", 0.},
     {"Calibration / Angle offset (experiment 2)", -0.1}});
}



/** A closed form that has no derivatives of its own, and an unknown of the rig
 *  only. */
void
check_rig_alone()
{
  std::string scene = scene_text(truth, "0.0049", "");
  scene.replace(0, scene.find('\n'), "set Model = analytical");
  measure("analytical.csv", scene, 0., 1.5);
  const std::string more =
    calibration_of("analytical.csv", "  set Torque offset = <<0 in -5..5>>\n");
  check_values("rig alone",
               calibrate("rig alone", scene + more, false),
               {{"Calibration / Torque offset", 1.5}});
}



/** Every other row is wrong, and said to be uncertain. */
void
check_uneven_noise()
{
  std::ifstream clean("clean.csv");
  std::ofstream file("uneven.csv");
  std::string   line;
  std::getline(clean, line);
  file << "angle_deg,torque_Nmm,sd_Nmm\n";
  for (unsigned int i = 0; std::getline(clean, line); ++i)
    {
      std::istringstream row(line);
      double             angle, torque;
      char               comma;
      row >> angle >> comma >> torque;
      if (i % 2 == 0)
        file << angle << ',' << std::setprecision(15) << torque << ",0.01\n";
      else
        file << angle << ',' << 1.5 * torque << ",1e6\n";
    }
  file.close();
  check_values(
    "rows with noise of their own",
    calibrate(
      "uneven",
      scene_text("  set Friction coefficient unbroken = <<0.5 in 0.3..1.2>>\n"
                 "  set Sliding threshold = <<0.01 in 0.004..0.1 log>>\n"
                 "  set Tangential penalty stiffness = 700\n",
                 "0.0049",
                 calibration_of("uneven.csv",
                                "  set Noise columns = sd_Nmm\n"
                                "  set Largest misfit = 1\n") +
                   "subsection Output\n"
                   "  set Reference columns = angle_deg, torque_Nmm\n"
                   "end\n"),
      false),
    {{mu_ub, 0.58}, {a_s, 0.022}});
}



/** clean.csv with noise, over the largest value, and @p factor for each row. */
void
spoil(const std::string                     &filename,
      const double                           noise,
      const std::function<double(unsigned)> &factor)
{
  std::ifstream              clean("clean.csv");
  std::ofstream              file(filename);
  std::string                line;
  std::mt19937               generator(1);
  std::normal_distribution<> normal;
  std::getline(clean, line);
  file << "angle_deg,torque_Nmm\n" << std::setprecision(15);
  for (unsigned int i = 0; std::getline(clean, line); ++i)
    {
      std::istringstream row(line);
      double             angle, torque;
      char               comma;
      row >> angle >> comma >> torque;
      file << angle << ','
           << factor(i) * torque + 53. * noise * normal(generator) << '\n';
    }
}

const std::string two =
  "  set Friction coefficient unbroken = <<mu_ub: 0.5 in 0.3..1.2>>\n"
  "  set Sliding threshold = <<a_s: 0.01 in 0.004..0.1 log>>\n"
  "  set Tangential penalty stiffness = 700\n";



nlohmann::ordered_json
calibrate_two(const std::string &name,
              const std::string &file,
              const std::string &entries,
              const std::string &law = two)
{
  return calibrate(name,
                   scene_text(law, "0.0049", calibration_of(file, entries)),
                   false);
}



/** The mean of magnitudes does not mind a few rows that are wrong. */
void
check_other_measures()
{
  spoil("outliers.csv", 0., [](const unsigned int i) {
    return i % 20 == 10 ? 1.2 : 1.;
  });
  for (const std::string measure : {"e_mp", "e_rel", "least squares"})
    {
      const auto   result = calibrate_two(measure,
                                        "outliers.csv",
                                        "  set Measure = " + measure + "\n");
      const double value  = result["unknowns"]["mu_ub"]["value"];
      const bool   is_met = std::abs(value - 0.58) < 1e-3;
      report(measure + (measure == "least squares" ?
                          " is led astray by wrong rows" :
                          " is not led astray by wrong rows"),
             is_met == (measure != "least squares"));
    }
}



/** Intervals of e_mp, which come from residuals that are drawn anew. */
void
check_coverage_of_e_mp()
{
  const auto            entries = study_variants(read_scene_text(
    scene_text(two,
               "0.0049",
               calibration_of("clean.csv", "  set Measure = e_mp\n")),
    "e_mp"));
  const Unknowns        unknowns(entries);
  Misfit                misfit(unknowns, 1, "e_mp");
  const Eigen::VectorXd clean = misfit.measured;
  Eigen::VectorXd       true_values(2);
  true_values << 0.58, 0.022;
  std::array<unsigned int, 2> held{};
  std::mt19937                generator(1);
  std::normal_distribution<>  normal;
  for (unsigned int i = 0; i < 100; ++i)
    {
      for (Eigen::Index k = 0; k < clean.size(); ++k)
        misfit.measured[k] = clean[k] * (1. + 0.02 * normal(generator));
      const Optimum best =
        minimise(misfit, true_values, Experiment::By::closed_form);
      const FitStatistics statistics(
        misfit,
        best.unknowns,
        misfit.evaluate(best.unknowns, Experiment::By::closed_form, true));
      for (unsigned int j = 0; j < 2; ++j)
        held[j] += statistics.unknowns[j].lower <= true_values[j] &&
                   true_values[j] <= statistics.unknowns[j].upper;
    }
  for (unsigned int j = 0; j < 2; ++j)
    report("interval of e_mp of " + unknowns.list[j].name +
             " holds in at least 89 of 100 curves",
           held[j] >= 89);
}



/** What a fit says of itself where it is right, and where it is not. */
void
check_warnings()
{
  const auto says = [](const nlohmann::ordered_json &result,
                       const std::string            &words) {
    for (const std::string warning : result["warnings"])
      if (warning.find(words) != std::string::npos)
        return true;
    return false;
  };
  const auto one = [](const unsigned int) { return 1.; };
  spoil("noise.csv", 0.02, one);
  report("no warning of a right fit",
         calibrate_two("right", "noise.csv", "  set Noise = 0.02\n")["warnings"]
           .empty());
  report("noise that is larger than stated is told",
         says(calibrate_two("large", "noise.csv", "  set Noise = 0.005\n"),
              "the noise is more"));
  report("noise that is smaller than stated is told",
         says(calibrate_two("small", "noise.csv", "  set Noise = 0.08\n"),
              "the noise is less"));
  spoil("smooth.csv", 0.005, [](const unsigned int i) {
    return 1. + 0.03 * std::sin(0.1 * i);
  });
  report("smooth residuals are told",
         says(calibrate_two("smooth", "smooth.csv", ""), "the same sign"));
  const auto bound = calibrate_two(
    "bound",
    "noise.csv",
    "",
    "  set Friction coefficient unbroken = <<mu_ub: 0.5 in 0.3..0.55>>\n"
    "  set Sliding threshold = <<a_s: 0.01 in 0.004..0.1 log>>\n"
    "  set Tangential penalty stiffness = 700\n");
  report("a bound that was hit is told",
         bound["unknowns"]["mu_ub"]["at_bound"] == true &&
           bound["unknowns"]["a_s"]["at_bound"] == false &&
           says(bound, "mu_ub ends at one of its bounds"));
}



/** Where the curve is nearly straight in the unknowns the profile is the
 *  parabola of the covariance: (1.96 k / 2)^2 at k half widths / 2. */
void
check_profiles()
{
  const auto    result = calibrate_two("profile",
                                    "clean.csv",
                                    "  set Noise    = 0.005\n"
                                       "  set Profiles = true\n");
  std::ifstream file("results/" + std::to_string(n_calibrations) +
                     "/profile.csv");
  std::string   line;
  double        worst = 0.;
  unsigned int  n     = 0;
  std::getline(file, line);
  while (std::getline(file, line))
    {
      const auto   name  = line.substr(0, line.find(','));
      const auto   rest  = line.substr(line.find(',') + 1);
      const double value = std::stod(rest),
                   chi   = std::stod(rest.substr(rest.find(',') + 1));
      const auto &known  = result["unknowns"][name];
      const auto  scale  = [&](const double x) {
        return known["logarithmic"] ? std::log(x) : x;
      };
      const double best     = scale(known["value"]),
                   sd       = (scale(known["upper_95"]) - best) / 1.96,
                   expected = std::pow((scale(value) - best) / sd, 2);
      grow(worst, std::abs(chi - expected) / 15.37);
      ++n;
    }
  report("11 points for each of two profiles", n == 22);
  report("profiles against the parabola, over the largest", worst, 0.05);
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
  Misfit                misfit(unknowns, 1, "coverage");
  const Eigen::VectorXd clean = misfit.measured;
  Eigen::VectorXd       true_values(5);
  true_values << 0.58, 0.022, 0.74, 585, 700;
  Eigen::VectorXd            held = Eigen::VectorXd::Zero(5);
  std::mt19937               generator(1);
  std::normal_distribution<> normal;
  constexpr unsigned int     n = 1000, row = 20; // after the largest torque
  double                     held_by_band = 0.;
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
      held_by_band +=
        std::abs(best.values[row] - clean[row]) <= statistics.band[row];
      for (unsigned int j = 0; j < 5; ++j)
        held[j] += statistics.unknowns[j].lower <= true_values[j] &&
                   true_values[j] <= statistics.unknowns[j].upper;
    }
  report("the band holds the curve in 93 to 97 % of them",
         std::abs(held_by_band / n - 0.95) <= 0.02);
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
  report("correlation of -1",
         std::abs(result["correlations"]["mu_b | depth"].get<double>() + 1.),
         1e-6);
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
  check_rig_alone();
  check_uneven_noise();
  check_other_measures();
  check_coverage_of_e_mp();
  check_warnings();
  check_profiles();
  check_coverage();
  check_what_cannot_be_told();
  report("console, calibration.json and page have the same warnings", one_list);
}
