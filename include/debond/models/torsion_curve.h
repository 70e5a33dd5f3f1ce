#ifndef debond_models_torsion_curve_h
#define debond_models_torsion_curve_h

#include <debond/models/closed_forms.h>

#include <Eigen/Core>

#include <vector>

namespace Debond
{
  /** How a disk changes with a parameter, by its unit. */
  struct DiskVariation
  {
    double pressure = 0, stiffness = 0, phi_0 = 0, bonded_radius = 0;
    /** The friction law of two values of the parameter that differ by `width`,
     *  of which its derivative is the difference; null: it does not change. */
    FrictionLawPointer plus, minus;
    double             width = 0;
  };

  /** Torque T [N mm] at each of several angles, and by column its derivatives
   *  with respect to parameters. */
  struct TorsionCurve
  {
    Eigen::VectorXd torque;
    Eigen::MatrixXd derivative;
  };

  /**
   * The torque of RigidBodiesTorsion at many @p angles [rad] at once. The
   * traction depends on the path s = r theta alone, so that one integral along
   * it serves all of them,
   *
   *   T(theta) = 2 pi / |theta|^3 int_0^(R |theta|) s^2 t(s) ds,
   *
   * taken over the sliding distance g, s = g + mu(g) p / eps_t, which takes no
   * iteration between the ends. At a given s
   *
   *   dt = mu' p dg + d(mu p),   dg = - (d(mu p) - mu p d(eps_t)/eps_t)
   *                                     / (eps_t + mu' p).
   *
   * @p disk must have a unique solution.
   */
  TorsionCurve
  torsion_curve(const TorsionModel::Disk         &disk,
                const std::vector<double>        &angles,
                const std::vector<DiskVariation> &variations = {});
} // namespace Debond
#endif
