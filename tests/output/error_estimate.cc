// Errors that are estimated from the difference of two runs, written by hand:
// shares of cells, steps and linear bodies, of all rows, and of members of
// summary.json; curves that jump, along a path, of forces, and of positions
// under a load; and why an error is not known.

#include <debond/output/error_estimate.h>
#include <debond/output/result_files.h>
#include <debond/support/runtime.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "checks.h"
#include "coin_scene.h"
#include "pressed_and_turned.h"

using namespace Debond;
using Json    = nlohmann::ordered_json;
using Changes = std::vector<std::string>;

const std::string coarser = "results/error_estimate/coarser";



void
check(const std::string &what, const double value, const double expected)
{
  const bool equal =
    std::isnan(expected) ?
      std::isnan(value) :
      std::abs(value - expected) <= 1e-10 * std::max(1., std::abs(expected));
  std::cout << "  " << what << ": ";
  if (equal)
    std::cout << "yes" << std::endl;
  else
    std::cout << "NO, " << value << " instead of " << expected << std::endl;
}



/** Time, angle [deg], torque [N mm], energy that jumps have released [N mm]. */
using Sample = std::array<double, 4>;

std::vector<TorqueRow>
turned(const std::vector<Sample> &samples)
{
  std::vector<TorqueRow> rows;
  for (const auto &[time, angle, torque, released] : samples)
    {
      TorqueRow row;
      row.step                = rows.size();
      row.time                = time;
      row.angle_deg           = angle;
      row.chuck_position[5]   = angle;
      row.torque_Nmm          = torque;
      row.released_energy_Nmm = released;
      rows.push_back(row);
    }
  return rows;
}



/** Leaves a coarser run, without a curve between its rows. */
void
leave_coarser(const std::vector<TorqueRow> &rows,
              const Json                   &summary,
              const std::string            &file = "torque.csv")
{
  std::filesystem::remove_all(coarser);
  std::filesystem::create_directories(coarser);
  write_json(coarser + "/summary.json", summary);
  std::ofstream(coarser + "/" + file) << torque_table(rows);
}



/** Cells of splines whose steps keep 0.25 %, unless changed. */
Scene
scene_of(const Changes &changes, const std::string &text = pressed_and_turned)
{
  Changes all{"Accuracy=1 %"};
  all.insert(all.end(), changes.begin(), changes.end());
  return coin_scene(text, all);
}



const Json own_summary{{"T_max_Nmm", 40.},
                       {"theta_max_deg", 5.},
                       {"T_inf_Nmm", 30.},
                       {"initial_stiffness_Nmm_per_rad", 500.},
                       {"pressure_MPa", NAN},
                       {"E_deb_Nmm", 12.},
                       {"E_fric_Nmm", 10.},
                       {"W_adh_Nmm", 2.},
                       {"E_bulk_Nmm", 1.},
                       {"E_interface_Nmm", 9.},
                       {"change_at_large_strains", 0.1}},
  summary_of_coarser{{"converged", true},
                     {"T_max_Nmm", 38.},
                     {"theta_max_deg", 7.5},
                     {"T_inf_Nmm", 28.},
                     {"initial_stiffness_Nmm_per_rad", 480.},
                     {"pressure_MPa", 2.5},
                     {"E_deb_Nmm", 12.},
                     {"E_fric_Nmm", 10.},
                     {"W_adh_Nmm", 2.},
                     {"E_bulk_Nmm", 1.2},
                     {"E_interface_Nmm", 9.}};

/** At t = 1.5 the coarser curve is 11 N mm lower, halfway between its rows, at
 *  the end 2 N mm. */
const std::vector<Sample> own_curve{{{0, 0, 0, 0}},
                                    {{1, 0, 0, 0}},
                                    {{1.5, 5, 40, 0}},
                                    {{2, 10, 30, 0}}},
  curve_of_coarser{{{0, 0, 0, 0}},
                   {{1, 0, 0, 0}},
                   {{1.25, 2.5, 20, 0}},
                   {{1.75, 7.5, 38, 0}},
                   {{2, 10, 28, 0}}};
constexpr double of_steps = 0.0025, of_bodies = 0.01; // a tenth of a tenth

ErrorEstimate
estimate(const Changes             &changes,
         const std::vector<Sample> &curve   = own_curve,
         const Json                &summary = own_summary)
{
  return {scene_of(changes), turned(curve), summary, coarser};
}



