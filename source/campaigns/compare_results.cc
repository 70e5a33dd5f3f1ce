#include <debond/campaigns/compare_results.h>
#include <debond/input/allowed_values.h>
#include <debond/input/csv_table.h>
#include <debond/output/curve_comparison.h>
#include <debond/output/result_files.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <map>
#include <ostream>

namespace Debond
{
  namespace
  {
    using Fields = std::vector<std::string>;

    /** The entries that a table of a study or an ensemble has columns of, and
     *  their values in a row: "Bone / Size = 8; Interface / ... = 1". */
    std::string
    varied_values(const Fields &header, const Fields &row)
    {
      Fields values;
      for (std::size_t i = 0; i < std::min(header.size(), row.size()); ++i)
        if (header[i].find(" / ") != std::string::npos)
          values.push_back(header[i] + " = " + row[i]);
      return boost::join(values, "; ");
    }



    void
    print_remarks(const CurveComparison &comparison, std::ostream &out)
    {
      for (const std::string &remark : comparison.remarks)
        out << "warning: " << remark << '\n';
    }



    void
    compare_variants(const std::string    &directory,
                     const ReferenceCurve &measured,
                     std::ostream         &out)
    {
      const std::vector<Fields> table =
        read_csv_texts(directory + "/study.csv", "--compare");
      struct Compared
      {
        std::string     name;
        CurveComparison comparison;
      };
      std::vector<Compared> variants;
      unsigned int          n_without = 0;
      for (auto row = table.begin() + 1; row < table.end(); ++row)
        {
          const std::string name = Text() << "variant-" << std::setw(3)
                                          << std::setfill('0') << row->front();
          const std::string curve = finest_curve(directory + "/" + name);
          if (std::filesystem::exists(curve))
            variants.push_back(
              {name + ", " + varied_values(table.front(), *row),
               CurveComparison(read_reference_curve(curve), measured)});
          else
            ++n_without;
        }
      // what is not a number comes last
      const auto distance = [](const Compared &variant) {
        const double mean = variant.comparison.difference_mean;
        return std::isnan(mean) ? std::numeric_limits<double>::infinity() :
                                  mean;
      };
      std::stable_sort(variants.begin(),
                       variants.end(),
                       [&](const Compared &a, const Compared &b) {
                         return distance(a) < distance(b);
                       });
      if (!variants.empty())
        print_remarks(variants.front().comparison, out);
      for (const Compared &variant : variants)
        out << variant.comparison.text() << ": " << variant.name << '\n';
      if (n_without > 0)
        out << n_without << " of " << table.size() - 1
            << " variants have no curve\n";
    }



    /** The mean curve of each group, and how much of the measured one lies
     *  between its quantiles. */
    void
    compare_band(const std::string    &directory,
                 const ReferenceCurve &measured,
                 std::ostream         &out)
    {
      const std::vector<Fields> table =
        read_csv_texts(directory + "/ensemble.csv", "--compare");
      const Fields &header = table.front();
      const auto    column = [&](const std::string &name) {
        return std::find(header.begin(), header.end(), name) - header.begin();
      };
      struct Band
      {
        ReferenceCurve lowest, mean, highest;
      };
      std::vector<std::string>    names;
      std::map<std::string, Band> bands;
      for (auto row = table.begin() + 1; row < table.end(); ++row)
        {
          const std::string name = varied_values(header, *row);
          if (bands.count(name) == 0)
            names.push_back(name);
          const auto number = [&](const std::string &of) {
            return read_number(row->at(column(of)))
              .value_or(std::numeric_limits<double>::quiet_NaN());
          };
          Band        &band  = bands[name];
          const double angle = number("angle_deg");
          band.lowest.emplace_back(angle, number("torque_p05_Nmm"));
          band.mean.emplace_back(angle, number("torque_mean_Nmm"));
          band.highest.emplace_back(angle, number("torque_p95_Nmm"));
        }
      for (const std::string &name : names)
        {
          const Band  &band = bands[name];
          unsigned int n = 0, n_inside = 0;
          for (const auto &[angle, torque] : measured)
            if (const double low = torque_at(band.lowest, angle, 0.),
                high             = torque_at(band.highest, angle, 0.);
                std::isfinite(low) && std::isfinite(high))
              {
                ++n;
                n_inside += low <= torque && torque <= high;
              }
          out << CurveComparison(band.mean, measured).text()
              << ": mean of the ensemble" << (name.empty() ? "" : ", " + name)
              << "; " << n_inside << " of " << n
              << " rows lie between the quantiles of 5 and 95 %\n";
        }
    }
  } // namespace



  void
  compare_results(const std::string              &directory,
                  const std::string              &measured,
                  const std::vector<std::string> &columns,
                  std::ostream                   &out)
  {
    namespace fs = std::filesystem;
    const ClassicNumbers classic(out);
    std::string          read_from;
    const ReferenceCurve curve =
      read_curve_to_compare(measured, columns, read_from);
    const std::string own      = finest_curve(directory);
    const bool        is_study = fs::exists(directory + "/study.csv");
    if (!is_study && !fs::exists(own))
      throw InputError("debond: --compare " + directory +
                       ": there are no results in this directory, neither "
                       "torque.csv nor study.csv");
    const auto [least, most] = std::minmax_element(curve.begin(), curve.end());
    out << measured << ": " << read_from << "; " << curve.size()
        << " rows, from " << to_text(least->first, 4) << " to "
        << to_text(most->first, 4) << " deg, torques up to "
        << to_text(largest(curve, &ReferenceCurve::value_type::second), 4)
        << " N mm\n";
    if (!is_study)
      {
        const CurveComparison comparison(read_reference_curve(own), curve);
        out << directory << ": " << comparison.text();
        if (comparison.rows_used > 0)
          out << " (" << comparison.rows_used << " rows; e_mp "
              << to_text(100. * comparison.e_mp, 3) << " %, e_rel "
              << to_text(100. * comparison.e_rel, 3) << " %)";
        out << '\n';
        print_remarks(comparison, out);
        return;
      }
    compare_variants(directory, curve, out);
    if (fs::exists(directory + "/ensemble.csv"))
      compare_band(directory, curve, out);
  }
} // namespace Debond
