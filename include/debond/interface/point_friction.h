#ifndef debond_interface_point_friction_h
#define debond_interface_point_friction_h

#include <debond/interface/interface_law.h>
#include <debond/interface/towed_gap.h>

#include <Eigen/Core>

namespace Debond
{
  /** The friction of a point in this step: what its law says of a distance,
   *  how sliding is resisted by its speed, and where it goes. */
  struct PointFriction
  {
    const InterfaceLaw &law;
    PointStart          start;
    double              viscous = 0.; ///< eta / dt [MPa/mm]
    /** The gap of the step before, where the master has taken it [mm]. */
    Eigen::Vector3d old_gap = Eigen::Vector3d::Zero();
    // For slip that is integrated over the step: the length at which the point
    // slides at the end of the step before, and the way.
    double old_limit = 0.; ///< [mm]
    Arc    arc       = Arc();

    /** L + eta V at a distance [MPa], and its slope; what of that is viscous
     *  [MPa/mm]. */
    struct Limit
    {
      double value, slope, resistance;
    };
    // The viscous part resists as fast as the point moves, and it pulls where a
    // trial moves backwards.
    Limit
    limit(const InterfaceResponse &response, const double distance) const
    {
      const double resistance = response.resists ? viscous : 0.;
      return {response.limit + resistance * distance,
              response.limit_by_slip + resistance,
              resistance};
    }
  };
} // namespace Debond
#endif
