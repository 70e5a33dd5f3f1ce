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
  InterfaceWork::add(const SlavePoint      &point,
                     const ContactPointLaw &law,
                     const bool             frictionless,
                     const Eigen::Matrix3d &frame)
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
    if (!frictionless)
      adhesive += point.JxW * 0.5 * (point.accepted_pressure + trial.pressure) *
                  adhesive_strength(law.friction,
                                    trial.state.bond_left(point.phi_0),
                                    point.accepted.slip,
                                    trial.state.slip);
    add_friction(point, law, frictionless);
  }



  void
  InterfaceWork::add_friction(const SlavePoint      &point,
                              const ContactPointLaw &law,
                              const bool             frictionless)
  {
    const ContactPointResult &trial = point.trial;
    const double              p     = point.accepted_pressure,
                 t                  = point.accepted_traction.norm();
    if (trial.state.status == PointStatus::open)
      {
        friction_bound +=
          0.5 * point.JxW *
          (p * p / law.normal_penalty + t * t / law.tangential_penalty);
        return;
      }
    if (frictionless)
      return;
    const double per_pressure =
      point.JxW * friction_strength(law.friction,
                                    trial.state.bond_left(point.phi_0),
                                    point.accepted.slip,
                                    trial.state.slip);
    friction += 0.5 * (p + trial.pressure) * per_pressure;
    friction_bound += 0.5 * std::abs(p - trial.pressure) * per_pressure;
  }
} // namespace Debond
