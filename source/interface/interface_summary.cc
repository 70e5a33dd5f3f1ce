#include <debond/interface/interface_summary.h>

#include <algorithm>

namespace Debond
{
  namespace
  {
    void
    add_steepest_softening(const SlavePoint       &point,
                           const ContactPointLaw  &law,
                           const ContactPointMode &mode,
                           InterfaceSummary       &summary)
    {
      const double slope = law.friction->steepest_fall(
        friction_state(point.accepted, point.phi_0, mode.duration),
        point.trial.state.slip - point.accepted.slip);
      const double softening =
        slope * point.trial.pressure /
        (law.tangential_penalty + viscous_stiffness(law, mode));
      if (softening > summary.steepest_softening)
        {
          summary.steepest_softening = softening;
          summary.softening_pressure = point.trial.pressure;
          summary.softening_slope    = slope;
        }
    }
  } // namespace



  InterfaceSummary
  summarise(const std::vector<SlavePoint> &points,
            const ContactPointLaw         &law,
            const ContactPointMode        &mode)
  {
    InterfaceSummary summary;
    double           area = 0.;
    for (const SlavePoint &point : points)
      {
        const ContactPointResult &trial = point.trial;
        summary.normal_force += point.JxW * trial.pressure;
        if (point.faces_implant)
          {
            area += point.JxW;
            summary.phi_mean +=
              point.JxW * point.friction(*law.friction, trial.state).phi;
            switch (trial.state.status)
              {
                case PointStatus::open:
                  summary.share_open += point.JxW;
                  break;
                case PointStatus::stick:
                  summary.share_stick += point.JxW;
                  break;
                case PointStatus::slip:
                  summary.share_slip += point.JxW;
                  break;
              }
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
        if (!law.explicit_friction && !mode.frictionless)
          add_steepest_softening(point, law, mode, summary);
        summary.max_penetration =
          std::max(summary.max_penetration, -trial.normal_gap);
      }
    for (double *share : {&summary.phi_mean,
                          &summary.share_stick,
                          &summary.share_slip,
                          &summary.share_open})
      *share /= area;
    return summary;
  }
} // namespace Debond
