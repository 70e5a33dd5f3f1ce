#include <debond/campaigns/calibration.h>
#include <debond/input/allowed_values.h>
#include <debond/input/csv_table.h>
#include <debond/input/entry_table.h>
#include <debond/output/report.h>
#include <debond/output/result_files.h>
#include <debond/support/number_text.h>
#include <debond/support/provenance.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iomanip>
#include <ostream>

namespace Debond
{
  namespace
  {
    std::string
    interval_text(const FittedUnknown &one)
    {
      if (one.at_bound)
        return "at its bound";
      if (!std::isfinite(one.upper - one.lower))
        return "cannot be told";
      return to_text(one.lower, 5) + " to " + to_text(one.upper, 5);
    }



    /** Of numbers that stand alone in their entry, which has the unit then. */
    std::vector<std::string>
    units_of_unknowns(const std::vector<Unknown> &list, const EntryTable &table)
    {
      std::vector<std::string> units;
      for (const Unknown &unknown : list)
        {
          const std::string &value = unknown.entry.value;
          const bool         is_alone =
            value.rfind("<<") == 0 && value.find(">>") + 2 == value.size();
          units.push_back(is_alone ? table.unit_of(unknown.entry.full_name()) :
                                     "");
        }
      return units;
    }



    /** What the rig shows besides the implant, at the best fit: number, unit,
     *  and whether that is fitted. */
    nlohmann::ordered_json
    rig_of(const Calibration &calibration,
           const Misfit      &misfit,
           const EntryTable  &table)
    {
      const Unknowns                &unknowns = misfit.unknowns;
      const Eigen::VectorXd         &best = calibration.optima.front().unknowns;
      const std::string              subsection = "Calibration / ";
      const std::vector<std::string> names{"Angle offset",
                                           "Slack",
                                           "Machine compliance",
                                           "Torque offset"};
      nlohmann::ordered_json         rigs = nlohmann::ordered_json::array();
      for (unsigned int e = 0; e < misfit.experiments.size(); ++e)
        {
          nlohmann::ordered_json rig;
          const auto take = [&](const SceneEntry &entry, const bool is_fitted) {
            for (const std::string &name : names)
              if (entry.full_name() == subsection + name)
                rig[name] = {{"value", read_number(entry.value).value_or(NAN)},
                             {"unit", table.unit_of(entry.full_name())},
                             {"fitted", is_fitted}};
          };
          for (const SceneEntry &entry : unknowns.entries(e, best))
            take(entry, false);
          for (const SceneEntry &entry : unknowns.varied_entries(e, best))
            take(entry, true);
          rigs.push_back(std::move(rig));
        }
      return rigs;
    }



    nlohmann::ordered_json
    json_of(const Calibration &calibration, const Misfit &misfit)
    {
      const FitStatistics &statistics = *calibration.statistics;
      const auto          &list       = misfit.unknowns.list;
      Scene                defaults;
      EntryTable           table; // for units
      defaults.declare(table);
      const auto             units        = units_of_unknowns(list, table);
      nlohmann::ordered_json unknowns     = nlohmann::ordered_json::object(),
                             correlations = unknowns;
      for (std::size_t j = 0; j < list.size(); ++j)
        {
          const FittedUnknown &one = statistics.unknowns[j];
          // JSON has null for what is not known
          const double unknown_if = one.at_bound ? NAN : 0.;
          unknowns[list[j].name]  = {{"value", one.best},
                                     {"unit", units[j]},
                                     {"lower_95", one.lower + unknown_if},
                                     {"upper_95", one.upper + unknown_if},
                                     {"at_bound", one.at_bound},
                                     {"start", list[j].start},
                                     {"bounds", {list[j].lower, list[j].upper}},
                                     {"logarithmic", list[j].logarithmic}};
          for (std::size_t i = 0; i < j; ++i)
            correlations[list[i].name + " | " + list[j].name] =
              statistics.correlations(i, j);
        }
      nlohmann::ordered_json curves = nlohmann::ordered_json::array(),
                             optima = curves, flat = curves,
                             candidates = curves;
      for (const CurveMisfit &curve : statistics.curves)
        curves.push_back({{"curve", curve.name},
                          {"e_mp", curve.e_mp},
                          {"e_rel", curve.e_rel},
                          {"rms_over_largest", curve.rms},
                          {"correlation_of_neighbours", curve.correlation}});
      for (const Optimum &optimum : calibration.optima)
        {
          nlohmann::ordered_json values;
          for (std::size_t j = 0; j < list.size(); ++j)
            values[list[j].name] = optimum.unknowns[j];
          optima.push_back({{"cost", optimum.cost},
                            {"converged", optimum.converged},
                            {"unknowns", values}});
        }
      for (const FlatDirection &direction : statistics.flat)
        flat.push_back(text_of(direction, misfit.unknowns));
      for (const Calibration::Candidate &candidate : calibration.candidates)
        {
          nlohmann::ordered_json widths;
          for (std::size_t j = 0; j < list.size(); ++j)
            widths[list[j].name] =
              candidate.half_widths[j] *
              list[j].per_search(statistics.unknowns[j].best);
          candidates.push_back({{"experiment", candidate.experiment + 1},
                                {"half_widths", widths}});
        }
      nlohmann::ordered_json origin;
      for (const auto &[name, text] : provenance())
        origin[name] = text;
      return {{"title", misfit.experiments.front()->scene.title},
              {"version", DEBOND_VERSION},
              {"provenance", origin},
              {"seconds", calibration.seconds},
              {"evaluations", calibration.n_evaluations},
              {"failures", calibration.failures.n},
              {"last_failure", calibration.failures.last},
              {"measured_values", misfit.measured.size()},
              {"noise_is_known", misfit.has_noise()},
              {"residual_sd", statistics.s},
              {"unknowns", unknowns},
              {"rig", rig_of(calibration, misfit, table)},
              {"correlations", correlations},
              {"curves", curves},
              {"optima", optima},
              {"cannot_be_told", flat},
              {"warnings", statistics.warnings},
              {"candidates", candidates}};
    }



