#pragma once

#include <debond/interface/contact_point_state.h>
#include <debond/interface/towed_gap.h>

#include <Eigen/Core>

namespace Debond
{
  /** A slave point in a step: what is known before its new xi_hat is.
   *  All that is referred to must outlive it. */
  struct PointStep
  {
    const ContactPointLaw   &law;
    const ContactPointMode  &mode;
    const MasterSurface     &master;
    const ContactPointState &before; ///< with an xi_hat^n
    Eigen::Vector3d          x;      ///< where the slave point ends [mm]
    PointStart               start;  ///< what the law knows of it

    // What the point had come to at the end of the step before, where the
    // master has taken it: y(xi_hat^n) and the gap [mm]. For slip that is
    // integrated over the step, the length of the gap at which the point slid
    // [mm], and its way.
    Eigen::Vector3d y_old = Eigen::Vector3d::Zero(), old_gap = y_old;
    double          old_limit = 0.;
    Arc             arc       = Arc();

    const InterfaceLaw &
    joint() const
    {
      return *law.joint;
    }

    /** Writes what a point that is closed carries: the tractions of a
     *  @p response along the normal @p n and a @p tangential one [MPa], at the
     *  gap @p g_n [mm]; and its history after sliding by @p distance [mm]. */
    void
    carry(const InterfaceResponse &response,
          const Eigen::Vector3d   &n,
          const Eigen::Vector3d   &tangential,
          const double             g_n,
          const double             distance,
          ContactPointResult      &result) const
    {
      result.normal_gap          = g_n;
      result.pressure            = response.pressure;
      result.viscous_pressure    = response.viscous_pressure;
      result.tangential_traction = tangential;
      result.traction            = -response.pressure * n + tangential;
      // the potential that Eq. (28) comes from
      result.energy = response.energy +
                      0.5 * tangential.squaredNorm() / law.tangential_penalty;
      // what slides in the bone leaves the interface as it is
      static_cast<PointHistory &>(result.state) = joint().advance(
        start, g_n, joint().bone.shear_wears_bond ? distance : response.rubbed);
      result.state.sheared += distance - response.rubbed;
    }
  };
} // namespace Debond
