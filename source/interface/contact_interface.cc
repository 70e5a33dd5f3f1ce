#include <debond/bulk/body_mesh.h>
#include <debond/interface/contact_interface.h>

#include <algorithm>
#include <sstream>

// The points of the interface in a step. Newton's method calls evaluate() with
// the surfaces where it has put them: every slave point is updated by itself,
// from its accepted history (contact_point.cc), and its traction is spread over
// the control points of both surfaces. Whatever Newton's method tries, the
// accepted history stays as it is; commit() replaces it once the step is good.

namespace Debond
{
  // The contact integral of Eq. (36) is a sum over quadrature points of the
  // slave. The paper integrates over the current area, we over the reference
  // area, which differs by the surface strain, 1e-4: tractions are nominal.
  ContactInterface::ContactInterface(const InterfaceParameters &parameters,
                                     const BodyMesh            &bone,
                                     const BodyMesh            &implant)
    : parameters(parameters)
    , law(parameters.law())
    , slave(parameters.slave)
    , mesh{{&bone, &implant}}
  {
    const unsigned int n = parameters.quadrature_points;
    for (const auto &place : surface_quadrature(mesh[slave]->surface(), n))
      {
        SlavePoint point;
        static_cast<SurfaceQuadraturePoint &>(point) = place;
        point.accepted.internal = law.friction->initial_variables();
        points.push_back(point);
      }
    for (const Side side : both_sides)
      forces[side].setZero(3, mesh[side]->surface().n_control_points());
    for (const auto &place : surface_quadrature(implant.surface(), n))
      area_of_implant += place.JxW;
  }



