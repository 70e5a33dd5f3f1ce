#ifndef debond_interface_local_motion_h
#define debond_interface_local_motion_h

#include <debond/interface/interface_configuration.h>

namespace Debond
{
  /** A change of w of a point, see ContactPointResult. */
  using LocalVector = Eigen::Matrix<double, ContactPointResult::n_w, 1>;

  /** dw of a closed point when the control points of both surfaces move, and
   *  its way turns by @p turn more [rad]; parameters stay. */
  LocalVector
  local_motion(const SlavePoint &point,
               Side              slave,
               const NodalSums  &moved,
               double            turn);

  /** Adds what changes of traction, times JxW [N], and of xi_hat do to the
   *  nodal forces of a closed point. */
  void
  spread_change(const SlavePoint      &point,
                Side                   slave,
                const Eigen::Vector3d &dt,
                const Eigen::Vector2d &dxi,
                NodalSums             &sums);
} // namespace Debond
#endif
