#include <debond/input/csv_table.h>
#include <debond/output/torque_curve.h>

#include <deal.II/base/numbers.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace Debond
{
  namespace
  {
    std::vector<double>
    values_of(TorqueRow row)
    {
      std::vector<double> values;
      row.for_each_column([&](const std::string &, const double value) {
        values.push_back(value);
      });
      return values;
    }



    /** The row at the part @p s of the step between two, linear. */
    TorqueRow
    row_on_chord(TorqueRow row, const TorqueRow &end, const double s)
    {
      const std::vector<double> ends = values_of(end);
      unsigned int              i    = 0;
      row.for_each_column([&](const std::string &, auto &value) {
        value += s * (ends[i++] - value);
      });
      return row;
    }



    /** The same on Hermite's cubic. */
    TorqueRow
    row_between(const TorqueRow &begin, const TorqueRow &end, const double s)
    {
      TorqueRow              row    = row_on_chord(begin, end, s);
      const double           h      = end.time - begin.time;
      const TorqueRow::Curve start  = begin.curve(),
                             change = end.curve() - start,
                             values =
                               start + s * change +
                               s * (1. - s) *
                                 ((1. - s) * (h * end.rates_at_begin - change) -
                                  s * (h * end.rates_at_end - change));
      row.torque_Nmm     = values[0];
      row.chuck_reaction = values.segment<6>(1);
      row.chuck_position = values.tail<6>();
      row.angle_deg      = row.chuck_position[5];
      row.force_N        = 0. - row.chuck_reaction[2];
      return row;
    }
  } // namespace



  std::string
  torque_line(const TorqueRow &row)
  {
    return csv_line(values_of(row));
  }



  std::string
  torque_table(const std::vector<TorqueRow> &rows, const bool of_curve)
  {
    std::vector<std::string> names;
    std::vector<bool>        is_shown;
    TorqueRow().for_each_column([&](const std::string &name, double) {
      is_shown.push_back(!of_curve || name == "time" || name == "angle_deg" ||
                         name == "torque_Nmm" || name == "force_N" ||
                         name.rfind("chuck_", 0) == 0);
      if (is_shown.back())
        names.push_back(name);
    });
    std::string table = csv_line(names);
    for (const TorqueRow &row : rows)
      {
        std::vector<double> shown;
        unsigned int        column = 0;
        for (const double value : values_of(row))
          if (is_shown[column++])
            shown.push_back(value);
        table += csv_line(shown);
      }
    return table;
  }



  std::vector<TorqueRow>
  fine_curve(const std::vector<TorqueRow> &rows)
  {
    constexpr unsigned int n_parts = 16;
    std::vector<TorqueRow> fine;
    for (const TorqueRow &row : rows)
      {
        if (row.is_curved())
          for (unsigned int part = 1; part < n_parts; ++part)
            fine.push_back(
              row_between(rows[row.step - 1], row, double(part) / n_parts));
        fine.push_back(row);
      }
    return fine;
  }



  std::vector<TorqueRow>
  rows_at(const std::vector<TorqueRow> &fine, const std::vector<double> &angles)
  {
    std::vector<TorqueRow> result;
    bool                   has_turned = false;
    for (std::size_t i = 0; i + 1 < fine.size(); ++i)
      {
        const TorqueRow &begin = fine[i], &end = fine[i + 1];
        const double     turned = end.angle_deg - begin.angle_deg;
        // angles go from degrees to radians and back
        const double rounding = 1e-9 * std::max(1., std::abs(end.angle_deg));
        if (std::abs(turned) <= rounding)
          continue;
        std::vector<double> parts;
        for (const double angle : angles)
          if (std::abs(angle - end.angle_deg) <= rounding)
            parts.push_back(1.);
          else if (!has_turned && std::abs(angle - begin.angle_deg) <= rounding)
            parts.push_back(0.);
          else if ((angle - begin.angle_deg) * turned >
                     rounding * std::abs(turned) &&
                   (end.angle_deg - angle) * turned > 0.)
            parts.push_back((angle - begin.angle_deg) / turned);
        std::sort(parts.begin(), parts.end());
        for (const double part : parts)
          result.push_back(part == 1. ? end : row_on_chord(begin, end, part));
        has_turned = true;
      }
    return result;
  }



  ReferenceCurve
  curve_of(const std::vector<TorqueRow> &rows, const CurveAxes &axes)
  {
    ReferenceCurve curve;
    for (const TorqueRow &row : rows)
      if (axes.is_torsion())
        curve.emplace_back(row.angle_deg, row.torque_Nmm);
      else
        curve.emplace_back(row.chuck_position[axes.position],
                           row.chuck_reaction[axes.load]);
    return curve;
  }
} // namespace Debond
