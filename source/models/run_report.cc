#include <debond/input/entry_table.h>
#include <debond/models/run_report.h>
#include <debond/output/reference_comparison.h>
#include <debond/support/number_text.h>
#include <debond/support/provenance.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace Debond
{
  namespace
  {
    std::string
    loads_in_words(const TorqueRow &end)
    {
      // sideways it is often nothing but rounding
      const auto  &f = end.chuck_reaction;
      const double largest =
        std::max({std::abs(f[0]), std::abs(f[1]), std::abs(f[2])});
      const auto known = [&](const double load) { // N, or N mm
        return to_text(std::abs(load) < 1e-9 * largest ? 0. : load, 6);
      };
      return "At the end: torque " + known(end.torque_Nmm) + " N mm, force " +
             known(f[0]) + ", " + known(f[1]) + ", " + known(f[2]) + " N";
    }



    /** "1.3 s, 45 steps, 76 Newton iterations, 1 warning" */
    std::string
    effort_in_words(const nlohmann::ordered_json &summary,
                    const std::size_t             n_warnings)
    {
      const double steps = number_in(summary, "steps");
      return to_text(number_in(summary, "wall_seconds"), 2) + " s" +
             (std::isfinite(steps) ?
                ", " + to_text(steps, 6) + " steps, " +
                  to_text(number_in(summary, "newton_iterations"), 6) +
                  " Newton iterations" :
                "") +
             (n_warnings == 0 ? "" :
              n_warnings == 1 ? ", 1 warning" :
                                ", " + std::to_string(n_warnings) +
                                  " warnings");
    }



    /** What a run has found, for the console; what is not known is left out. */
    std::vector<std::string>
    findings(const nlohmann::ordered_json &summary,
             const TorqueRow              &end,
             const CurveAxes              &axes,
             const std::size_t             n_warnings)
    {
      std::vector<std::string> lines;
      const auto               value = [&](const char *const name) {
        return number_in(summary, name);
      };
      const auto number = [](const double value) { return to_text(value, 6); };
      // a line is there if the first of its numbers is known
      const auto add = [&](const double known, const std::string &line) {
        if (std::isfinite(known))
          lines.push_back(line);
      };
      const double theta_max  = value("theta_max_deg"),
                   theta_full = value("theta_full_deg"),
                   breaks     = value("theta_debonding_deg"),
                   bonded     = value("theta_bonded_deg"),
                   stiffness  = value("initial_stiffness_Nmm_per_rad"),
                   W_adh = value("W_adh_Nmm"), D_adh = value("D_adh_Nmm"),
                   defect     = value("largest_energy_defect"),
                   unbalanced = value("largest_reaction_defect");
      add(theta_max,
          "Largest torque " + number(value("T_max_Nmm")) + " N mm at " +
            number(theta_max) + " deg" +
            (std::isfinite(theta_full) ?
               ", 99.9 % of it up to " + number(theta_full) + " deg" :
               ""));
      lines.push_back(loads_in_words(end));
      if (const double pressure = value("pressure_MPa"); pressure > 1e-9)
        lines.push_back((axes.is_torsion() ? "Pressure before turning " :
                                             "Pressure at the end ") +
                        number(pressure) + " MPa");
      add(value("pull_max_N"),
          "Largest pull " + number(value("pull_max_N")) + " N at " +
            number(value("pull_max_mm")) + " mm");
      if (const auto curve = summary.find("curve"); curve != summary.end())
        lines.push_back(
          std::string("Largest ") + axes.load_word() + " " +
          number(curve->value("largest", 0.)) + " " + axes.load_unit() +
          " at " + number(curve->value("at", 0.)) + " " + axes.position_unit() +
          ", at the end " + number(curve->value("end", 0.)) + " " +
          axes.load_unit());
      add(stiffness,
          "Initial torsional stiffness " + number(stiffness) + " N mm/rad");
      add(breaks,
          "The bond begins to break between " + number(bonded) + " and " +
            number(breaks) + " deg");
      if (std::isfinite(W_adh))
        lines.push_back("Work of adhesion " + number(W_adh) +
                        " N mm from the curve, " + number(D_adh) +
                        " N mm by the law");
      else if (D_adh != 0.)
        add(D_adh, "Work on adhesion " + number(D_adh) + " N mm by the law");
      // of closed forms, sums over rows: they say how coarse these are
      add(unbalanced,
          "Checks: energy to " + to_text(std::abs(end.energy_defect), 2) +
            " of the work, in each row to " + to_text(defect, 2) +
            " of that so far, forces on both sides of the implant to " +
            to_text(unbalanced, 2));
      add(value("wall_seconds"), effort_in_words(summary, n_warnings));
      return lines;
    }
  } // namespace



  namespace
  {
    /** Those whose value is not the default, for the page of the run. */
    nlohmann::ordered_json
    changed_entries(const Scene &scene)
    {
      const EntryTable      &defaults = default_entries();
      nlohmann::ordered_json list     = nlohmann::ordered_json::array();
      for (const SceneEntry &entry : scene.completed_entries())
        if (const std::string name = entry.full_name();
            name != "Output / Directory" && !defaults.has(entry))
          list.push_back({{"entry", name},
                          {"value", entry.value},
                          {"unit", defaults.unit_of(name)}});
      return list;
    }
  } // namespace



  RunReport::RunReport(const Scene &scene, const ResultDirectory &directory)
    : console(scene.output.quiet,
              scene.load_steps.times,
              scene.output.axes,
              std::cout)
    , scene(scene)
    , directory(directory)
    , files_of_reference(reference_files(scene.output))
    , reference(read_reference_curve(scene.output.reference_curve,
                                     scene.output.reference_columns,
                                     scene.output.axes))
    , profiles(scene, directory)
    , maps(scene)
  {}



  void
  RunReport::begin(const std::vector<TorqueRow> &rows,
                   const InterfaceMaps::Points  &points)
  {
    if (!rows.empty())
      points_of_last_row = points;
    if (!scene.title.empty())
      console.headline(scene.title);
    if (const std::string line = scene.values_of_the_paper(); !line.empty())
      console.headline(line);
    const std::string file = scene.output.axes.rows_file();
    for (const std::string other : {"torque.csv", "reactions.csv"})
      if (other != file) // left by an earlier run with another curve
        remove_file(directory.file(other));
    torque_curve.emplace(directory.file(file), torque_table(rows));
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
    settings.take(output, reference);
    nlohmann::ordered_json summary = measure_torque_curve(rows, settings);
    summary.update(profiles.measures());
    summary.update(facts);
    const std::vector<TorqueRow> fine = fine_curve(rows);
    if (fine.size() > rows.size())
      write_file(directory.file("curve.csv"), curve_table(fine));
    if (!reference.empty())
      write_reference(directory.path(), reference, output.axes);
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
                   "Output / Curve angles: the implant never turns through " +
                     missed + " deg");
    const CurveComparison comparison(curve_of(fine, output.axes),
                                     reference,
                                     output.axes);
    if (!reference.empty() && (converged || comparison.rows_used > 0))
      for (const std::string &text :
           comparison.warnings(output.reference_curve))
        console.warn(text, text);
    summary["warnings"] = console.warnings;
    // of several ranks the largest; a rank that failed may be alone here
    double peak_memory = peak_memory_MB();
    if (converged)
      Ranks::take_largest(&peak_memory, 1);
    summary["peak_memory_MB"]  = peak_memory;
    summary["reference_files"] = files_of_reference;
    summary["changed_entries"] = changed_entries(scene);
    for (const auto &[name, text] : provenance())
      summary["provenance"][name] = text;
    write_json(directory.file("summary.json"), summary);
    if (points_of_last_row)
      maps.write(directory, rows.back(), points_of_last_row);
    if (!converged)
      return;

    if (comparison.rows_used > 0)
      console.headline("The " + std::string(output.axes.load_word()) +
                       " differs from that of " + output.reference_curve +
                       " by " + comparison.text());
    for (const std::string &line :
         findings(summary, rows.back(), output.axes, console.warnings.size()))
      console.headline(line);
    console.headline("Results are in " + directory.path());
  }
} // namespace Debond
