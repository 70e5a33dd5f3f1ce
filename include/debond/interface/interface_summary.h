#ifndef debond_interface_interface_summary_h
#define debond_interface_interface_summary_h

#include <debond/interface/slave_point.h>

#include <vector>

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

  /** @p mode: with which the points were evaluated. */
  InterfaceSummary
  summarise(const std::vector<SlavePoint> &points,
            const ContactPointLaw         &law,
            const ContactPointMode        &mode);
} // namespace Debond
#endif
