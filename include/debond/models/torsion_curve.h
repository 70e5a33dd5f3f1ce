#ifndef debond_models_torsion_curve_h
#define debond_models_torsion_curve_h

#include <debond/models/closed_forms.h>

#include <Eigen/Core>

#include <vector>

namespace Debond
{
  /**
   * The torque [N mm] of RigidBodiesTorsion at many @p angles [rad] at once. The
   * traction depends on the path s = r theta alone, so that one integral along
   * it serves all of them,
   *
   *   T(theta) = 2 pi / |theta|^3 int_0^(R |theta|) s^2 t(s) ds,
   *
   * taken over the sliding distance g, s = g + mu(g) p / eps_t, which takes no
   * iteration between the ends.
   *
   * @p disk must have a unique solution.
   */
  Eigen::VectorXd
  torsion_curve(const TorsionModel::Disk  &disk,
                const std::vector<double> &angles);
} // namespace Debond
#endif
