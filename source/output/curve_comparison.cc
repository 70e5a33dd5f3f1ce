#include <debond/output/curve_comparison.h>
#include <debond/scene/scene.h>
#include <debond/support/number_text.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace Debond
{
  Rotation::Rotation(const ReferenceCurve &curve, const double part)
  {
    if (curve.empty())
      return;
    const auto [least, most] = std::minmax_element(curve.begin(), curve.end());
    const double range       = most->first - least->first;
    tolerance = std::max(1e-9 * std::max(1., range), part * range);
    if (!(range > tolerance))
      return;

    const double start = curve.front().first;
    while (std::abs(curve[first_row].first - start) <= tolerance)
      ++first_row;
    direction       = (curve[first_row].first > start ? 1. : -1.);
    double furthest = direction * start;
    for (const auto &[angle, torque] : curve)
      {
        reverses = reverses || direction * angle < furthest - tolerance;
        furthest = std::max(furthest, direction * angle);
      }
  }



  double
  torque_at(const ReferenceCurve &curve, double angle, const double tolerance)
  {
    for (const double end : {curve.front().first, curve.back().first})
      if (std::abs(angle - end) <= tolerance)
        angle = end;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i)
      {
        const auto &[begin, torque_begin] = curve[i];
        const auto &[end, torque_end]     = curve[i + 1];
        if (begin <= angle && angle <= end && begin != end)
          return angle == end ? torque_end :
                                torque_begin + (angle - begin) / (end - begin) *
                                                 (torque_end - torque_begin);
      }
    return std::numeric_limits<double>::quiet_NaN();
  }



  double
  largest(const ReferenceCurve &curve,
          double ReferenceCurve::value_type::*const member)
  {
    double result = 0.;
    for (const auto &point : curve)
      result = std::max(result, std::abs(point.*member));
    return result;
  }



  ReferenceCurve
  main_branch(const ReferenceCurve &curve)
  {
    if (curve.empty())
      return curve;
    const double start = curve.front().first;
    const auto   end   = std::max_element(curve.begin(),
                                      curve.end(),
                                      [&](const auto &a, const auto &b) {
                                        return std::abs(a.first - start) <
                                               std::abs(b.first - start);
                                      });
    // the last of equal ones
    const double direction = end->first > start ? 1. : -1.;
    auto         turn      = curve.begin();
    for (auto point = curve.begin(); point != end; ++point)
      if (direction * (point->first - turn->first) <= 0.)
        turn = point;
    return ReferenceCurve(turn, std::next(end));
  }



  std::string
  CurveComparison::opposite_sign(const CurveAxes &axes)
  {
    return std::string("the ") + axes.load_word() +
           "s of the reference curve have the opposite sign: a minus before "
           "their unit, as in [-" +
           (is_rotation(axes.load) ? "N m" : "N") + "], turns them";
  }



  namespace
  {
    constexpr auto angle_of  = &ReferenceCurve::value_type::first;
    constexpr auto torque_of = &ReferenceCurve::value_type::second;



    /** Why the measured curve may be read wrongly. */
    std::vector<std::string>
    doubts_of(const ReferenceCurve &computed,
              const ReferenceCurve &measured,
              const CurveAxes      &axes,
              const bool            is_opposite)
    {
      const double T_largest    = largest(measured, torque_of),
                   T_max        = largest(computed, torque_of),
                   end          = largest(computed, angle_of),
                   measured_end = largest(measured, angle_of);
      const std::string word = axes.load_word(), unit = axes.load_unit(),
                        position = axes.position_word(),
                        length   = axes.position_unit();
      std::vector<std::string> remarks;
      if (!(T_largest > 0.01 * T_max && T_largest < 100. * T_max))
        remarks.push_back(
          "the largest " + word + " of the reference curve is " +
          to_text(T_largest, 4) + " and that of the run " + to_text(T_max, 4) +
          " " + unit + ": is it in " + unit + "?");
      if (measured_end < 0.05 * end)
        remarks.push_back("the reference curve ends at " +
                          to_text(measured_end, 4) + " and the run at " +
                          to_text(end, 4) + " " + length + ": is it in " +
                          length + "?");
      if (is_opposite)
        remarks.push_back(CurveComparison::opposite_sign(axes));
      // by more than a twentieth of its range: angles are measured, too
      if (Rotation(measured, 0.05).reverses)
        remarks.push_back("the " + position +
                          "s of the reference curve turn back: loading and "
                          "unloading, or two tests, are compared with one "
                          "curve");
      return remarks;
    }



    /** " from 0 to 10 deg". */
    std::string
    range_of(const ReferenceCurve &curve, const CurveAxes &axes)
    {
      return " from " + to_text(curve.front().first, 4) + " to " +
             to_text(curve.back().first, 4) + " " + axes.position_unit();
    }
  } // namespace



  CurveComparison::CurveComparison(const ReferenceCurve &all,
                                   const ReferenceCurve &all_measured,
                                   const CurveAxes      &axes)
    : axes(axes)
  {
    const bool           is_torsion = axes.is_torsion();
    const ReferenceCurve computed   = is_torsion ? all : main_branch(all),
                         measured   = is_torsion ? all_measured :
                                                   main_branch(all_measured);
    const Rotation rotation(computed);
    const double   T_largest = largest(measured, torque_of);
    why_none                 = measured.empty() ? "there is no curve" :
                               rotation.direction == 0. ? "nothing has moved in the run" :
                               rotation.reverses ? "the run turns back" :
                               T_largest == 0.   ? "all of it is zero" :
                                                   "";
    if (!why_none.empty())
      return;
    ReferenceCurve curve = computed; // in ascending order
    for (auto &[angle, torque] : curve)
      angle *= rotation.direction;

    double       sum_mp = 0., sum = 0., products = 0., most = -1.;
    unsigned int rows_mp = 0, rows_at_rest = 0;
    for (const auto &[angle, T_measured] : measured)
      {
        const double turned = rotation.direction * angle;
        // angles go from degrees to radians and back
        const double T = torque_at(curve, turned, rotation.tolerance);
        rows_at_rest += is_torsion && turned == 0.;
        if (!((turned > 0. || !is_torsion) && std::isfinite(T)))
          continue;
        const double difference = std::abs(T - T_measured);
        if (std::abs(T_measured) > 0.01 * T_largest)
          {
            sum_mp += difference / std::abs(T_measured);
            ++rows_mp;
          }
        sum += difference;
        products += T * T_measured;
        ++rows_used;
        if (difference > most)
          {
            most            = difference;
            position_of_max = angle;
          }
      }
    remarks =
      doubts_of(computed, measured, axes, rows_used > 1 && products < 0.);
    const unsigned int n = measured.size() - rows_at_rest;
    if (rows_used > 0 && 2 * rows_used < n)
      remarks.push_back(
        "of " + std::to_string(n) + " rows of the reference curve only " +
        std::to_string(rows_used) + " are compared: the run goes" +
        range_of(computed, axes));
    if (rows_used == 0)
      why_none = "the run goes" + range_of(computed, axes) + ", and the curve" +
                 range_of(measured, axes);
    e_mp            = sum_mp / rows_mp; // 0 / 0 without one: undefined
    e_rel           = sum / rows_used / largest(computed, torque_of);
    difference_mean = sum / rows_used / T_largest;
    difference_max  = rows_used == 0 ? undefined : most / T_largest;
  }



  nlohmann::ordered_json
  CurveComparison::members() const
  {
    return {{"e_mp", e_mp},
            {"e_rel", e_rel},
            {"difference_max", difference_max},
            {"difference_mean", difference_mean},
            {"reference_rows_used", rows_used},
            {"difference_max_deg",
             is_rotation(axes.position) ? position_of_max : undefined}};
  }



  void
  CurveComparison::put_into(nlohmann::ordered_json &summary) const
  {
    summary.update(members());
    if (!axes.is_torsion())
      summary["curve"]["difference_max_at"] = position_of_max;
    if (rows_used == 0)
      summary["remarks"].push_back(remark_begins + ("null, " + why_none));
    for (const std::string &remark : remarks)
      summary["remarks"].push_back(remark_begins + remark);
  }



  std::vector<std::string>
  CurveComparison::warnings(const std::string &file) const
  {
    std::vector<std::string> texts;
    if (rows_used == 0)
      texts.push_back(file + " could not be compared with: " + why_none);
    for (const std::string &remark : remarks)
      texts.push_back(file + ": " + remark);
    return texts;
  }



  std::string
  CurveComparison::text() const
  {
    if (rows_used == 0)
      return "not compared: " + why_none;
    const auto percent = [](const double ratio) {
      const double value = 100. * ratio;
      return to_text(value >= 100. ? std::round(value) : value,
                     value >= 100. ? 6 : 2);
    };
    return percent(difference_mean) + " % in the mean, " +
           percent(difference_max) + " % at most, at " +
           to_text(position_of_max, 3) + " " + axes.position_unit();
  }



  // As if the implant turned as the scene prescribes, with a torque that
  // resists it and is as large as the measured one.
  std::vector<std::string>
  doubts_of_reference(const Scene &scene)
  {
    const CurveAxes     &axes = scene.output.axes;
    const std::string   &file = scene.output.reference_curve;
    const ReferenceCurve measured =
      read_reference_curve(file, scene.output.reference_columns, axes);
    if (measured.empty())
      return {};
    const double   T_largest = largest(measured, torque_of);
    ReferenceCurve expected;
    for (const double value : scene.sampled_values(axes.position))
      expected.emplace_back(value,
                            value == 0. ? 0. : std::copysign(T_largest, value));
    // of a moment only the direction is known
    const double load = largest(expected, angle_of);
    if (scene.chuck.component[axes.position].loaded && load > 0.)
      for (auto &[angle, torque] : expected)
        angle *= largest(measured, angle_of) / load;
    return CurveComparison(expected, measured, axes).warnings(file);
  }
} // namespace Debond
