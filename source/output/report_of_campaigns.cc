#include <debond/input/csv_table.h>
#include <debond/output/report.h>
#include <debond/output/report_page.h>
#include <debond/output/result_files.h>
#include <debond/scene/reference_data.h>
#include <debond/support/number_text.h>

#include <boost/algorithm/string/predicate.hpp>

#include <debond_report_files.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
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
    rounded(const std::string &field)
    {
      char        *end   = nullptr;
      const double value = std::strtod(field.c_str(), &end);
      return field.empty() || *end != '\0' ? escaped(field) :
             std::isnan(value)             ? "" :
                                             to_text(value, 4);
    }



    /** These columns of a table, as far as it has them. */
    std::string
    columns_of(const std::vector<Fields>                              &table,
               const std::vector<std::pair<std::string, std::string>> &columns)
    {
      Fields                   head;
      std::vector<std::size_t> places;
      for (const auto &[name, shown] : columns)
        {
          const auto found = std::find(table[0].begin(), table[0].end(), name);
          if (found == table[0].end())
            continue;
          const std::size_t place = found - table[0].begin();
          const bool        is_empty =
            std::all_of(table.begin() + 1, table.end(), [&](const Fields &row) {
              return place >= row.size() || rounded(row[place]).empty();
            });
          if (is_empty)
            continue;
          head.push_back(escaped(shown));
          places.push_back(place);
        }
      std::vector<Fields> rows;
      for (std::size_t i = 1; i < table.size(); ++i)
        {
          rows.emplace_back();
          for (const std::size_t place : places)
            rows.back().push_back(
              place < table[i].size() ? rounded(table[i][place]) : "");
        }
      return table_of(head, rows);
    }



    /** Draws curves; @p names are those that report/campaign.gp asks for. */
    bool
    draw_curves(const std::string    &base,
                const Fields         &files,
                const Fields         &titles,
                const ReferenceCurve &reference,
                const std::string    &names)
    {
      Text text;
      text << "svg = " << quoted(base + ".svg")
           << "\npng = " << quoted(base + ".png")
           << "\nn_curves = " << files.size() << "\narray files["
           << std::max<std::size_t>(1, files.size()) << "]\narray titles["
           << std::max<std::size_t>(1, files.size()) << "]\n";
      for (std::size_t i = 0; i < files.size(); ++i)
        text << "files[" << i + 1 << "] = " << quoted(files[i]) << "\ntitles["
             << i + 1 << "] = " << quoted(titles[i]) << "\n";
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



    /** The words that tell variants apart: the values of what is varied. */
    std::string
    words_of(const Fields &header, const Fields &row)
    {
      std::string text;
      for (std::size_t i = 1; i < header.size(); ++i)
        if (header[i].find(" / ") != header[i].npos)
          text += (text.empty() ? "" : ", ") +
                  header[i].substr(header[i].rfind(" / ") + 3) + " = " + row[i];
      return text;
    }



    /** A study as it stands in its directory. */
    struct StudyResults
    {
      explicit StudyResults(const std::string &directory);

      std::vector<Fields> table; ///< study.csv
      Fields files, titles;      ///< the curves of variants that are done
      Fields failures;           ///< in words
      Fields varied;             ///< the entries that are varied
    };



    StudyResults::StudyResults(const std::string &directory)
      : table(read_csv_texts(directory + "/study.csv", "study.csv"))
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
          if (converged < row.size() && row[converged] == "true")
            {
              files.push_back(finest_curve(own));
              titles.push_back(words_of(header, row));
            }
          else
            failures.push_back(
              "variant " + row[0] + ", " + escaped(words_of(header, row)) +
              ": " + (reason < row.size() ? escaped(row[reason]) : ""));
        }
      for (const std::string &name : header)
        if (name.find(" / ") != name.npos)
          varied.push_back(name);
    }



    /** The curves of a study, or the band of an ensemble. */
    std::string
    curves_of_study(const std::string  &directory,
                    const StudyResults &study,
                    const std::string  &a_variant)
    {
      const std::string ensemble = directory + "/ensemble.csv";
      const bool        is_band =
        fs::exists(ensemble) &&
        read_csv_header(ensemble, "ensemble")[0] == "angle_deg";
      const OutputParameters output =
        Scene::from_file(a_variant + "/parameters.prm").output;
      ReferenceCurve reference;
      if (fs::exists(output.reference_curve))
        reference = read_reference_curve(output.reference_curve,
                                         output.reference_columns);
      // more lines would hide each other, and make the page large
      constexpr std::size_t most = 40;
      const std::size_t n = study.files.size(), step = (n + most - 1) / most;
      Fields            files{ensemble}, titles{""};
      if (!is_band)
        {
          files.clear();
          titles.clear();
          for (std::size_t i = 0; i < n; i += step)
            {
              files.push_back(study.files[i]);
              titles.push_back(study.titles[i]);
            }
        }
      const bool is_drawn =
        draw_curves(directory + "/torque",
                    files,
                    titles,
                    reference,
                    torque_over_angle + std::string("is_ensemble = ") +
                      (is_band ? "1\n" : "0\n"));
      return curve(is_drawn,
                   directory + "/torque.svg",
                   "torque over angle of the variants",
                   directory) +
             (step > 1 && !is_band ?
                "<p>" + std::to_string(files.size()) + " of " +
                  std::to_string(n) + " variants are drawn.</p>" :
                "");
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
  } // namespace



  void
  write_report_of_study(const std::string &directory)
  {
    const StudyResults study(directory);
    const std::string  a_variant =
      study.files.empty() ? "" :
                             fs::path(study.files[0]).parent_path().string();
    Fields columns{"variant"};
    columns.insert(columns.end(), study.varied.begin(), study.varied.end());
    write(
      directory,
      "Study in " + directory,
      state(study.failures.empty(),
            std::to_string(study.files.size()) + " of " +
              std::to_string(study.table.size() - 1) + " variants are done") +
        section("Variants that failed, or are not done",
                list_of(study.failures, " class=\"warnings\"")) +
        (a_variant.empty() ?
           "" :
           section("Curves", curves_of_study(directory, study, a_variant))) +
        section("Random patterns", statistics_of(directory, study.varied)) +
        section(
          "Variants",
          columns_of(study.table,
                     columns_after(columns,
                                   {{"T_max_Nmm", "T_max [N mm]"},
                                    {"theta_max_deg", "at [°]"},
                                    {"T_inf_Nmm", "T_inf [N mm]"},
                                    {"W_adh_Nmm", "W_adh [N mm]"},
                                    {"difference_mean",
                                     "mean difference from the reference"},
                                    {"wall_seconds", "time [s]"}}))) +
        section("Origin",
                origin(read_json(a_variant + "/summary.json"), false)));
  }



  void
  write_report_of_calibration(const std::string &directory)
  {
    const auto  json = read_json(directory + "/calibration.json");
    const int   n    = json.value("evaluations", 0); // but of closed forms
    std::string sections =
      state(true,
            std::to_string(json.value("measured_values", 0)) +
              " measured values, " +
              (n == 0 ? "closed form" : std::to_string(n) + " evaluations"));
    const auto number = [](const nlohmann::ordered_json &value) {
      return value.is_number() ? to_text(value.get<double>(), 5) :
                                 std::string("not known");
    };
    std::vector<Fields> unknowns, curves;
    for (const auto &[name, one] : json.at("unknowns").items())
      unknowns.push_back(
        {escaped(name),
         number(one.at("value")),
         one.at("lower_95").is_number() && one.at("upper_95").is_number() ?
           number(one.at("lower_95")) + " to " + number(one.at("upper_95")) :
           "cannot be told",
         one.at("at_bound") == true ? "at its bound" : ""});
    for (const auto &one : json.at("curves"))
      curves.push_back({escaped(one.at("curve").get<std::string>()),
                        number(one.at("e_rel")),
                        number(one.at("rms_over_largest"))});
    sections +=
      section("Fitted values",
              table_of({"unknown", "value", "95 % interval", ""}, unknowns));
    Fields remarks;
    for (const char *const name : {"cannot_be_told", "warnings"})
      for (const std::string text : json.at(name))
        remarks.push_back(escaped(text));
    sections += section("Warnings", list_of(remarks, " class=\"warnings\""));

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
                          {file},
                          {""},
                          {},
                          "x = " + quoted(header[0]) +
                            "\ny = " + quoted(column) +
                            "\nx_label = " + quoted(in_words(header[0])) +
                            "\ny_label = " + quoted(in_words(column)) +
                            "\nis_fit = 1\nis_ensemble = 0\n");
            pictures +=
              curve(is_drawn, base + ".svg", "fit of " + column, directory);
          }
      }
    sections += section("Curves", pictures) +
                section("How far the curves are",
                        table_of({"curve",
                                  "e_rel",
                                  "root mean square over the largest value"},
                                 curves)) +
                section("Origin", origin(json));
    write(directory, "Calibration in " + directory, sections);
  }
} // namespace Debond
