#include <debond/interface/interface_summary.h>

#include <cmath>

namespace Debond
{
  // While a point slides it dissipates t_t . dy, a trapezoid between the
  // accepted and the trial traction; the accepted one was kept in the frame of
  // the master. Beside that stands the work that the law itself allows for this
  // slip, with the exact integral of mu over the distance: a step in which the
  // state jumps cannot dissipate more.
  void
  InterfaceWork::add(const SlavePoint       &point,
                     const FrictionLaw      &law,
                     const ContactPointMode &mode,
                     const Eigen::Matrix3d  &frame)
  {
    const ContactPointResult &trial = point.trial;
    const Eigen::Vector3d     slip  = point.JxW * trial.slip_increment;
    // Both are in space. xi_hat follows the slave point, and t_t, of the sign
    // of the gap x - y(xi_hat), points from it to the point: the product is
    // positive where sliding costs energy [N mm]. With the tractions at the end
    // alone it is negative only where points slide along their traction, which
    // no law of friction does.
    step_dissipation += trial.tangential_traction.dot(slip);
    dissipation +=
      0.5 *
      (frame * point.accepted_traction + trial.tangential_traction).dot(slip);
    // The viscous traction is anything between its two ends. It stands in both
    // balances, of which the second takes the law for the rest.
    const double viscous_part =
      0.5 * (frame * point.accepted_viscous_traction + trial.viscous_traction)
              .dot(slip);
    for (double *work : {&viscous, &friction, &friction_bound})
      *work += viscous_part;

    // A point that opens lets go of its springs, and may have slid before it
    // did: up to all of its stored energy may have gone into friction, which
    // cannot be told from the two ends of the step.
    const bool opens = trial.state.status == PointStatus::open;
    if (opens)
      friction_bound += point.JxW * point.accepted_energy;
    if (opens || mode.frictionless)
      return;
    // The law is integrated over the distance that the point slides, from its
    // accepted state, with the pressure between its two ends. Pressures times
    // mm are works per area. Of the friction the bond has its part, int (mu -
    // mu_b) dg_s: D_adh, which tells what the adhesion costs without reading it
    // off the torque curve as Eq. (20) does.
    const FrictionState start =
      friction_state(point.accepted, point.phi_0, mode.duration);
    const double distance = trial.state.slip - point.accepted.slip;
    const double p = point.accepted_pressure, mean = 0.5 * (p + trial.pressure);
    const double per_pressure =
      point.JxW * law.friction_strength(start, distance);
    adhesive += point.JxW * mean * law.adhesive_strength(start, distance);
    friction += mean * per_pressure;
    // What the mean pressure can be wrong by, and a speed that changes within
    // the step. The bound keeps a fast but stable fall from being reported as a
    // jump.
    friction_bound += 0.5 * std::abs(p - trial.pressure) * per_pressure +
                      mean * point.JxW * law.strength_bound(start, distance);
  }
} // namespace Debond
