#include <debond/input/allowed_values.h>
#include <debond/input/csv_table.h>
#include <debond/input/scene_file.h>
#include <debond/output/reference_comparison.h>
#include <debond/output/report.h>
#include <debond/output/report_page.h>
#include <debond/output/result_files.h>
#include <debond/output/variant_names.h>
#include <debond/scene/reference_data.h>
#include <debond/support/number_text.h>

#include <boost/algorithm/string/predicate.hpp>

#include <debond_report_files.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <locale>
#include <regex>
#include <set>

namespace Debond
{
  using namespace ReportPage;
  namespace fs = std::filesystem;

  namespace
  {
    using Fields = std::vector<std::string>;



    /** A number of a table with four digits; other texts as they are. */
    std::string
    shown(const std::string &field)
    {
      const auto value = read_number(field);
      return value                             ? short_number(*value) :
             field == "nan" || field == "-nan" ? "" :
                                                 escaped(field);
    }



    /** Whether a column holds an entry of the scene: these have a subsection,
     *  or are one of a few. */
    bool
    is_entry(const std::string &column)
    {
      return column.find(" / ") != column.npos || column == "Model" ||
             column == "Title";
    }



    /** These columns of a table, as far as it has them. */
    std::string
    columns_of(const std::vector<Fields>                              &table,
               const std::vector<std::pair<std::string, std::string>> &columns)
    {
      Fields                   head;
      std::vector<std::size_t> places;
      for (const auto &[name, words] : columns)
        {
          const auto found = std::find(table[0].begin(), table[0].end(), name);
          if (found == table[0].end())
            continue;
          const std::size_t place = found - table[0].begin();
          const bool        is_empty =
            std::all_of(table.begin() + 1, table.end(), [&](const Fields &row) {
              return place >= row.size() || shown(row[place]).empty();
            });
          if (is_empty)
            continue;
          head.push_back(escaped(words));
          places.push_back(place);
        }
      std::vector<Fields> rows;
      for (std::size_t i = 1; i < table.size(); ++i)
        {
          rows.emplace_back();
          for (const std::size_t place : places)
            rows.back().push_back(place >= table[i].size() ? "" :
                                  is_entry(table[0][place]) ? // as it was given
                                    escaped(table[i][place]) :
                                    shown(table[i][place]));
        }
      return table_of(head, rows);
    }



    /** Curves of one picture: files that hold them, and their names. */
    struct Curves
    {
      Fields files, titles;

      void
      add(const std::string &file, const std::string &title)
      {
        constexpr std::size_t most = 90; // what a picture has room for
        files.push_back(file);
        titles.push_back(
          title.size() > most ? title.substr(0, most - 3) + "..." : title);
      }

      /** Some of them, evenly chosen: more would hide each other, and make the
       *  page large. */
      Curves
      thinned_out() const
      {
        constexpr std::size_t most = 40;
        const std::size_t     n = files.size(), step = (n + most - 1) / most;
        Curves                result;
        for (std::size_t i = 0; i < n; i += step)
          result.add(files[i], titles[i]);
        return result;
      }

      /** Lines of the legend; 0 if it is too large to be drawn. */
      std::size_t
      legend_rows() const
      {
        // as gnuplot takes them to be in a picture that is 900 wide
        constexpr double      letter = 10, line_and_gap = 90, width = 820;
        constexpr std::size_t most    = 12;
        std::size_t           longest = 0;
        for (const std::string &title : titles)
          longest = std::max(longest, title.size());
        const std::size_t columns =
                            std::max(1.,
                                     width / (letter * longest + line_and_gap)),
                          rows = (titles.size() + columns - 1) / columns;
        return rows > most ? 0 : rows;
      }
    };



    /** Groups of an ensemble whose bands can still be told apart. */
    constexpr std::size_t most_bands = 8;



