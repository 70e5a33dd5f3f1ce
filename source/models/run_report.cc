#include <debond/input/csv_table.h>
#include <debond/input/entry_table.h>
#include <debond/models/run_report.h>
#include <debond/output/error_estimate.h>
#include <debond/output/reference_comparison.h>
#include <debond/support/number_text.h>
#include <debond/support/provenance.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
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



    /** "53.80 +- 0.03": two digits of the error. */
    std::string
    with_error(const double value, const double error)
    {
      if (!(error > 1e-9 * std::abs(value)))
        return to_text(value, 6);
      const int  decimals = 1 - std::floor(std::log10(error));
      const auto text     = [&](const double number) {
        const double unit = std::pow(10., -decimals); // 10, 100 ...
        return decimals >= 0 ? fixed_text(number, decimals) :
                                   fixed_text(unit * std::round(number / unit), 0);
      };
      return text(value) + " +- " + text(error);
    }



    /** Words with the numbers of members whose names stand in braces; empty if
     *  one of these is not known. */
    std::string
    filled(const nlohmann::ordered_json &summary,
           std::string                   words,
           const int                     digits = 6)
    {
      for (auto begin = words.find('{'); begin != std::string::npos;
           begin      = words.find('{'))
        {
               const auto   length = words.find('}') + 1 - begin;
               const double value =
                 number_in(summary, words.substr(begin + 1, length - 2));
               if (!std::isfinite(value))
            return "";
          const double error =
                 number_in(summary, words.substr(begin + 1, length - 2) + "_error");
               words.replace(begin,
                        length,
                        error >= 0. ? with_error(value, error) :
                                           to_text(value, digits));
        }
      return words;
    }



    /** What a run has found, for the console; what is not known is left out. */
    std::vector<std::string>
    findings(const nlohmann::ordered_json &summary,
             const TorqueRow              &end,
             const CurveAxes              &axes,
             const std::size_t             n_warnings)
    {
      const auto words = [&summary](const std::string &text) {
        return filled(summary, text);
      };
      const std::string unit = axes.load_unit();
      std::string       adhesion =
        words("Work of adhesion {W_adh_Nmm} N mm from the curve, {D_adh_Nmm} "
              "N mm by the law");
      if (adhesion.empty() && number_in(summary, "D_adh_Nmm") >
                                1e-9 * number_in(summary, "dissipation_Nmm"))
        adhesion = words("Work of adhesion {D_adh_Nmm} N mm by the law");
      std::string effort = filled(summary, "{wall_seconds} s", 2);
      if (!effort.empty())
        effort +=
          words(", {steps} steps, {newton_iterations} Newton iterations") +
          (n_warnings == 0 ? "" :
                             ", " + std::to_string(n_warnings) +
                               (n_warnings == 1 ? " warning" : " warnings"));
      std::vector<std::string> lines{
        words("Largest torque {T_max_Nmm} N mm at {theta_max_deg} deg"),
        loads_in_words(end),
        number_in(summary, "pressure_MPa") > 1e-9 ?
          words(axes.is_torsion() ?
                  "Pressure before turning {pressure_MPa} MPa" :
                  "Pressure at the end {pressure_MPa} MPa") :
          "",
        words("Largest pull {pull_max_N} N at {pull_max_mm} mm"),
        summary.contains("curve") ?
          filled(summary["curve"],
                 std::string("Largest ") + axes.load_word() + " {largest} " +
                   unit + " at {at} " + axes.position_unit() +
                   ", at the end {end} " + unit) :
          "",
        words("Initial torsional stiffness {initial_stiffness_Nmm_per_rad} "
              "N mm/rad"),
        words("The bond begins to break between {theta_bonded_deg} and "
              "{theta_debonding_deg} deg"),
        adhesion,
        // of closed forms, sums over rows: they say how coarse these are
        filled(summary,
               "Checks: energy to " + to_text(std::abs(end.energy_defect), 2) +
                 " of the work, in each row to {largest_energy_defect} of that "
                 "so far, forces on both sides of the implant to "
                 "{largest_reaction_defect}",
               2),
        effort};
      if (!lines[0].empty())
        lines[0] += words(", 99.9 % of it up to {theta_full_deg} deg");
      const double cells  = number_in(summary, "error_of_cells"),
                   steps  = number_in(summary, "error_of_steps"),
                   bodies = number_in(summary, "error_of_bodies");
      if (const double error = number_in(summary, "error_estimate"); error > 0.)
        lines.push_back("Estimated error " + to_text(100. * error, 2) +
                        (error > 1.001 * (cells + steps + bodies) ?
                           " %, of the first slope or the peak; of the largest "
                           "load " :
                           " % of the largest load: ") +
                        to_text(100. * cells, 2) + " % by cells, " +
                        to_text(100. * steps, 2) + " % by steps, " +
                        to_text(100. * bodies, 2) + " % by linear bodies");
      lines.erase(std::remove(lines.begin(), lines.end(), ""), lines.end());
      return lines;
    }



    /** Those whose value is no default, for the page of the run. */
    nlohmann::ordered_json
    changed_entries(const Scene &scene)
    {
      const EntryTable      &defaults = default_entries();
      nlohmann::ordered_json list     = nlohmann::ordered_json::array();
      for (const SceneEntry &entry : scene.completed_entries())
        if (const std::string name = entry.full_name();
            name != "Output / Directory" &&
            (defaults.has_default(name) ? !defaults.has(entry) :
                                          !entry.value.empty()))
          list.push_back({{"entry", name},
                          {"value", entry.value},
                          {"unit", defaults.unit_of(name)}});
      return list;
    }
  } // namespace



  RunReport::RunReport(const Scene            &scene,
                       const ResultDirectory  &directory,
                       InterfaceTables::Points points)
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
    , tables(scene, directory, std::move(points))
  {}



  void
  RunReport::begin(const std::vector<TorqueRow> &rows)
  {
    if (!scene.title.empty())
      console.headline(scene.title);

    // an earlier run may have had another curve
    for (const std::string file : {"torque.csv", "reactions.csv"})
      remove_file(directory.file(file));
    write_file(directory.file(scene.output.axes.rows_file()),
               torque_table(rows));
  }



  void
  RunReport::add(const TorqueRow &row, const unsigned int n_steps)
  {
    append_to_file(directory.file(scene.output.axes.rows_file()),
                   torque_line(row));
    console.row(row, n_steps);
    tables.look(row);
  }



  // What the coarser run says of this one.
  void
  RunReport::write_errors(const std::vector<TorqueRow> &fine,
                          nlohmann::ordered_json       &summary)
  {
    const std::string coarser = directory.file("coarser");
    if (scene.accuracy == 0. || fine.empty() ||
        !std::filesystem::exists(coarser + "/parameters.prm"))
      return;
    const ErrorEstimate errors(scene, fine, summary, coarser);
    summary.update(errors.members);
    summary.update({{"error_estimate", errors.total},
                    {"error_of_cells", errors.cells},
                    {"error_of_steps", errors.steps},
                    {"error_of_bodies", errors.bodies}});
    if (!errors.why_unknown.empty())
      console.warn("error",
                   "the error is not known, for a coarser run of the scene is "
                   "no help: " +
                     errors.why_unknown);
    if (errors.of_rows.empty())
      return;
    const CurveAxes &axes  = scene.output.axes;
    std::string      table = axes.position_column() + "," + axes.load_column() +
                        "," + errors.column + "_error\n";
    const ReferenceCurve curve = curve_of(fine, axes);
    for (std::size_t i = 0; i < curve.size(); ++i)
      table += csv_line(std::vector<double>{curve[i].first,
                                            curve[i].second,
                                            errors.of_rows[i]});
    write_file(directory.file("errors.csv"), table);
  }



  void
  RunReport::finish(const std::vector<TorqueRow> &rows,
                    CurveSettings                 settings,
                    const nlohmann::ordered_json &facts)
  {
    console.warn("profile", tables.write_profiles());

    // What is read off the curve, and what it refers to, Eqs. (19) to (21).
    const OutputParameters &output = scene.output;
    settings.take(output, reference);
    nlohmann::ordered_json summary = measure_torque_curve(rows, settings);
    summary.update(tables.measures());
    summary.update(facts);
    const std::vector<TorqueRow> fine = fine_curve(rows);
    write_errors(fine, summary);
    if (fine.size() > rows.size())
      write_file(directory.file("curve.csv"), torque_table(fine, true));
    if (!reference.empty())
      write_reference(directory.path(), reference, output.axes);
    if (!output.curve_at.empty())
      write_file(directory.file("curve_at.csv"),
                 torque_table(rows_at(fine, output.curve_at), true));
    const bool converged = summary["converged"];
    if (converged)
      for (const double angle : output.curve_at)
        if (rows_at(fine, {angle}).empty())
          {
            const std::string at = to_text(angle, 6) + " deg";
            console.warn(
              "curve at " + at,
              "Expert / Output / Curve angles: the implant never turns "
              "through " +
                at);
          }
    const CurveComparison comparison(curve_of(fine, output.axes),
                                     reference,
                                     output.axes);
    if (!reference.empty() && (converged || comparison.rows_used > 0))
      for (const std::string &text :
           comparison.warnings(output.reference_curve))
        console.warn(text, text);
    // of several ranks the largest; a rank that failed may be alone here
    const double peak_memory =
      converged ? Ranks::largest(peak_memory_MB()) : peak_memory_MB();
    summary.update({{"warnings", console.warnings},
                    {"peak_memory_MB", peak_memory},
                    {"reference_files", files_of_reference},
                    {"changed_entries", changed_entries(scene)}});
    for (const auto &[name, text] : provenance())
      summary["provenance"][name] = text;
    write_json(directory.file("summary.json"), summary);
    if (!rows.empty())
      tables.write_maps(rows.back());
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
