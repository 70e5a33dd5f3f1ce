#include <debond/interface/interface_law.h>
#include <debond/interface/slip_problem.h>

#include <limits>

// Methods that are there to be compared with, and not to be used: the direction
// of slip that does not turn within a step, or, as Eq. (31) has it, not at all.
// doc/evidence/stability.md shows where they fail.
// What the program does by itself needs nothing of this file.
namespace Debond
{
  using Eigen::Vector3d;
  using Eigen::Vector4d;

  // `Slip direction = trial' and `previous gap': tau is the direction in which
  // the point is pulled. With `trial' that is the trial gap x - y(xi_hat^n),
  // from where its interacting point was to where the point is now, without its
  // part along the normal at xi_hat. Eq. (31) as printed has the gap of the
  // step before in its place. Then the new gap is parallel to the old one, and
  // slip never turns away from the direction in which it once began, say that
  // of the push-in.
  void
  SlipEquations::find_direction()
  {
    is_previous_gap = point.law.slip_direction == SlipDirection::previous_gap &&
                      !point.old_gap.isZero(0.);
    const Vector3d &pull = is_previous_gap ? point.old_gap : trial_gap;
    pull_along_n         = normal.n.dot(pull);
    const Vector3d u   = pull - pull_along_n * normal.n; // in the tangent plane
    pull_along_surface = u.norm();
    // a point right under its old partner is pulled nowhere: it has no tau, and
    // no tangential traction
    has_direction = pull_along_surface > std::numeric_limits<double>::min();
    tau           = Vector3d::Zero();
    if (has_direction)
      tau = u / pull_along_surface;
  }



  // The sliding distance is updated with the length of the path of the
  // interacting point in this step, both of its ends on the surface as it is
  // now, Eq. (32):
  //
  //     g_s = g_s^n + |y(xi_hat) - y(xi_hat^n)|.
  //
  // This length has a derivative along its own direction; where slip only just
  // begins it has none yet, but the limit tau. It counts as negative against
  // what pulls the point as the resistance of its speed does.
  void
  SlipEquations::find_distance()
  {
    const double length    = slip.norm();
    const bool   backwards = !is_previous_gap && slip.dot(tau) < 0.;
    distance               = backwards ? -length : length;
    forward =
      length > 1e-14 * trial_gap.norm() ? Vector3d(slip / distance) : tau;
  }



  // The path in this step is y - y_n = (x - y_n) - (x - y): the difference of
  // the two gaps. With m = n x tau the tangent plane has the axes tau and m. A
  // tau that is the direction of a vector turns towards m by the part along m
  // of its change, over its length; and with the plane, out of it.
  void
  SlipEquations::find_changes_of_direction(const Vector4d &by_distance)
  {
    change.trial = by_distance * forward.transpose();
    change.gap   = -change.trial;
    change.old_gap.setZero();
    change.turn.setZero();
    change.normal.setZero();
    if (!has_direction)
      return;
    const Vector3d                    m = normal.n.cross(tau);
    const Eigen::Matrix<double, 4, 3> turn =
      with(limit / pull_along_surface * m, 0.) * m.transpose();
    (is_previous_gap ? change.old_gap : change.trial) += turn;
    change.normal = -pull_along_n * turn;
  }
} // namespace Debond