    /** Draws curves; @p names are those that report/campaign.gp asks for. */
    bool
    draw_curves(const std::string    &base,
                const Curves         &curves,
                const ReferenceCurve &reference,
                const std::string    &names)
    {
      const std::size_t n = curves.files.size();
      Text              text;
      text << "svg = " << quoted(base + ".svg")
           << "\npng = " << quoted(base + ".png") << "\nn_curves = " << n
           << "\nlegend_rows = " << curves.legend_rows()
           << "\nmost_bands = " << most_bands << "\narray files["
           << std::max<std::size_t>(1, n) << "]\narray titles["
           << std::max<std::size_t>(1, n) << "]\n";
      for (std::size_t i = 0; i < n; ++i)
        text << "files[" << i + 1 << "] = " << quoted(curves.files[i])
             << "\ntitles[" << i + 1 << "] = " << quoted(curves.titles[i])
             << "\n";
      text << "file(i) = files[i]\nname(i) = titles[i]\n"
           << "$reference << EOD\nangle,torque\nnan,nan\n";
      for (const auto &[angle, torque] : reference)
        text << angle << "," << torque << "\n";
      text << "EOD\nn_reference = " << reference.size() << "\n"
           << names << report_file_campaign_gp;
      return draw(text);
    }



    const char *const torque_over_angle =
      "x = 'angle_deg'\ny = 'torque_Nmm'\nx_label = 'Rotation angle "
      "{/:Italic θ} [°]'\ny_label = 'Torque [N mm]'\nis_fit = 0\n";



    /** The name of a column with its unit: "torque [N mm]". */
    std::string
    in_words(const std::string &column)
    {
      static const std::vector<std::pair<std::string, std::string>> units{
        {"_Nmm", " [N mm]"},
        {"_deg", " [°]"},
        {"_mm", " [mm]"},
        {"_N", " [N]"}};
      for (const auto &[ending, unit] : units)
        if (boost::ends_with(column, ending))
          {
            std::string name = column.substr(0, column.size() - ending.size());
            std::replace(name.begin(), name.end(), '_', ' ');
            return name + unit;
          }
      return column;
    }



    /** The entries that a table has columns of, and their values in each row.
     */
    struct VariedEntries
    {
      explicit VariedEntries(const std::vector<Fields> &table);

      Fields              names;
      std::vector<Fields> values;
    };



    VariedEntries::VariedEntries(const std::vector<Fields> &table)
      : values(table.size() - 1)
    {
      for (std::size_t c = 0; c < table[0].size(); ++c)
        if (is_entry(table[0][c]))
          {
            names.push_back(table[0][c]);
            for (std::size_t i = 1; i < table.size(); ++i)
              values[i - 1].push_back(c < table[i].size() ? table[i][c] : "");
          }
    }



    /** A study as it stands in its directory. */
    struct StudyResults
    {
      explicit StudyResults(const std::string &directory);

      std::vector<Fields> table;    ///< study.csv
      VariedEntries       varied;   ///< of it
      VariantNames        names;    ///< of its rows
      Curves              curves;   ///< of variants that are done
      Fields              failures; ///< in words
      std::string         title;    ///< of the scene
    };



    /** Of the scene in a directory; empty if it has none. */
    std::string
    title_in(const std::string &directory)
    {
      const std::string file = directory + "/parameters.prm";
      if (fs::exists(file))
        for (const SceneEntry &entry : read_scene_file(file))
          if (entry.full_name() == "Title")
            return entry.value;
      return "";
    }



    StudyResults::StudyResults(const std::string &directory)
      : table(read_csv_texts(directory + "/study.csv", "study.csv"))
      , varied(table)
      , names(varied.names, varied.values)
    {
      const Fields &header = table[0];
      const auto    place  = [&](const std::string &name) {
        return std::size_t(std::find(header.begin(), header.end(), name) -
                           header.begin());
      };
      const std::size_t converged = place("converged"),
                        reason    = place("reason");
      for (std::size_t i = 1; i < table.size(); ++i)
        {
          const Fields     &row = table[i];
          const std::string own =
            directory + "/" + variant_name(std::stoul(row[0]));
          if (title.empty())
            title = title_in(own);
          if (converged < row.size() && row[converged] == "true")
            curves.add(finest_curve(own), names.brief(i - 1));
          else
            failures.push_back(
              "variant " + row[0] + ", " + escaped(names.brief(i - 1)) + ": " +
              (reason < row.size() ? escaped(row[reason]) : ""));
        }
    }