void
test_parts()
{
  std::cout << "Parts of the error" << std::endl;
  leave_coarser(turned(curve_of_coarser), summary_of_coarser);
  const ErrorEstimate errors = estimate({});
  report("  it is known", errors.why_unknown.empty());
  check("cells, a half of the largest difference",
        errors.cells,
        0.5 * 11. / 40.);
  check("steps, their tolerance", errors.steps, of_steps);
  check("linear bodies, by their share of the energy",
        errors.bodies,
        of_bodies);
  check("the sum", errors.total, 0.1375 + of_steps + of_bodies);
  const std::vector<double> of_rows{0., 0., 5.5, 1.};
  report("  an error for each row", errors.of_rows.size() == of_rows.size());
  for (std::size_t i = 0; i < errors.of_rows.size(); ++i)
    check("row " + std::to_string(i),
          errors.of_rows[i],
          of_rows.at(i) + (of_steps + of_bodies) * 40.);
  report("  of the torque", errors.column == "torque_Nmm");

  std::cout << "Members of the summary" << std::endl;
  const auto member = [&errors](const std::string &name) {
    return number_in(errors.members, name + "_error");
  };
  // half of the error of the curve, 0.1375, where the difference is less
  constexpr double least = 0.5 * 0.1375 + of_steps + of_bodies;
  check("largest torque", member("T_max_Nmm"), least * 40.);
  check("its angle, of which steps say nothing", member("theta_max_deg"), 1.25);
  check("torque at the end", member("T_inf_Nmm"), least * 30.);
  check("stiffness", member("initial_stiffness_Nmm_per_rad"), least * 500.);
  check("energy, a square", member("E_bulk_Nmm"), 0.1375 + 2. * 0.0125);
  check("a difference of two areas that are both off",
        member("W_adh_Nmm"),
        least * (12. + 10.));
  check("what is not known", member("pressure_MPa"), NAN);
  report("  no other curve", !errors.members.contains("curve"));

  std::cout << "Other parts" << std::endl;
  check("trilinear cells",
        estimate({"Bone/Element=trilinear"}).cells,
        2. * 11. / 40.);
  check("trilinear cells of a rigid body",
        estimate({"Implant/Element=trilinear", "Implant/Material=rigid"}).cells,
        0.5 * 11. / 40.);
  check("a bond that ends across cells",
        estimate({"Interface/Bonding/Pattern=disk",
                  "Interface/Bonding/Bonded fraction=0.55"})
          .cells,
        11. / 40.);
  // without the row at 1.5 there is the chord from 0 to 30 N mm
  const ErrorEstimate straight = estimate({"Load steps/Adaptive=false"});
  check("planned steps, by chords", straight.steps, 25. / 40.);
  check("cells then, at the times of the coarser run",
        straight.cells,
        0.5 * 3. / 40.);
  check("a phase in one step, by its change",
        estimate({"Load steps/Adaptive=false"},
                 {{{0, 0, 0, 0}}, {{1, 0, 0, 0}}, {{2, 10, 30, 0}}})
          .steps,
        1.);
  check("steps of the scene",
        estimate({"Load steps/Tolerance=0.02"}).total,
        0.1375 + 0.02 + of_bodies);
  Json other                       = own_summary;
  other["change_at_large_strains"] = 0.;
  check("bodies that were not linear",
        estimate({}, own_curve, other).bodies,
        0.);
  other.erase("change_at_large_strains");
  check("bodies of which nothing is said",
        estimate({}, own_curve, other).bodies,
        0.);

  // the larger one of curve, peak and stiffness
  other                                  = summary_of_coarser;
  other["initial_stiffness_Nmm_per_rad"] = 300.;
  leave_coarser(turned(curve_of_coarser), other);
  check("a stiffness that is worse than the curve",
        estimate({}).total,
        (100. + 0.0125 * 500.) / 500.);
  other["initial_stiffness_Nmm_per_rad"] = 480.;
  other["T_max_Nmm"]                     = 20.;
  leave_coarser(turned(curve_of_coarser), other);
  check("a peak that is", estimate({}).total, (10. + 0.0125 * 40.) / 40.);
}



