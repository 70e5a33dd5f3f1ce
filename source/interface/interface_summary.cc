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
    step_dissipation += trial.tangential_traction.dot(slip);
    dissipation +=
      0.5 *
      (frame * point.accepted_traction + trial.tangential_traction).dot(slip);
    // the viscous traction is anything between its two ends
    const double viscous_part =
      0.5 * (frame * point.accepted_viscous_traction + trial.viscous_traction)
              .dot(slip);
    for (double *work : {&viscous, &friction, &friction_bound})
      *work += viscous_part;

    const bool opens = trial.state.status == PointStatus::open;
    if (opens)
      friction_bound += point.JxW * point.accepted_energy;
    if (opens || mode.frictionless)
      return;
    // the law is integrated over the distance that the point slides, from its
    // accepted state, with the pressure between its two ends
    const FrictionState start =
      friction_state(point.accepted, point.phi_0, mode.duration);
    const double distance = trial.state.slip - point.accepted.slip;
    const double p = point.accepted_pressure, mean = 0.5 * (p + trial.pressure);
    const double per_pressure =
      point.JxW * law.friction_strength(start, distance);
    adhesive += point.JxW * mean * law.adhesive_strength(start, distance);
    friction += mean * per_pressure;
    friction_bound += 0.5 * std::abs(p - trial.pressure) * per_pressure +
                      mean * point.JxW * law.strength_bound(start, distance);
  }
} // namespace Debond