    std::string
    numbered(const std::string &name,
             const std::string &ending,
             const unsigned int i,
             const unsigned int n)
    {
      return name + (n > 1 ? "-" + std::to_string(i + 1) : "") + ending;
    }



    /** What has been measured, the fit, and its 95 % band. */
    void
    write_curves(const Calibration &calibration, const Misfit &misfit)
    {
      Eigen::Index first = 0;
      for (unsigned int e = 0; e < misfit.experiments.size(); ++e)
        {
          const Experiment  &experiment = *misfit.experiments[e];
          const Measurement &measured   = experiment.measured;
          if (measured.file.empty())
            continue;
          const Eigen::Index       n = measured.over.size();
          std::vector<std::string> header{experiment.over.name};
          for (const CurveColumn &column : experiment.columns)
            for (const char *const what :
                 {"_measured", "_fitted", "_lower_95", "_upper_95"})
              header.push_back(column.name + what);
          std::string text = csv_line(header);
          for (Eigen::Index i = 0; i < n; ++i)
            {
              std::vector<double> row{measured.over[i]};
              for (std::size_t c = 0; c < experiment.columns.size(); ++c)
                {
                  const Eigen::Index at  = first + c * n + i;
                  const double       fit = calibration.at_best.values[at],
                               band      = calibration.statistics->band[at];
                  row.insert(
                    row.end(),
                    {measured.values(i, c), fit, fit - band, fit + band});
                }
              text += csv_line(row);
            }
          write_file(calibration.directory + "/" +
                       numbered("fit", ".csv", e, misfit.experiments.size()),
                     text);
          first += n * experiment.columns.size();
        }
    }



    void
    write_profiles(const Calibration &calibration, const Misfit &misfit)
    {
      std::vector<std::string> header{"unknown", "value", "chi_squared"};
      for (const Unknown &unknown : misfit.unknowns.list)
        header.push_back(unknown.name);
      std::string text = csv_line(header);
      for (const Calibration::ProfilePoint &point : calibration.profiles)
        {
          std::vector<std::string> row{misfit.unknowns.list[point.unknown].name,
                                       to_text(point.value),
                                       to_text(point.chi_squared)};
          for (const double value : point.unknowns)
            row.push_back(to_text(value));
          text += csv_line(row);
        }
      write_file(calibration.directory + "/profile.csv", text);
    }



    /** A row and a column for each unknown. */
    void
    write_correlations(const Calibration &calibration, const Misfit &misfit)
    {
      std::vector<std::string> header{"unknown"};
      for (const Unknown &unknown : misfit.unknowns.list)
        header.push_back(unknown.name);
      std::string text = csv_line(header);
      for (std::size_t j = 0; j < misfit.unknowns.list.size(); ++j)
        {
          std::vector<std::string> row{header[j + 1]};
          for (const double value : calibration.statistics->correlations.row(j))
            row.push_back(to_text(value, 4));
          text += csv_line(row);
        }
      write_file(calibration.directory + "/correlations.csv", text);
    }



    /** A run has no rig: where the fit has one, the title tells them apart. */
    std::vector<std::string>
    title_without_rig(const std::vector<SceneEntry> &found)
    {
      const Scene scene = Scene::from_entries(found, "fitted.prm");
      if (!has_rig(scene.calibration))
        return {};
      return {"Title=" +
              (scene.title.empty() ? "Fit to " + scene.output.reference_curve :
                                     scene.title) +
              ", without the rig"};
    }