    /** The groups of an ensemble, each as a file of its own; ensemble.csv
     *  itself if there is one. */
    Curves
    groups_of(const std::string &ensemble, const std::string &scratch)
    {
      const auto          table = read_csv_texts(ensemble, "ensemble.csv");
      const VariedEntries varied(table);
      if (varied.names.empty())
        return {{ensemble}, {""}};
      std::vector<Fields> groups;
      Fields              texts;
      for (std::size_t i = 1; i < table.size(); ++i)
        {
          if (groups.empty() || groups.back() != varied.values[i - 1])
            {
              groups.push_back(varied.values[i - 1]);
              texts.push_back(csv_line(table[0]));
            }
          texts.back() += csv_line(table[i]);
        }
      const VariantNames names(varied.names, groups);
      Curves             curves;
      for (std::size_t g = 0; g < groups.size(); ++g)
        {
          curves.add(scratch + "/" + std::to_string(g) + ".csv",
                     names.brief(g));
          write_file(curves.files.back(), texts[g]);
        }
      return curves;
    }



    /** What the picture of these curves does not say itself. */
    std::string
    remark_on(const Curves &drawn, const std::size_t n, const bool is_ensemble)
    {
      const std::string what = is_ensemble ? "groups" : "variants";
      std::string       text;
      if (drawn.files.size() < n)
        text += std::to_string(drawn.files.size()) + " of " +
                std::to_string(n) + " " + what + " are drawn. ";
      if (drawn.legend_rows() == 0)
        text += "The colours go from dark to light in the order of the " +
                what + ", from " + escaped(drawn.titles.front()) + " to " +
                escaped(drawn.titles.back()) + ". ";
      if (is_ensemble && n > 1)
        text += drawn.files.size() > most_bands ?
                  "Each line is the mean of a group." :
                  "Each line is the mean of a group; the band in its colour "
                  "holds 5 to 95 % of its members.";
      return text.empty() ? "" : "<p>" + text + "</p>";
    }



    /** The curves of a study, or the bands of an ensemble. */
    std::string
    curves_of_study(const std::string  &directory,
                    const StudyResults &study,
                    const std::string  &a_variant)
    {
      const std::string      ensemble    = directory + "/ensemble.csv";
      const bool             is_ensemble = fs::exists(ensemble);
      const OutputParameters output =
        Scene::from_file(a_variant + "/parameters.prm").output;
      const auto     summary = read_json(a_variant + "/summary.json");
      ReferenceCurve reference;
      if (fs::exists(output.reference_curve) &&
          !(summary.contains("reference_files") &&
            has_other_references(output, summary)))
        reference = read_reference_curve(output.reference_curve,
                                         output.reference_columns);
      const Scratch scratch;
      const Curves  all =
        is_ensemble ? groups_of(ensemble, scratch.path) : study.curves;
      const Curves drawn = all.thinned_out();
      const bool   is_drawn =
        draw_curves(directory + "/torque",
                    drawn,
                    reference,
                    torque_over_angle + std::string("is_ensemble = ") +
                      (is_ensemble ? "1\n" : "0\n"));
      return curve(is_drawn,
                   directory + "/torque.svg",
                   "torque over angle of the variants",
                   directory) +
             (is_drawn ? remark_on(drawn, all.files.size(), is_ensemble) : "");
    }



    /** Varied entries and then @p others, as columns of a table. */
    std::vector<std::pair<std::string, std::string>>
    columns_after(const Fields                                      &varied,
                  std::vector<std::pair<std::string, std::string>> &&others)
    {
      std::vector<std::pair<std::string, std::string>> columns;
      for (const std::string &name : varied)
        columns.emplace_back(name, name);
      columns.insert(columns.end(), others.begin(), others.end());
      return columns;
    }



    /** What the random patterns of an ensemble come to, group by group. */
    std::string
    statistics_of(const std::string &directory, const Fields &varied)
    {
      const std::string file = directory + "/ensemble_summary.csv";
      if (!fs::exists(file))
        return "";
      return columns_of(read_csv_texts(file, "ensemble_summary.csv"),
                        columns_after(varied,
                                      {{"members", "implants"},
                                       {"T_max_mean_Nmm", "T_max: mean [N mm]"},
                                       {"T_max_sd_Nmm", "standard deviation"},
                                       {"T_max_p05_Nmm", "5 %"},
                                       {"T_max_p95_Nmm", "95 %"},
                                       {"D_adh_mean_Nmm", "D_adh: mean [N mm]"},
                                       {"D_adh_sd_Nmm",
                                        "standard deviation"}}));
    }



