#ifndef debond_interface_point_friction_h
#define debond_interface_point_friction_h

#include <debond/interface/friction_law.h>
#include <debond/interface/towed_gap.h>

#include <Eigen/Core>

#include <algorithm>

namespace Debond
{
  /** The friction of a point in this step: what its law says of a distance,
   *  how sliding is resisted by its speed, and where it goes. */
  struct PointFriction
  {
    // The law, and the point at the beginning of the step. The answer of the
    // law is not used in the frictionless part of a load history. The viscosity
    // resists with a stiffness.
    const FrictionLaw &law;
    FrictionState      start;
    bool               frictionless = false;
    double             viscous      = 0.; ///< eta / dt [MPa/mm]
    /** The gap of the step before, where the master has taken it [mm]. */
    Eigen::Vector3d old_gap = Eigen::Vector3d::Zero();
    // For slip that is integrated over the step: mu at the end of the step
    // before, the length at which it slides there, and the way.
    double old_mu    = 0.;
    double old_limit = 0.; ///< [mm]
    Arc    arc       = Arc();

    /** mu and its slope once the point has slid by @p distance. */
    FrictionCoefficient
    after(const double distance) const
    {
      return frictionless ? FrictionCoefficient() :
                            law.coefficient(start, distance);
    }

    /** mu p + eta V once it has slid by @p distance [MPa]. */
    struct Limit
    {
      FrictionCoefficient coefficient;
      double              value, slope;
    };
    // A point cannot slide against what pulls it. Where Newton's method looks
    // there, at negative distances, mu goes on along its tangent, but never
    // rises: the distance alone would have a second solution there where
    // friction rises with the speed, a rise one where it falls steeply.
    Limit
    limit(const double pressure, const double distance) const
    {
      FrictionCoefficient coefficient = after(std::max(0., distance));
      if (distance < 0.)
        {
          coefficient.dmu = std::max(0., coefficient.dmu);
          coefficient.mu += coefficient.dmu * distance;
        }
      // the viscous part resists as fast as the point moves, and it pulls where
      // a trial moves backwards
      const double resistance = pressure > 0. ? viscous : 0.;
      return {coefficient,
              coefficient.mu * pressure + resistance * distance,
              coefficient.dmu * pressure + resistance};
    }
  };
} // namespace Debond
#endif
