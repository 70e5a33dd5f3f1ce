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
    rounded(const std::string &field, const double factor)
    {
      char        *end   = nullptr;
      const double value = std::strtod(field.c_str(), &end);
      return field.empty() || *end != '\0' ? escaped(field) :
             std::isnan(value)             ? "" :
                                             to_text(factor * value, 4);
    }



    /** These columns of a table, as far as it has them; N m as N mm. */
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
              return place >= row.size() || rounded(row[place], 1.).empty();
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
              place < table[i].size() ?
                rounded(table[i][place],
                        boost::ends_with(table[0][place], "_Nm") ? 1e3 : 1.) :
                "");
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
  } // namespace



  void
  write_report_of_study(const std::string &directory)
  {
    const auto    table = read_csv_texts(directory + "/study.csv", "study.csv");
    const Fields &header = table[0];
    const auto    place  = [&](const std::string &name) {
      return std::size_t(std::find(header.begin(), header.end(), name) -
                         header.begin());
    };
    Fields            files, titles, failures;
    const std::size_t converged = place("converged"), reason = place("reason");
    for (std::size_t i = 1; i < table.size(); ++i)
      {
        const std::string own =
          directory + "/" + variant_name(std::stoul(table[i][0]));
        if (converged < table[i].size() && table[i][converged] == "true")
          {
            files.push_back(finest_curve(own));
            titles.push_back(words_of(header, table[i]));
          }
        else
          failures.push_back(
            "variant " + table[i][0] + ", " +
            escaped(words_of(header, table[i])) + ": " +
            (reason < table[i].size() ? escaped(table[i][reason]) : ""));
      }
    const std::size_t n_done = files.size();

    // more lines would hide each other, and make the page large
    constexpr std::size_t most = 40;
    const std::size_t     step = (files.size() + most - 1) / most;
    for (std::size_t i = 0; step > 1 && i * step < files.size(); ++i)
      {
        files[i]  = files[i * step];
        titles[i] = titles[i * step];
      }
    if (step > 1)
      {
        files.resize((n_done + step - 1) / step);
        titles.resize(files.size());
      }

    std::string sections =
      state(failures.empty(),
            std::to_string(n_done) + " of " + std::to_string(table.size() - 1) +
              " variants are done");
    sections += section("Variants that failed, or are not done",
                        list_of(failures, " class=\"warnings\""));

    const std::string ensemble = directory + "/ensemble.csv";
    const bool        is_ensemble =
      fs::exists(ensemble) &&
      read_csv_header(ensemble, "ensemble")[0] == "angle_deg";
    const std::string a_variant =
      n_done > 0 ? fs::path(files[0]).parent_path().string() : "";
    const OutputParameters output =
      n_done > 0 ? Scene::from_file(a_variant + "/parameters.prm").output :
                   OutputParameters();
    ReferenceCurve reference;
    if (fs::exists(output.reference_curve))
      reference =
        read_reference_curve(output.reference_curve, output.reference_columns);
    const bool is_drawn =
      n_done > 0 &&
      draw_curves(directory + "/torque",
                  is_ensemble ? Fields{ensemble} : files,
                  is_ensemble ? Fields{""} : titles,
                  reference,
                  torque_over_angle + std::string("is_ensemble = ") +
                    (is_ensemble ? "1\n" : "0\n"));
    if (n_done > 0)
      sections +=
        section("Curves",
                curve(is_drawn,
                      directory + "/torque.svg",
                      "torque over angle of the variants",
                      directory) +
                  (step > 1 && !is_ensemble ?
                     "<p>" + std::to_string(files.size()) + " of " +
                       std::to_string(n_done) + " variants are drawn.</p>" :
                     ""));
    std::vector<std::pair<std::string, std::string>> columns{
      {"variant", "variant"}};
    for (const std::string &name : header)
      if (name.find(" / ") != name.npos)
        columns.emplace_back(name, name);
    columns.insert(columns.end(),
                   {{"T_max_Nmm", "T_max [N mm]"},
                    {"theta_max_deg", "at [°]"},
                    {"T_inf_Nmm", "T_inf [N mm]"},
                    {"W_adh_Nm", "W_adh [N mm]"},
                    {"difference_mean", "mean difference from the reference"},
                    {"wall_seconds", "time [s]"}});
    sections +=
      section("Variants", columns_of(table, columns)) +
      section("Origin", origin(read_json(a_variant + "/summary.json"), false));
    write(directory, "Study in " + directory, sections);
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
