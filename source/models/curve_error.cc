#include <debond/models/curve_error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Debond
{
  double
  largest_difference(const std::vector<TorqueRow> &rows,
                     const std::vector<TorqueRow> &reference)
  {
    // two polygons differ most at a corner of one of them
    const auto measures = [](const std::vector<TorqueRow> &rows,
                             const std::vector<TorqueRow> &others) {
      CurveSettings settings;
      for (const TorqueRow &row : others)
        settings.reference.emplace_back(row.angle_deg, row.torque_Nmm);
      return measure_torque_curve(rows, settings);
    };
    const CurveMeasures there = measures(rows, reference);
    const CurveMeasures back  = measures(reference, rows);
    const double        difference_back =
      back.difference_max * there.T_max_Nmm / back.T_max_Nmm;
    return std::isnan(difference_back) ?
             difference_back :
             std::max(difference_back, there.difference_max);
  }



  double
  discretisation_error(const std::vector<double> &differences)
  {
    constexpr double reserve = 1.25, lowest_order = 0.5, highest_order = 2.;
    const double     last = differences.back();
    if (last == 0.)
      return 0.;
    double order = 1.;
    if (differences.size() > 1)
      order = std::min(std::log2(differences[differences.size() - 2] / last),
                       highest_order);
    if (!(order >= lowest_order))
      return std::numeric_limits<double>::quiet_NaN();
    return reserve * last / (std::exp2(order) - 1.);
  }
} // namespace Debond
