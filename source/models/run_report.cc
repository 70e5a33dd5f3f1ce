#include <debond/models/run_report.h>
#include <debond/support/number_text.h>
#include <debond/support/provenance.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>

namespace Debond
{
  RunReport::RunReport(const Scene &scene, const ResultDirectory &directory)
    : console(scene.output.quiet, scene.load_steps.times, std::cout)
    , scene(scene)
    , directory(directory)
    , reference(read_reference_curve(scene.output.reference_curve,
                                     scene.output.reference_columns))
    , profiles(scene, directory)
    , maps(scene)
  {}



  void
  RunReport::begin(const std::vector<TorqueRow> &rows)
  {
    if (!scene.title.empty())
      console.headline(scene.title);
    torque_curve.emplace(directory.file("torque.csv"), torque_table(rows));
  }



  void
  RunReport::add(const TorqueRow                                    &row,
                 const unsigned int                                  n_steps,
                 const std::function<std::vector<InterfacePoint>()> &points)
  {
    torque_curve->append(torque_line(row));
    console.row(row, n_steps);
    profiles.write(row.angle_deg, points);
    maps.look(row, points);
    points_of_last_row = points;
  }



  void
  RunReport::finish(const std::vector<TorqueRow> &rows,
                    CurveSettings                 settings,
                    const nlohmann::ordered_json &facts)
  {
    console.warn("profile", profiles.finish());

    // What is read off the curve, and what it refers to, Eqs. (19) to (21).
    const OutputParameters &output = scene.output;
    if (output.observed_bonding > 0)
      settings.mean_phi_0 = output.observed_bonding;
    if (output.full_sliding_angle > 0)
      settings.full_sliding_angle_deg = output.full_sliding_angle;
    settings.phase_times           = scene.load_steps.times;
    settings.reference             = reference;
    nlohmann::ordered_json summary = measure_torque_curve(rows, settings);
    summary.update(profiles.measures());
    summary.update(facts);
    const std::vector<TorqueRow> fine = fine_curve(rows);
    if (fine.size() > rows.size())
      write_file(directory.file("curve.csv"), curve_table(fine));
    if (!output.curve_at.empty())
      write_file(directory.file("curve_at.csv"),
                 curve_table(rows_at(fine, output.curve_at)));
    const bool  converged = summary["converged"];
    std::string missed;
    for (const double angle : output.curve_at)
      if (rows_at(fine, {angle}).empty())
        missed += (missed.empty() ? "" : ", ") + to_text(angle, 6);
    if (converged && !missed.empty())
      console.warn("curve at",
                   "Output / Curve at: the implant never turns through " +
                     missed + " deg");
    const CurveComparison comparison(angles_and_torques(fine), reference);
    if (converged && !reference.empty() && comparison.rows_used == 0)
      console.warn("reference",
                   output.reference_curve +
                     " could not be compared with: " + comparison.why_none);
    for (const std::string &remark : comparison.remarks)
      console.warn(remark, output.reference_curve + ": " + remark);
    summary["warnings"] = console.warnings;
    // of several ranks the largest; a rank that failed may be alone here
    double peak_memory = peak_memory_MB();
    if (converged)
      Ranks::take_largest(&peak_memory, 1);
    summary["peak_memory_MB"] = peak_memory;
    for (const auto &[name, text] : provenance())
      summary["provenance"][name] = text;
    write_json(directory.file("summary.json"), summary);
    if (points_of_last_row)
      maps.write(directory, rows.back(), points_of_last_row);
    if (!converged)
      return;

    if (comparison.rows_used > 0)
      console.headline("The torque differs from that of " +
                       output.reference_curve + " by " + comparison.text());
    Text        text;
    const auto &end = rows.back().chuck_reaction;
    if (const double theta_max = summary["theta_max_deg"],
        theta_full             = summary["theta_full_deg"];
        std::isfinite(theta_max))
      text << "Largest torque " << summary["T_max_Nmm"].get<double>()
           << " N mm at " << theta_max << " deg"
           << (std::isfinite(theta_full) ?
                 ", 99.9 % of it up to " + to_text(theta_full, 6) + " deg" :
                 "")
           << ", at the end " << rows.back().torque_Nmm << " N mm. ";
    else
      text << "Force of the chuck at the end: " << end[0] << ", " << end[1]
           << ", " << end[2] << " N. ";
    console.headline(text << "Results are in " << directory.path());
  }
} // namespace Debond
