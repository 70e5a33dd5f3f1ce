#include <debond/input/allowed_values.h>
#include <debond/input/csv_table.h>
#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>
#include <debond/support/number_text.h>

#include <deal.II/base/numbers.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Debond
{
  std::string
  torque_line(TorqueRow row)
  {
    std::vector<double> values;
    row.for_each_column([&](const std::string &, const double value) {
      values.push_back(value);
    });
    return csv_line(values);
  }



  std::string
  torque_table(const std::vector<TorqueRow> &rows)
  {
    std::vector<std::string> names;
    TorqueRow().for_each_column(
      [&](const std::string &name, double) { names.push_back(name); });
    std::string table = csv_line(names);
    for (const TorqueRow &row : rows)
      table += torque_line(row);
    return table;
  }



  TorqueRow::Rates
  TorqueRow::rates_of_parabola(TorqueRow before) const
  {
    Rates        result = rates_at_end;
    TorqueRow    end    = *this;
    const double h      = time - before.time;
    unsigned int i      = 0;
    for_each_curve(end, [&](const double value) {
      result[i] = 2. * value / h - result[i];
      ++i;
    });
    i = 0;
    for_each_curve(before,
                   [&](const double value) { result[i++] -= 2. * value / h; });
    return result;
  }



  namespace
  {
    /** The row at the part @p s of the step between two, linear. */
    TorqueRow
    row_on_chord(TorqueRow row, TorqueRow end, const double s)
    {
      std::vector<double> ends;
      end.for_each_column([&](const std::string &, const double value) {
        ends.push_back(value);
      });
      unsigned int i = 0;
      row.for_each_column([&](const std::string &, auto &value) {
        value += s * (ends[i++] - value);
      });
      return row;
    }



    /** The same on Hermite's cubic. */
    TorqueRow
    row_between(TorqueRow begin, TorqueRow end, const double s)
    {
      TorqueRow           row = row_on_chord(begin, end, s);
      const double        h   = end.time - begin.time;
      unsigned int        i   = 0;
      std::vector<double> ends;
      TorqueRow::for_each_curve(end, [&](const double value) {
        ends.push_back(value);
      });
      TorqueRow::for_each_curve(begin, [&](double &value) {
        const double change = ends[i] - value;
        value +=
          s * change + s * (1. - s) *
                         ((1. - s) * (h * end.rates_at_begin[i] - change) -
                          s * (h * end.rates_at_end[i] - change));
        ++i;
      });
      row.torque_Nmm     = begin.torque_Nmm;
      row.chuck_reaction = begin.chuck_reaction;
      row.chuck_position = begin.chuck_position;
      row.angle_deg      = row.chuck_position[5];
      row.force_N        = 0. - row.chuck_reaction[2];
      return row;
    }
  } // namespace



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



  std::string
  curve_table(const std::vector<TorqueRow> &fine)
  {
    std::string table = "time,angle_deg,torque_Nmm,force_N,chuck_Fx_N,"
                        "chuck_Fy_N,chuck_Fz_N,chuck_Mx_Nmm,chuck_My_Nmm,"
                        "chuck_Mz_Nmm,chuck_ux_mm,chuck_uy_mm,chuck_uz_mm,"
                        "chuck_rx_deg,chuck_ry_deg,chuck_rz_deg\n";
    for (const TorqueRow &row : fine)
      {
        std::vector<double> values{row.time,
                                   row.angle_deg,
                                   row.torque_Nmm,
                                   row.force_N};
        for (const auto &columns : {row.chuck_reaction, row.chuck_position})
          values.insert(values.end(), columns.begin(), columns.end());
        table += csv_line(values);
      }
    return table;
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