void
test_other_scenes()
{
  std::cout << "More cells instead of fewer" << std::endl;
  Json own = own_summary, other = summary_of_coarser;
  own["unknowns"]   = 100;
  other["unknowns"] = 300;
  leave_coarser(turned(curve_of_coarser), other);
  check("cells, half the difference and all of it",
        estimate({}, own_curve, own).cells,
        1.5 * 11. / 40.);

  std::cout << "Rounding as a torque" << std::endl;
  std::vector<TorqueRow> rows = turned(own_curve);
  for (TorqueRow &row : rows)
    {
      row.torque_Nmm *= 1e-8;
      row.chuck_reaction[2] = -50.;
    }
  const ErrorEstimate noise(scene_of({}), rows, own_summary, coarser);
  std::cout << "  " << noise.why_unknown << std::endl;
  check("no error", noise.total, NAN);

  std::cout << "Under a moment" << std::endl;
  leave_coarser(turned(curve_of_coarser), summary_of_coarser);
  const ErrorEstimate loaded =
    estimate({"Chuck/Rotation z/Control=moment",
              "Chuck/Rotation z/Value=40 * max(t - 1, 0)"});
  report("  the moment has no error",
         !loaded.members.contains("T_max_Nmm_error"));
  report("  its angle has", loaded.members["theta_max_deg_error"] >= 1.25);

  std::cout << "A flat peak" << std::endl;
  const ErrorEstimate flat = estimate({},
                                      {{{0, 0, 0, 0}},
                                       {{1, 0, 0, 0}},
                                       {{1.3, 3, 39.95, 0}},
                                       {{1.5, 5, 40, 0}},
                                       {{2, 10, 30, 0}}});
  check("may be anywhere within the error of the steps",
        number_in(flat.members, "theta_max_deg_error"),
        2.);
}



// What is between rows of the coarser run is drawn, if it has a curve.
void
test_finest_curve()
{
  std::cout << "Between the rows of the coarser run" << std::endl;
  leave_coarser(turned({{{0, 0, 0, 0}}, {{1, 0, 0, 0}}, {{2, 10, 28, 0}}}),
                summary_of_coarser);
  check("lines", estimate({}).cells, 0.5 * 26. / 40.);
  std::ofstream(coarser + "/curve.csv")
    << torque_table(turned(curve_of_coarser), true);
  check("its curve", estimate({}).cells, 0.5 * 11. / 40.);
}



/** Jumps down by 20 N mm at 5 degrees; 1 degree and 0.1 later with fewer cells.
 */
const std::vector<Sample> own_jump{{{0, 0, 0, 0}},
                                   {{1, 0, 0, 0}},
                                   {{1.4, 4, 40, 0}},
                                   {{1.5, 5, 20, 3}},
                                   {{2, 10, 18, 3}}},
  jump_of_coarser{{{0, 0, 0, 0}},
                  {{1, 0, 0, 0}},
                  {{1.5, 5, 38, 0}},
                  {{1.6, 6, 19, 2.5}},
                  {{2, 10, 17, 2.5}}};

void
test_jumps()
{
  std::cout << "A jump" << std::endl;
  leave_coarser(turned(jump_of_coarser), summary_of_coarser);
  const ErrorEstimate errors = estimate({}, own_jump);
  // before it 40 - 0.8 * 38, behind both 18 - 17; 20 - 38 does not count
  check("cells, without what is within it", errors.cells, 0.5 * 9.6 / 40.);
  check("before it",
        number_in(errors.members, "error_before_jump"),
        0.12 + of_steps + of_bodies);
  check("after it",
        number_in(errors.members, "error_after_jump"),
        0.0125 + of_steps + of_bodies);
  check("its position",
        number_in(errors.members, "error_of_jump_position"),
        1.);
  report("  an error for each row", errors.of_rows.size() == own_jump.size());

  std::cout << "A jump of one alone" << std::endl;
  for (const bool is_own : {true, false})
    {
      leave_coarser(turned(is_own ? curve_of_coarser : jump_of_coarser),
                    summary_of_coarser);
      const ErrorEstimate unknown = estimate({}, is_own ? own_jump : own_curve);
      std::cout << "  " << unknown.why_unknown << std::endl;
      check("no error", unknown.total, NAN);
      report("  nor of rows", unknown.of_rows.empty());
    }
}



// Times are not those of the coarser run there: peaks are compared.
void
test_path()
{
  std::cout << "Along a path" << std::endl;
  leave_coarser(turned({{{0, 0, 0, 0}}, {{1.8, 8, 38, 0}}, {{1.6, 9, 12, 0}}}),
                summary_of_coarser);
  const ErrorEstimate errors = estimate({"Load steps/Path following=slip"});
  check("cells, by the peaks", errors.cells, 0.5 * 2. / 40.);
  check("steps, by chords", errors.steps, 25. / 40.);
  check("the sum", errors.total, 0.025 + 0.625 + of_bodies);
  report("  no rows", errors.of_rows.empty());
}