    /** The variants, with what they have in the place of all varied entries if
     *  these are many. */
    std::string
    table_of_variants(const StudyResults &study)
    {
      std::vector<Fields> table = study.table;
      Fields              first{"variant"};
      if (study.names.only_changes())
        {
          first.push_back("changed");
          table[0].push_back("changed");
          for (std::size_t i = 1; i < table.size(); ++i)
            {
              table[i].resize(table[0].size() - 1);
              table[i].push_back(study.names.brief(i - 1));
            }
        }
      else
        first.insert(first.end(),
                     study.varied.names.begin(),
                     study.varied.names.end());
      return columns_of(table,
                        columns_after(first,
                                      {{"T_max_Nmm", "T_max [N mm]"},
                                       {"theta_max_deg", "at [°]"},
                                       {"theta_full_deg", "theta_full [°]"},
                                       {"T_inf_Nmm", "T_inf [N mm]"},
                                       {"initial_stiffness_Nmm_per_rad",
                                        "initial stiffness [N mm/rad]"},
                                       {"W_adh_Nmm", "W_adh [N mm]"},
                                       {"D_adh_Nmm", "D_adh [N mm]"},
                                       {"difference_mean",
                                        "mean difference from the reference"},
                                       {"wall_seconds", "time [s]"}}));
    }



    /** "TITLE: study of 3 variants", or where it is without a title. */
    std::string
    heading(const std::string &title,
            const std::string &what,
            const std::string &directory)
    {
      if (!title.empty())
        return title + ": " + what;
      std::string text = what + " in " + directory;
      text[0]          = std::toupper(text[0], std::locale::classic());
      return text;
    }
  } // namespace



  void
  write_report_of_study(const std::string &directory)
  {
    const StudyResults study(directory);
    const std::string  a_variant =
      study.curves.files.empty() ?
         "" :
         fs::path(study.curves.files[0]).parent_path().string();
    const std::string n = std::to_string(study.table.size() - 1);
    write(directory,
          heading(study.title, "study of " + n + " variants", directory),
          state(study.failures.empty(),
                std::to_string(study.curves.files.size()) + " of " + n +
                  " variants are done") +
            section("Variants that failed, or are not done",
                    list_of(study.failures, " class=\"warnings\"")) +
            (a_variant.empty() ?
               "" :
               section("Curves",
                       curves_of_study(directory, study, a_variant))) +
            section("Random patterns",
                    statistics_of(directory, study.varied.names)) +
            section("Variants", table_of_variants(study)) +
            section("Origin",
                    origin(read_json(a_variant + "/summary.json"), false)));
  }



  namespace
  {
    using Json = nlohmann::ordered_json;

    std::string
    number_in_words(const Json  &number,
                    const double factor = 1.,
                    const int    digits = 5)
    {
      return number.is_number() ?
               short_number(factor * number.get<double>(), digits) :
               "not known";
    }



    std::string
    fitted_values(const Json &unknowns)
    {
      std::vector<Fields> rows;
      for (const auto &[name, one] : unknowns.items())
        {
          const bool is_told =
            one.at("lower_95").is_number() && one.at("upper_95").is_number();
          rows.push_back({escaped(name),
                          number_in_words(one.at("value")),
                          is_told ?
                            number_in_words(one.at("lower_95")) + " to " +
                              number_in_words(one.at("upper_95")) :
                            "cannot be told",
                          escaped(one.value("unit", "")),
                          one.at("at_bound") == true ? "at its bound" : ""});
        }
      return table_of({"unknown", "value", "95 % interval", "unit", ""}, rows);
    }



    /** Pairs of unknowns that the curves hardly tell apart. */
    std::string
    large_correlations(const Json &correlations)
    {
      constexpr double    large = 0.9;
      std::vector<Fields> rows;
      for (const auto &[pair, value] : correlations.items())
        if (value.is_number() && std::abs(value.get<double>()) > large)
          {
            const auto bar = pair.find(" | ");
            rows.push_back({escaped(pair.substr(0, bar)),
                            escaped(pair.substr(bar + 3)),
                            number_in_words(value, 1., 3)});
          }
      return table_of({"unknown", "and", "correlation"}, rows);
    }