    /** Scenes that run, with what has been found. */
    void
    write_scenes(const Calibration &calibration, const Misfit &misfit)
    {
      const Unknowns &unknowns = misfit.unknowns;
      std::string     comment  = "# Fitted by debond " DEBOND_VERSION "\n";
      for (std::size_t j = 0; j < unknowns.list.size(); ++j)
        comment +=
          "#   " + unknowns.list[j].name + " = " +
          to_text(calibration.statistics->unknowns[j].best, 6) +
          " (95 %: " + interval_text(calibration.statistics->unknowns[j]) +
          ")\n";
      const unsigned int n = misfit.experiments.size();
      for (unsigned int e = 0; e < n; ++e)
        {
          const auto found =
            unknowns.entries(e, calibration.optima.front().unknowns);
          const auto entries =
            with_overrides(with_overrides(found, title_without_rig(found)),
                           {"Task=simulate",
                            "Output/Directory=" + calibration.directory + "/" +
                              numbered("fitted", "", e, n)});
          const std::string &file = misfit.experiments[e]->measured.file;
          write_file(
            calibration.directory + "/" + numbered("fitted", ".prm", e, n),
            comment +
              (file.empty() ? "# not measured yet\n" : "# to " + file + "\n") +
              scene_text(entries));
        }
    }
  } // namespace



  void
  report(const Calibration &calibration,
         const Misfit      &misfit,
         std::ostream      &out)
  {
    const ClassicNumbers classic(out);
    write_curves(calibration, misfit);
    write_correlations(calibration, misfit);
    write_scenes(calibration, misfit);
    if (!calibration.profiles.empty())
      write_profiles(calibration, misfit);
    write_json(calibration.directory + "/calibration.json",
               json_of(calibration, misfit));

    const FitStatistics &statistics = *calibration.statistics;
    const auto          &list       = misfit.unknowns.list;
    std::size_t          width      = 0;
    for (const Unknown &unknown : list)
      width = std::max(width, unknown.name.size());
    out << std::left << std::setw(width) << "unknown"
        << "  best fit    95 %\n";
    for (std::size_t j = 0; j < list.size(); ++j)
      out << std::setw(width) << list[j].name << "  " << std::setw(10)
          << to_text(statistics.unknowns[j].best, 6) << "  "
          << interval_text(statistics.unknowns[j]) << '\n';
    for (const CurveMisfit &curve : statistics.curves)
      out << curve.name << ": e_mp " << to_text(100. * curve.e_mp, 3)
          << " %, e_rel " << to_text(100. * curve.e_rel, 3) << " %, residuals "
          << to_text(100. * curve.rms, 3) << " % of the largest value\n";
    if (calibration.optima.size() > 1)
      {
        out << calibration.optima.size()
            << " different optima were found; the next one has "
            << to_text(std::sqrt(calibration.optima[1].cost /
                                 calibration.optima[0].cost),
                       3)
            << " times the residuals:";
        for (std::size_t j = 0; j < list.size(); ++j)
          out << (j == 0 ? " " : ", ") << list[j].name << " = "
              << to_text(calibration.optima[1].unknowns[j], 5);
        out << '\n';
      }
    for (const std::string &warning : statistics.warnings)
      out << "warning: " << warning << '\n';
    if (calibration.failures.n > 0)
      out << calibration.failures.n
          << " curves that were tried could not be computed, which the search "
             "went around; the last for: "
          << calibration.failures.last << '\n';
    for (const Calibration::Candidate &candidate : calibration.candidates)
      {
        out << "Experiment " << candidate.experiment + 1
            << ", not done yet, would make the 95 % intervals";
        for (std::size_t j = 0; j < list.size(); ++j)
          {
            const double now  = statistics.half_widths[j],
                         then = candidate.half_widths[j];
            out << (j == 0 ? " " : ", ");
            if (statistics.unknowns[j].at_bound)
              out << "unknown for " << list[j].name << ", at its bound";
            else if (std::isfinite(now))
              out << to_text(then / now, 2) << " times as wide for "
                  << list[j].name;
            else if (std::isfinite(then))
              out << "+-"
                  << to_text(then *
                               list[j].per_search(statistics.unknowns[j].best),
                             2)
                  << " for " << list[j].name;
            else
              out << "no better for " << list[j].name;
          }
        out << '\n';
      }
    out << "Results are in " << calibration.directory
        << "/calibration.json, the fitted scene is "
        << numbered("fitted", ".prm", 0, misfit.experiments.size())
        << std::endl;
  }
} // namespace Debond