  // phi_0 of Eq. (13) belongs to the implant: with the bone as slave a point
  // takes that of the implant point it faces at the start.
  void
  ContactInterface::assign_bonding()
  {
    pattern =
      std::make_unique<BondingPattern>(parameters.bonding,
                                       mesh[Side::implant]->parameters(),
                                       mesh[Side::implant]->surface(),
                                       parameters.quadrature_points);
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        SlavePoint &point = points[q];
        point.faces_implant =
          slave == Side::implant || point.accepted.has_partner;
        if (point.faces_implant)
          point.phi_0 = slave == Side::implant ? pattern->at(q) :
                                                 pattern->at(point.accepted.xi);
      }
  }



  double
  ContactInterface::mean_seen_bonding() const
  {
    double sum = 0., area = 0.;
    for (const SlavePoint &point : points)
      if (point.faces_implant)
        {
          sum += point.phi_0 * point.JxW;
          area += point.JxW;
        }
    return area > 0. ? sum / area : 0.;
  }



  MasterSurface
  ContactInterface::master(const InterfaceConfiguration &configuration) const
  {
    return {&mesh[master_side()]->surface(),
            &configuration.side[master_side()].positions,
            mesh[master_side()]->outward_sign()};
  }



  // The interacting point xi_hat^n of a point that is open: its closest point
  // on the master, so that a point that closes during the next step starts from
  // there, and what it moves along the surface in that step counts as slip.
  void
  ContactInterface::project_accepted(
    SlavePoint                   &point,
    const InterfaceConfiguration &configuration,
    const bool                    use_guess)
  {
    const Projection projection =
      project(master(configuration),
              interpolate(point.basis, configuration.side[slave].positions),
              use_guess ? &point.accepted.xi : nullptr);
    point.accepted.xi          = projection.xi;
    point.accepted.has_partner = projection.faces;
    point.clearance            = projection.clearance;
    // close to the singular corner of a disk, where there is no clearance, the
    // search may end early: no partner is to be found there anyway
    unprojected += !projection.converged && projection.clearance > 0.;
  }



  // Every point of a surface is a convex combination of control points, so none
  // moves further than the control point that moves most.
  double
  ContactInterface::motion(const InterfaceConfiguration &configuration) const
  {
    double sum = 0.;
    for (const Side side : both_sides)
      sum += (configuration.side[side].positions - accepted_positions[side])
               .colwise()
               .norm()
               .maxCoeff();
    return sum;
  }



  // "At initial contact the interacting point is the closest projection point"
  // (paper, after Eq. 28).
  void
  ContactInterface::initialise(const InterfaceConfiguration &configuration)
  {
    for (const Side side : both_sides)
      accepted_positions[side] = configuration.side[side].positions;
    unprojected = 0;
    for (SlavePoint &point : points)
      project_accepted(point, configuration, false);
    assign_bonding();
  }



  // Points do not know of each other, so they are updated in parallel; the sums
  // are formed in the same order whatever the number of threads.
  bool
  ContactInterface::evaluate(const InterfaceConfiguration &configuration,
                             const ContactPointMode       &mode)
  {
    // the master where it is now, and how far things have moved at most since
    // the accepted state
    const MasterSurface surface = master(configuration);
    const double        moved   = motion(configuration);
    const auto         &sides   = configuration.side;
    mode_now                    = mode;
    const auto update           = [&](const unsigned int q, NodalSums &sums) {
      SlavePoint &point = points[q];
      // most points beyond the edge stay there: they need no projection until
      // the surfaces may have come close enough
      if (!point.accepted.has_partner && point.clearance > moved)
        {
          leave_open(law, point.accepted, point.trial);
          return;
        }
      // the previous gap of Eq. (31) as printed has the direction of the
      // previous traction, which is kept in the frame of the master
      ContactPointMode mode_here = mode;
      if (parameters.slip_along_previous_gap)
        mode_here.slip_direction =
          sides[master_side()].frame * point.accepted_traction;
      const Eigen::Vector3d x =
        interpolate(point.basis, sides[slave].positions);
      update_contact_point(
        law, point.accepted, point.phi_0, x, surface, mode_here, point.trial);
      if (point.trial.state.status == PointStatus::open)
        return;
      // f_A = int N_A t dA on the slave, and the opposite on the master at
      // xi_hat, Eq. (36)
      const Eigen::Vector3d f = point.JxW * point.trial.traction;
      spread(point.basis, f, sums[slave]);
      spread(point.trial.basis, -f, sums[master_side()]);
    };
    forces = sum_in_chunks(points.size(), configuration, update);
    const auto found =
      std::find_if(points.begin(), points.end(), [](const SlavePoint &point) {
        return point.trial.failed;
      });
    failed = found == points.end() ? nullptr : &*found;
    return failed == nullptr;
  }



  // The trial state becomes the accepted one. Tractions are kept in the frame
  // of the master, so that a rotation of the whole changes nothing; the works
  // need both ends of the step, and so come first.
  void
  ContactInterface::commit(const InterfaceConfiguration &configuration)
  {
    const Eigen::Matrix3d &Q     = configuration.side[master_side()].frame;
    const double           moved = motion(configuration);
    for (const Side side : both_sides)
      accepted_positions[side] = configuration.side[side].positions;
    unprojected            = 0;
    works.step_dissipation = 0.;
    for (SlavePoint &point : points)
      {
        // beyond the edge, and still too far to reach it
        if (!point.accepted.has_partner && point.clearance > moved)
          {
            point.clearance -= moved;
            continue;
          }
        works.add(point, *law.friction, mode_now, Q);
        const ContactPointResult &trial = point.trial;
        point.accepted                  = trial.state;
        point.accepted_traction = Q.transpose() * trial.tangential_traction;
        point.accepted_viscous_traction =
          Q.transpose() * trial.viscous_traction;
        point.accepted_pressure = trial.pressure;
        point.accepted_energy   = trial.energy;
        // what is open forgets its interacting point, or it would be pulled
        // back to it when it closes again somewhere else
        if (point.accepted.status == PointStatus::open)
          project_accepted(point, configuration, true);
      }
  }



  std::vector<PointStatus>
  ContactInterface::statuses() const
  {
    std::vector<PointStatus> result;
    for (const SlavePoint &point : points)
      result.push_back(point.trial.state.status);
    return result;
  }



  bool
  ContactInterface::has_open_points() const
  {
    const auto all = statuses();
    return std::find(all.begin(), all.end(), PointStatus::open) != all.end();
  }



  // What a step is judged by. Areas count where the implant is faced, forces
  // and energies everywhere. The local problem of a sliding point has one
  // solution while |dmu/dg_s| p < eps_t + eta/dt: the slope is asked for where
  // it will be steepest, so that a step that ends beyond the steepest place is
  // not missed.
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
          friction_state(point.accepted, point.phi_0, mode_now.duration),
          trial.state.slip - point.accepted.slip);
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



  std::string
  ContactInterface::describe_failure() const
  {
    if (failed == nullptr)
      return "";
    std::ostringstream text;
    text << (failed->trial.negative_friction ?
               "the friction law has a negative coefficient" :
               "no solution of the friction law")
         << " at the " << name_of(slave)
         << "'s quadrature point at parameters (" << failed->xi[0] << ", "
         << failed->xi[1] << "), g_s = " << failed->accepted.slip << " mm";
    return text.str();
  }
} // namespace Debond