    /** What the rig shows besides the implant, as far as it is not 0. */
    std::string
    rig_in_words(const Json &rigs)
    {
      std::vector<Fields> rows;
      for (std::size_t e = 0; e < rigs.size(); ++e)
        for (const auto &[name, one] : rigs[e].items())
          if (one.at("value") != 0.)
            rows.push_back(
              {(rigs.size() > 1 ? "experiment " + std::to_string(e + 1) + ": " :
                                  "") +
                 escaped(name),
               number_in_words(one.at("value")) + " " +
                 escaped(one.at("unit").get<std::string>()),
               one.at("fitted") == true ? "fitted" : "given"});
      return table_of({}, rows);
    }



    std::string
    misfits(const Json &curves)
    {
      std::vector<Fields> rows;
      const auto          percent = [](const Json &part) {
        return number_in_words(part, 100., 3) + " %";
      };
      for (const Json &one : curves)
        rows.push_back({escaped(one.at("curve").get<std::string>()),
                        percent(one.at("e_mp")),
                        percent(one.at("e_rel")),
                        percent(one.at("rms_over_largest"))});
      return table_of(
        {"curve", "e_mp", "e_rel", "root mean square over the largest value"},
        rows);
    }



    /** Each measured curve with its fit, and what lies between them. */
    std::string
    pictures_of_fits(const std::string &directory)
    {
      std::string pictures;
      // fit.csv, or of several experiments fit-1.csv and so on
      static const std::regex of_fit("fit(-[0-9]+)?\\.csv");
      std::set<std::string>   files;
      for (const auto &entry : fs::directory_iterator(directory))
        if (std::regex_match(entry.path().filename().string(), of_fit))
          files.insert(entry.path().string());
      for (const std::string &file : files)
        {
          const Fields header = read_csv_header(file, "fit");
          for (std::size_t c = 1; c + 3 < header.size(); c += 4)
            {
              const std::string column =
                header[c].substr(0, header[c].size() - 9); // without _measured
              const std::string base =
                fs::path(file).replace_extension().string() + "-" + column;
              const bool is_drawn =
                draw_curves(base,
                            {{file}, {""}},
                            {},
                            "x = " + quoted(header[0]) +
                              "\ny = " + quoted(column) +
                              "\nx_label = " + quoted(in_words(header[0])) +
                              "\ny_label = " + quoted(in_words(column)) +
                              "\nis_fit = 1\nis_ensemble = 0\n");
              if (files.size() > 1)
                pictures +=
                  "<p>" + escaped(fs::path(file).filename().string()) + "</p>";
              pictures +=
                curve(is_drawn, base + ".svg", "fit of " + column, directory);
            }
        }
      return pictures;
    }
  } // namespace



  void
  write_report_of_calibration(const std::string &directory)
  {
    const Json json = read_json(directory + "/calibration.json");
    const int  n    = json.value("evaluations", 0); // but of closed forms
    Fields     warnings;
    for (const char *const name : {"cannot_be_told", "warnings"})
      for (const std::string text : json.at(name))
        if (std::find(warnings.begin(), warnings.end(), escaped(text)) ==
            warnings.end())
          warnings.push_back(escaped(text));
    write(directory,
          heading(json.value("title", ""), "calibration", directory),
          state(true,
                std::to_string(json.value("measured_values", 0)) +
                  " measured values, " +
                  (n == 0 ? "closed form" :
                            std::to_string(n) + " evaluations")) +
            section("Fitted values", fitted_values(json.at("unknowns"))) +
            section("Warnings", list_of(warnings, " class=\"warnings\"")) +
            section("Unknowns that can stand in for each other",
                    large_correlations(json.at("correlations"))) +
            section("Rig", rig_in_words(json.value("rig", Json::array()))) +
            section("Curves", pictures_of_fits(directory)) +
            section("How far the curves are", misfits(json.at("curves"))) +
            section("Origin", origin(json)));
  }
} // namespace Debond
