#ifndef debond_interface_interface_summary_h
#define debond_interface_interface_summary_h

#include <debond/interface/interface_configuration.h>
#include <debond/interface/slave_point.h>

namespace Debond
{
  /** Sums over all points of the interface in their trial states, and what is
   *  largest among them. */
  struct InterfaceSummary
  {
    double normal_force = 0; ///< int p dA [N]
    double phi_mean     = 0; ///< area mean over the implant's contact face
    double share_stick = 0, share_slip = 0, share_open = 0; ///< of that area
    double energy = 0;                                      ///< stored [N mm]
    /** Largest |d mu/d g_s| p / (eps_t + eta / dt). */
    double max_softening = 0;
    /** The same where the law of a point falls steepest from the g_s on that
     *  the step began with: the local solution is unique while this is below
     *  1. Zero for the explicit law, which does not ask. */
    double steepest_softening = 0;
    /** p, and |d mu/d g_s| of that point [MPa, 1/mm]. */
    double       softening_pressure = 0, softening_slope = 0;
    double       max_penetration = 0; ///< [mm]
    unsigned int bonded_opened =
      0; ///< points with phi > 0 that opened in this step
    unsigned int n_closed = 0;
  };

  /** Area mean of the sliding distance g_s over the contact face [mm], and its
   *  derivatives with respect to the positions of the control points of both
   *  surfaces, in space. */
  struct MeanSlip
  {
    double    value = 0;
    NodalSums gradient;
  };

  /** The works of the interface up to the accepted state [N mm]. */
  struct InterfaceWork
  {
    /** Dissipated work, a trapezoid in the traction. */
    double dissipation = 0;
    /** Slip of the last step times the tractions at its end. A trapezoid may be
     *  negative where the slip reverses; this is so only where points slide
     *  along their traction. */
    double step_dissipation = 0;
    /** The part of the dissipation that breaks the bond (D_adh, integral of (mu
     *  - mu_b) p dg_s): the mean pressure times the exact integral over the
     *  sliding distance. */
    double adhesive = 0;
    /** The part of the dissipation that the viscosity makes up. */
    double viscous = 0;
    /** Work of friction with the integral of the law over the sliding distance
     *  instead of a trapezoid, and of viscosity: a step that jumps dissipates
     *  no more than that. */
    double friction = 0;
    /** How far the work of friction and the stored energy may be wrong because
     *  the pressure or the speed changes while a point slides, and because
     *  points that open slide before they do; a bound of the sum over all
     *  steps. */
    double friction_bound = 0;

    /** Adds the work of @p point from its accepted state to its trial state;
     *  @p mode: of the step; @p frame: Q of the master. */
    void
    add(const SlavePoint       &point,
        const FrictionLaw      &law,
        const ContactPointMode &mode,
        const Eigen::Matrix3d  &frame);

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &dissipation &adhesive &viscous &friction &friction_bound;
    }
  };
} // namespace Debond
#endif
