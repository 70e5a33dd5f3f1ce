#include <debond/interface/interface_work.h>

#include <cmath>

namespace Debond
{
  void
  InterfaceWork::begin_step()
  {
    step_dissipation = 0.;
  }



  void
  InterfaceWork::add(const SlavePoint       &point,
                     const FrictionLaw      &law,
                     const ContactPointMode &mode,
                     const Eigen::Matrix3d  &frame)
  {
    const ContactPointResult &trial = point.trial;
    step_dissipation +=
      point.JxW * trial.tangential_traction.dot(trial.slip_increment);
    dissipation += 0.5 * point.JxW *
                   (frame * point.accepted_traction + trial.tangential_traction)
                     .dot(trial.slip_increment);
    const double viscous_part =
      0.5 * point.JxW *
      (frame * point.accepted_viscous_traction + trial.viscous_traction)
        .dot(trial.slip_increment);
    viscous += viscous_part;
    // the viscous traction is anything between its two ends
    friction += viscous_part;
    friction_bound += viscous_part;
    add_friction(point, law, mode);
  }



  // The law is integrated over the distance that the point slides, from its
  // accepted state, with the pressure between its two ends.
  void
  InterfaceWork::add_friction(const SlavePoint       &point,
                              const FrictionLaw      &law,
                              const ContactPointMode &mode)
  {
    const ContactPointResult &trial = point.trial;
    const bool                opens = trial.state.status == PointStatus::open;
    if (opens)
      friction_bound += point.JxW * point.accepted_energy;
    if (opens || mode.frictionless)
      return;
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
