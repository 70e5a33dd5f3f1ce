#include <debond/interface/contact_interface.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  InterfaceSummary
  ContactInterface::summarise() const
  {
    InterfaceSummary summary;
    double           area = 0.;
    // open, stick, slip: see PointStatus
    const std::array<double *, 3> share{
      {&summary.share_open, &summary.share_stick, &summary.share_slip}};
    const double resistance =
      law.tangential_penalty + viscous_stiffness(law, mode_now);
    for (const SlavePoint &point : points)
      {
        const ContactPointResult &trial = point.trial;
        summary.normal_force += point.JxW * trial.pressure;
        if (point.faces_implant)
          {
            area += point.JxW;
            summary.phi_mean += point.JxW * friction(point).phi;
            *share[static_cast<unsigned int>(trial.state.status)] += point.JxW;
          }
        if (trial.state.status == PointStatus::open)
          {
            // whether it was bonded: opening itself may have broken it
            if (law.friction->has_bond() &&
                point.accepted.status != PointStatus::open &&
                point.friction(*law.friction, point.accepted).phi > 0.)
              ++summary.bonded_opened;
            continue;
          }
        ++summary.n_closed;
        summary.energy += point.JxW * trial.energy;
        summary.max_softening =
          std::max(summary.max_softening, trial.softening);
        summary.max_penetration =
          std::max(summary.max_penetration, -trial.normal_gap);
        if (law.explicit_friction || mode_now.frictionless)
          continue;
        const double slope = law.friction->steepest_fall(
          friction_state(point.accepted, point.phi_0, mode_now.duration));
        const double softening = slope * trial.pressure / resistance;
        if (softening > summary.steepest_softening)
          {
            summary.steepest_softening = softening;
            summary.softening_pressure = trial.pressure;
            summary.softening_slope    = slope;
          }
      }
    summary.phi_mean /= area;
    for (double *part : share)
      *part /= area;
    return summary;
  }



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
    friction_bound += 0.5 * std::abs(p - trial.pressure) * per_pressure;
  }
} // namespace Debond
