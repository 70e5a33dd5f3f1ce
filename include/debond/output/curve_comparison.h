#pragma once

#include <debond/scene/reference_data.h>

#include <nlohmann/json_fwd.hpp>

#include <limits>
#include <string>
#include <vector>

namespace Debond
{
  struct Scene;

  /** How the angle runs over the rows of a curve. Changes that are rounding
   *  errors of a chuck that is free to turn are no rotation. */
  struct Rotation
  {
    double       tolerance = 0; ///< [deg]
    double       direction = 0; ///< +1, -1; 0: nothing rotates
    bool         reverses  = false;
    unsigned int first_row = 0; ///< the first one with another angle

    /** What goes back by @p part of the range of all angles is none. */
    explicit Rotation(const ReferenceCurve &curve, double part = 0.);
  };

  /** Torque at an angle, linear between the points of a curve whose angles do
   *  not fall; NaN beside them. Differences of angles up to @p tolerance are
   *  rounding errors. */
  double
  torque_at(const ReferenceCurve &curve, double angle, double tolerance);

  /** The largest magnitude of its angles, `first`, or torques, `second`. */
  double
  largest(const ReferenceCurve &curve,
          double ReferenceCurve::value_type::*member);

  /** Of a curve to and fro the way to where it is furthest from its beginning,
   *  from where it turned before: bonds are pressed before they are pulled. */
  ReferenceCurve
  main_branch(const ReferenceCurve &curve);

  /**
   * How far a computed curve is from a measured one, at the rows of the latter
   * that the former covers and whose angles are positive, or negative if the
   * implant turns backwards. Curves that are no torque over an angle are
   * compared along their main_branch(). Rows with less than a hundredth of the
   * largest measured torque would dominate a relative error: e_mp, and e_mp
   * alone, leaves them out. What has failed is compared like all else. NaN if
   * there is no row, or if the computed curve does not turn or turns back.
   */
  struct CurveComparison
  {
    static constexpr double undefined =
      std::numeric_limits<double>::quiet_NaN();

    unsigned int rows_used = 0;         ///< of the measured curve
    double       e_mp      = undefined; ///< Eq. (19), a ratio
    double       e_rel     = undefined; ///< Eq. (50), a ratio
    /** Mean and largest difference over the largest measured torque. */
    double    difference_mean = undefined, difference_max = undefined;
    double    position_of_max = undefined; ///< where it is largest
    CurveAxes axes;
    /** What may be wrong with the measured curve: its units, its sign. */
    std::vector<std::string> remarks;
    std::string              why_none; ///< no row is used; else empty

    /** The remark on torques that do not resist the rotation. */
    static std::string
    opposite_sign(const CurveAxes &axes = {});

    CurveComparison() = default;
    CurveComparison(const ReferenceCurve &computed,
                    const ReferenceCurve &measured,
                    const CurveAxes      &axes = {});

    /** All numbers, as members of a summary. */
    nlohmann::ordered_json
    members() const;

    static constexpr const char *remark_begins = "e_mp, e_rel: ";

    /** Puts all numbers into a summary, and into its `remarks` what is to be
     *  said of them. */
    void
    put_into(nlohmann::ordered_json &summary) const;

    /** What a user is to be warned of, about the measured curve in @p file. */
    std::vector<std::string>
    warnings(const std::string &file) const;

    /** "2.3 % in the mean, 6 % at most, at 0.9 deg", or why not. */
    std::string
    text() const;
  };

  /** Warnings about the `Output / Reference curve` before the scene is run. */
  std::vector<std::string>
  doubts_of_reference(const Scene &scene);
} // namespace Debond