// A force over a displacement has members of its own.
void
test_pull()
{
  std::cout << "A force over a displacement" << std::endl;
  const auto pulled = [](const std::array<double, 3> &forces) {
    std::vector<TorqueRow> rows(3);
    for (unsigned int i = 0; i < 3; ++i)
      {
        rows[i].step              = i;
        rows[i].time              = 0.5 * i;
        rows[i].chuck_position[2] = 0.005 * i;
        rows[i].chuck_reaction[2] = forces[i];
      }
    return rows;
  };
  const Scene scene   = scene_of({},
                               "subsection Interface\n"
                                 "  set Law = adhesive\n"
                                 "end\n"
                                 "subsection Chuck\n"
                                 "  subsection Translation z\n"
                                 "    set Value = 0.01 * t\n"
                                 "  end\n"
                                 "end\n"
                                 "subsection Load steps\n"
                                 "  set Times = 0, 1\n"
                                 "end\n");
  const auto  summary = [](const std::array<double, 4> &values) {
    return Json{{"converged", true},
                {"T_max_Nmm", 1e-9},
                {"curve",
                 {{"over", "chuck_uz_mm"},
                  {"load", "chuck_Fz_N"},
                  {"largest", values[0]},
                  {"at", values[1]},
                  {"end", values[2]},
                  {"initial_stiffness", values[3]}}}};
  };
  leave_coarser(pulled({{0., 48., 9.}}),
                summary({{48., 0.006, 9., 9800.}}),
                "reactions.csv");
  const ErrorEstimate errors(scene,
                             pulled({{0., 50., 10.}}),
                             summary({{50., 0.005, 10., 10000.}}),
                             coarser);
  check("cells", errors.cells, 0.5 * 2. / 50.);
  check("the sum, whatever the torque is", errors.total, 0.02 + of_steps);
  report("  of the force", errors.column == "chuck_Fz_N");
  const Json curve = errors.members.value("curve", Json::object());
  check("largest force",
        number_in(curve, "largest_error"),
        1. + of_steps * 50.);
  check("its place", number_in(curve, "at_error"), 0.0005);
  check("force at the end",
        number_in(curve, "end_error"),
        0.5 + of_steps * 10.);
  check("stiffness",
        number_in(curve, "initial_stiffness_error"),
        100. + of_steps * 10000.);
  check("the force itself is still there", number_in(curve, "largest"), 50.);
}



// Under a load it is the position that answers.
void
test_loaded()
{
  std::cout << "Under a moment" << std::endl;
  const std::vector<Sample> angles{{{0, 0, 0, 0}},
                                   {{1, 0, 0, 0}},
                                   {{2, 4, 30, 0}}},
    of_coarser{{{0, 0, 0, 0}}, {{1, 0.2, 0, 0}}, {{2, 4.4, 30, 0}}};
  leave_coarser(turned(of_coarser), Json::object({{"converged", true}}));
  const ErrorEstimate errors =
    estimate({"Chuck/Rotation z/Control=moment",
              "Chuck/Rotation z/Value=30 * max(t - 1, 0)"},
             angles,
             Json::object({{"converged", true}}));
  check("cells", errors.cells, 0.5 * 0.4 / 4.);
  check("the sum", errors.total, 0.05 + of_steps);
  report("  of the angle", errors.column == "angle_deg");
}



void
test_failed()
{
  std::cout << "Without a coarser run" << std::endl;
  std::filesystem::remove_all(coarser);
  for (const Json &summary :
       {Json{{"converged", false}, {"reason", "no step converges"}}, Json()})
    {
      if (!summary.is_null())
        leave_coarser(turned(curve_of_coarser), summary);
      else
        std::filesystem::remove_all(coarser);
      const ErrorEstimate errors = estimate({});
      std::cout << "  " << errors.why_unknown << std::endl;
      check("no error", errors.total, NAN);
      check("of cells", errors.cells, NAN);
      report("  no members", errors.members.empty());
      report("  and no rows", errors.of_rows.empty());
    }
}



int
main()
{
  set_up_libraries();
  test_parts();
  test_other_scenes();
  test_finest_curve();
  test_jumps();
  test_path();
  test_pull();
  test_loaded();
  test_failed();
}
