#pragma once

#include <debond/scene/reference_data.h>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace Debond
{
  class ContactInterface;
  struct Scene;

  /** A point of the interface in profiles.csv, by the columns behind the angle:
   *  reference position x, y and distance r from the axis [mm], pressure and
   *  magnitude of the tangential traction [MPa], accumulated sliding distance
   *  g_s [mm], bonding state phi, friction coefficient mu, PointStatus, area
   *  that the point stands for [mm^2], the parts of the bond that opening and
   *  slip have left (InterfaceLaw::left_by_each()), PointTraction::mode_deg()
   * [deg], the depth of crushed bone and the distance slid in bone [mm]. */
  using InterfacePoint = Eigen::Matrix<double, 15, 1>;

  /** Their names. */
  constexpr const char *interface_columns =
    "x_mm,y_mm,r_mm,pressure_MPa,traction_MPa,slip_mm,phi,mu,state,area_mm2,"
    "left_by_opening,left_by_slip,mode_deg,crushed_mm,sheared_mm";
  constexpr unsigned int column_of_state = 8;

  /** Those of the slave points that face the implant, in the trial state. */
  std::vector<InterfacePoint>
  profile_points(const ContactInterface &interface);



  /**
   * Members of summary.json: pressure_difference_rms and slip_difference_rms,
   * the root mean square of the difference over all points, weighted by their
   * areas, relative to the area mean of the reference, and then over the angles
   * that both have, whose number is reference_angles_used; NaN where undefined.
   *
   * Compares local values at the points of @p profiles with those of a
   * reference, whose points lie elsewhere: at each point a parabola in x and y
   * is fitted to the 20 nearest points of the reference, the nearer the more
   * weight (moving least squares, Lancaster and Salkauskas 1981). The error of
   * this interpolation falls with the third power of the distance of the
   * reference's points, which therefore should lie more densely.
   *
   * A reference whose points all have y = 0, as those of closed forms, holds at
   * that radius in every direction. Angles that only one of both has are left
   * out.
   */
  nlohmann::ordered_json
  compare_profiles(const Profiles &profiles, const Profiles &reference);
} // namespace Debond
