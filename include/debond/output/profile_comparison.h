#ifndef debond_output_profile_comparison_h
#define debond_output_profile_comparison_h

#include <debond/scene/reference_data.h>

#include <limits>

namespace Debond
{
  /** Distance of local values from those of a reference; NaN where undefined.
   */
  struct ProfileMeasures
  {
    /** Root mean square of the difference over all points, weighted by their
     *  areas, relative to the area mean of the reference, and then over the
     *  angles that both have. */
    double       pressure_difference = std::numeric_limits<double>::quiet_NaN();
    double       slip_difference     = std::numeric_limits<double>::quiet_NaN();
    unsigned int angles_used         = 0;
  };

  /**
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
  ProfileMeasures
  compare_profiles(const Profiles &profiles, const Profiles &reference);
} // namespace Debond
#endif
