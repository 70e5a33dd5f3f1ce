#include "expectations.h"

#include <debond/output/result_files.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace Expectations
{
  namespace
  {
    /** What makes an expectation fail other than a wrong number. */
    using Problem = std::runtime_error;
  } // namespace



  std::string
  contents_of(const std::string &filename)
  {
    std::ifstream file(filename);
    if (!file)
      throw Problem("cannot open " + filename);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }



  namespace
  {
    double
    to_number(const std::string &text)
    {
      std::size_t end   = 0;
      double      value = 0;
      try
        {
          value = std::stod(text, &end);
        }
      catch (const std::exception &)
        {
          end = 0;
        }
      if (end == 0 || end != text.size())
        throw Problem("'" + text + "' is no number");
      return value;
    }



    std::vector<std::string>
    split_at_commas(const std::string &line)
    {
      std::vector<std::string> items;
      std::istringstream       text(line);
      std::string              item;
      while (std::getline(text, item, ','))
        items.push_back(item);
      return items;
    }



    Table
    read_table(const std::string &filename)
    {
      std::istringstream lines(contents_of(filename));
      std::string        line;
      Table              table;
      std::getline(lines, line);
      table.columns = split_at_commas(line);
      while (std::getline(lines, line))
        {
          std::vector<double> row;
          for (const std::string &item : split_at_commas(line))
            row.push_back(to_number(item));
          if (row.size() != table.columns.size())
            throw Problem(filename + " has a row of another length");
          table.rows.push_back(row);
        }
      return table;
    }



    /** The numbers and booleans of a flat JSON object. */
    std::map<std::string, double>
    read_summary(const std::string &filename)
    {
      const std::string text = contents_of(filename);
      const std::regex  member(
        "\"([^\"]+)\"\\s*:\\s*(true|false|[-+0-9.eE]+)\\s*[,}\\n]");
      std::map<std::string, double> summary;
      for (std::sregex_iterator i(text.begin(), text.end(), member), end;
           i != end;
           ++i)
        {
          const std::string value = (*i)[2];
          summary[(*i)[1]]        = value == "true"  ? 1. :
                                    value == "false" ? 0. :
                                                       to_number(value);
        }
      return summary;
    }



    /** The fields of a line of CSV, quoted or not. */
    std::vector<std::string>
    csv_fields(const std::string &line)
    {
      std::vector<std::string> fields(1);
      bool                     quoted = false;
      for (const char c : line)
        if (c == '"')
          quoted = !quoted;
        else if (c == ',' && !quoted)
          fields.emplace_back();
        else
          fields.back() += c;
      return fields;
    }
  } // namespace



  std::size_t
  Table::column(const std::string &name) const
  {
    const auto position = std::find(columns.begin(), columns.end(), name);
    if (position == columns.end())
      throw Problem("the rows have no column " + name);
    return position - columns.begin();
  }



  Results
  read_results(const std::string &directory)
  {
    return {directory,
            read_table(Debond::rows_file(directory)),
            read_summary(directory + "/summary.json")};
  }



  Results
  read_calibration(const std::string &directory)
  {
    const auto json =
      nlohmann::json::parse(contents_of(directory + "/calibration.json"));
    Results results{directory, {}, {}};
    // what cannot be told is infinite, for which JSON has null
    const auto number = [](const nlohmann::json &value) {
      return value.is_null() ? HUGE_VAL : value.get<double>();
    };
    for (const auto &[name, unknown] : json.at("unknowns").items())
      {
        results.summary[name] = number(unknown.at("value"));
        results.summary[name + "_width"] =
          number(unknown.at("upper_95")) - number(unknown.at("lower_95"));
        if (unknown.at("upper_95").is_null())
          results.summary[name + "_width"] = HUGE_VAL;
      }
    for (const char *const measure : {"e_mp", "e_rel"})
      results.summary[measure] = number(json.at("curves").at(0).at(measure));
    for (const auto &candidate : json.at("candidates"))
      for (const auto &[name, width] : candidate.at("half_widths").items())
        results.summary[name + "_after_experiment_" +
                        candidate.at("experiment").dump()] = number(width);
    return results;
  }



  /** The results of each variant of a study: the numbers in its row of
   * study.csv and its torque curve. */
  std::vector<Results>
  read_study(const std::string &directory)
  {
    std::istringstream lines(contents_of(directory + "/study.csv"));
    std::string        line;
    std::getline(lines, line);
    const std::vector<std::string> columns = csv_fields(line);
    std::vector<Results>           variants;
    while (std::getline(lines, line))
      {
        Results                        results;
        const std::vector<std::string> fields = csv_fields(line);
        for (std::size_t i = 0; i < std::min(columns.size(), fields.size());
             ++i)
          if (fields[i] == "true" || fields[i] == "false")
            results.summary[columns[i]] = fields[i] == "true";
          else
            try
              {
                results.summary[columns[i]] = to_number(fields[i]);
              }
            catch (const Problem &) // text
              {}
        char name[32];
        std::snprintf(name,
                      sizeof(name),
                      "/variant-%03u",
                      static_cast<unsigned int>(variants.size() + 1));
        try
          {
            results.table = read_table(Debond::rows_file(directory + name));
          }
        catch (const Problem &) // a variant that failed
          {}
        results.directory = directory + name;
        variants.push_back(results);
      }
    return variants;
  }



  namespace
  {
    double
    value_at_row(const Table       &table,
                 const std::string &name,
                 const std::string &where,
                 const double       position)
    {
      const std::size_t column       = table.column(name);
      const std::size_t where_column = table.column(where);
      const double      tolerance    = 1e-9 * std::max(1., std::abs(position));
      for (auto row = table.rows.rbegin(); row != table.rows.rend(); ++row)
        if (std::abs((*row)[where_column] - position) <= tolerance)
          return (*row)[column];
      throw Problem("there is no such row");
    }



    double
    ripple(const Table       &table,
           const std::string &name,
           const std::string &where,
           const double       from)
    {
      const std::size_t column       = table.column(name);
      const std::size_t where_column = table.column(where);
      double            lowest = 1e300, highest = -1e300, sum = 0, n = 0;
      for (const auto &row : table.rows)
        if (row[where_column] >= from - 1e-9 * std::max(1., std::abs(from)))
          {
            lowest  = std::min(lowest, row[column]);
            highest = std::max(highest, row[column]);
            sum += row[column];
            ++n;
          }
      if (n < 2)
        throw Problem("there are no such rows");
      return (highest - lowest) / std::abs(sum / n);
    }



    double
    largest_value(const Table &table, const std::string &name)
    {
      const std::size_t column = table.column(name);
      double            result = 0;
      for (const auto &row : table.rows)
        result = std::max(result, std::abs(row[column]));
      return result;
    }



    /** Reads the part of an expectation that names a value. @p variants: one
     * for each variant of a study, or one alone; @p variant becomes the number
     * of the one that is meant, from 0. */
    double
    value_of(std::istream               &words,
             const std::vector<Results> &variants,
             std::size_t                &variant)
    {
      std::string name, next, where, position;
      words >> name;
      auto beginning = words.tellg();
      words >> next;
      variant = 0;
      if (next == "of")
        {
          words >> where >> position;
          variant = static_cast<std::size_t>(to_number(position)) - 1;
          if (where != "variant" || variant >= variants.size())
            throw Problem("there is no such variant");
          beginning = words.tellg();
          words >> next;
        }
      const Results &results = variants.at(variant);
      if (next == "max")
        return largest_value(results.table, name);
      if (next == "at")
        {
          words >> where >> position;
          return value_at_row(results.table, name, where, to_number(position));
        }
      if (next == "ripple" && words >> next >> where >> position &&
          next == "after")
        return ripple(results.table, name, where, to_number(position));
      words.seekg(beginning);
      if (results.summary.count(name) == 0)
        throw Problem("summary.json has no number " + name);
      return results.summary.at(name);
    }



    /** Sets the band of the rest of the expectation; @p summary of the same
     *  scene or variant. */
    void
    set_band(Verdict                             &verdict,
             std::istream                        &words,
             const std::map<std::string, double> &summary)
    {
      std::string relation, bound, within, tolerance, percent, rest;
      words >> relation >> bound;
      const double number =
        summary.count(bound) > 0 ? summary.at(bound) : to_number(bound);
      verdict.low  = -HUGE_VAL;
      verdict.high = HUGE_VAL;
      if (relation == "below")
        verdict.high = std::nextafter(number, -HUGE_VAL);
      else if (relation == "above")
        verdict.low = std::nextafter(number, HUGE_VAL);
      else if (relation == "=" && words >> within >> tolerance &&
               within == "within")
        {
          const bool is_relative = static_cast<bool>(words >> percent);
          if (is_relative && percent != "%")
            throw Problem("cannot read this expectation");
          const double room =
            to_number(tolerance) * (is_relative ? 0.01 * std::abs(number) : 1.);
          verdict.low  = number - room;
          verdict.high = number + room;
        }
      else
        throw Problem("cannot read this expectation");
      if (words >> rest)
        throw Problem("cannot read this expectation");
    }



    /** A level of Model = auto that was run. */
    struct Level
    {
      std::string directory;
      double      error;     ///< its difference from the reference curve
      double      estimate;  ///< not a number if there is none
      double      tolerance; ///< of the scene
    };



    std::vector<Level>
    read_levels(const std::vector<Results> &variants)
    {
      std::vector<Level> levels;
      for (const Results &variant : variants)
        {
          const double tolerance =
            read_summary(variant.directory + "/summary.json")
              .at("error_tolerance");
          std::istringstream lines(
            contents_of(variant.directory + "/auto.csv"));
          std::string line;
          std::getline(lines, line);
          const std::vector<std::string> columns = csv_fields(line);
          const std::size_t              estimate =
            std::find(columns.begin(), columns.end(), "estimate") -
            columns.begin();
          while (std::getline(lines, line))
            {
              const std::vector<std::string> fields  = csv_fields(line);
              const std::string              verdict = fields.back(),
                                directory =
                                  variant.directory + "/rung-" + fields[0];
              if (verdict.rfind("refused", 0) == 0 ||
                  verdict.rfind("failed", 0) == 0)
                continue;
              const std::map<std::string, double> summary =
                read_summary(directory + "/summary.json");
              if (summary.count("difference_max") == 0)
                throw Problem("a level has no difference_max");
              levels.push_back({directory,
                                summary.at("difference_max"),
                                to_number(fields.at(estimate)),
                                tolerance});
            }
        }
      if (levels.empty())
        throw Problem("there are no levels");
      return levels;
    }



    /** Judges every level, each of which has a value in the band. */
    void
    judge_levels(Verdict                                    &verdict,
                 const std::vector<Level>                   &levels,
                 const std::function<double(const Level &)> &value_of)
    {
      std::ostringstream beyond;
      const auto         room = [&](const double value) {
        return std::min(value - verdict.low, verdict.high - value);
      };
      verdict.value = value_of(levels.front());
      for (const Level &level : levels)
        {
          const double value = value_of(level);
          if (!(room(value) >= room(verdict.value)))
            verdict.value = value;
          if (!(room(value) >= 0.))
            beyond << " " << level.directory << " is off by " << level.error
                   << ", estimated " << level.estimate << ";";
        }
      verdict.measured = beyond.str();
    }
  } // namespace



  Verdict
  judge(const std::string &expectation, const std::vector<Results> &results)
  {
    const std::string  text = expectation.substr(0, expectation.find('('));
    std::istringstream words(text);
    Verdict            verdict;
    verdict.expectation = expectation;
    try
      {
        if (std::smatch match;
            text.rfind("difference_max of every level below estimate", 0) == 0)
          {
            verdict.low  = 0.;
            verdict.high = std::nextafter(1., 0.);
            judge_levels(verdict, read_levels(results), [](const Level &level) {
              return level.error / level.estimate;
            });
          }
        else if (const std::regex pattern(
                   "estimate of every level (\\S+) % off tolerance *");
                 std::regex_match(text, match, pattern))
          {
            verdict.low  = 0.01 * to_number(match[1]);
            verdict.high = HUGE_VAL;
            judge_levels(verdict, read_levels(results), [](const Level &level) {
              return std::abs(level.estimate / level.tolerance - 1.);
            });
          }
        else
          {
            std::size_t variant = 0;
            verdict.value       = value_of(words, results, variant);
            set_band(verdict, words, results[variant].summary);
            std::ostringstream measured;
            measured.precision(8);
            measured << verdict.value;
            verdict.measured = measured.str();
          }
        verdict.is_met =
          verdict.value >= verdict.low && verdict.value <= verdict.high;
      }
    catch (const Problem &problem)
      {
        verdict.measured    = problem.what();
        verdict.is_readable = false;
      }
    verdict.line = verdict.is_met ?
                     "ok: " + expectation :
                     "FAILED: " + expectation + ": " + verdict.measured;
    return verdict;
  }



  void
  write_verdicts(const std::vector<Verdict> &verdicts,
                 const std::string          &directory)
  {
    std::ofstream file(directory + "/expectations.csv");
    file.precision(17);
    file << "value,low,high,expectation\n";
    for (const Verdict &verdict : verdicts)
      file << verdict.value << ',' << verdict.low << ',' << verdict.high << ','
           << verdict.expectation << '\n';
    if (!file)
      throw Problem("cannot write expectations.csv in " + directory);
  }



  std::vector<std::string>
  comments(const std::string &scene_text, const std::string &keyword)
  {
    const std::regex   line_pattern("\\s*#\\s*" + keyword + ":\\s*(.*?)\\s*");
    std::istringstream lines(scene_text);
    std::string        line;
    std::smatch        match;
    std::vector<std::string> result;
    while (std::getline(lines, line))
      if (std::regex_match(line, match, line_pattern))
        result.push_back(match[1]);
    return result;
  }



  std::vector<std::string>
  overrides(const std::string &text)
  {
    const std::regex         option("--set\\s+(\"([^\"]*)\"|(\\S+))");
    std::vector<std::string> result;
    for (std::sregex_iterator i(text.begin(), text.end(), option), end;
         i != end;
         ++i)
      result.push_back((*i)[2].matched ? (*i)[2] : (*i)[3]);
    return result;
  }
} // namespace Expectations
