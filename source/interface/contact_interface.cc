#include <debond/bulk/body_mesh.h>
#include <debond/geometry/closest_point.h>
#include <debond/interface/contact_interface.h>
#include <debond/interface/contact_tangent.h>

#include <algorithm>
#include <sstream>

namespace Debond
{
  ContactInterface::ContactInterface(const InterfaceParameters &parameters,
                                     const BodyMesh            &bone,
                                     const BodyMesh            &implant)
    : parameters(parameters)
    , law(parameters.law())
    , slave(parameters.slave)
    , mesh{{&bone, &implant}}
  {
    const auto quadrature =
      surface_quadrature(mesh[slave]->surface(), parameters.quadrature_points);
    points.reserve(quadrature.size());
    for (const auto &quadrature_point : quadrature)
      {
        SlavePoint point;
        point.element           = quadrature_point.element;
        point.xi                = quadrature_point.xi;
        point.X                 = quadrature_point.X;
        point.basis             = quadrature_point.basis;
        point.JxW               = quadrature_point.JxW;
        point.accepted.internal = parameters.friction->initial_variables();
        points.push_back(point);
      }
    for (const Side side : both_sides)
      forces[side].setZero(3, mesh[side]->surface().n_control_points());
    for (const auto &quadrature_point :
         surface_quadrature(implant.surface(), parameters.quadrature_points))
      area_of_implant += quadrature_point.JxW;
  }



  // phi_0 belongs to the implant: with the bone as slave a point takes that of
  // the implant point it faces at the start.
  void
  ContactInterface::assign_bonding()
  {
    pattern =
      std::make_unique<BondingPattern>(parameters.bonding,
                                       mesh[Side::implant]->parameters(),
                                       mesh[Side::implant]->surface(),
                                       parameters.quadrature_points);
    for (unsigned int q = 0; q < points.size(); ++q)
      if (slave == Side::implant)
        points[q].phi_0 = pattern->at(q);
      else
        {
          // the master is the implant
          points[q].faces_implant = points[q].accepted.has_partner;
          points[q].phi_0 =
            points[q].faces_implant ? pattern->at(points[q].accepted.xi) : 0.;
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



  void
  ContactInterface::project_accepted(
    SlavePoint                   &point,
    const MasterSurface          &master,
    const InterfaceConfiguration &configuration,
    const bool                    use_guess)
  {
    const Projection projection =
      project(master,
              interpolate(point.basis, configuration.side[slave].positions),
              use_guess ? &point.accepted.xi : nullptr);
    point.accepted.xi          = projection.xi;
    point.accepted.has_partner = projection.faces;
    point.clearance            = projection.clearance;
    // close to the singular corner of a disk, where there is no clearance, the
    // search may end early: no partner is to be found there anyway
    unprojected += !projection.converged && projection.clearance > 0.;
  }



  // Every point of a surface is a convex combination of control points.
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



  void
  ContactInterface::initialise(const InterfaceConfiguration &configuration)
  {
    for (const Side side : both_sides)
      accepted_positions[side] = configuration.side[side].positions;
    unprojected = 0;
    for (SlavePoint &point : points)
      project_accepted(point, master(configuration), configuration, false);
    assign_bonding();
  }



  bool
  ContactInterface::evaluate(const InterfaceConfiguration &configuration,
                             const ContactPointMode       &mode)
  {
    const MasterSurface surface = master(configuration);
    const double        moved   = motion(configuration);
    mode_now                    = mode;
    forces =
      sum_in_chunks(points.size(),
                    configuration,
                    [&](const unsigned int q, NodalSums &sums) {
                      update(points[q], configuration, surface, moved, mode);
                      add_forces(points[q], sums);
                    });
    const auto failed =
      std::find_if(points.begin(), points.end(), [](const SlavePoint &point) {
        return point.trial.failed;
      });
    failed_point = failed == points.end() ? -1 : failed - points.begin();
    return failed_point < 0;
  }



  void
  ContactInterface::update(SlavePoint                   &point,
                           const InterfaceConfiguration &configuration,
                           const MasterSurface          &surface,
                           const double                  moved,
                           const ContactPointMode       &mode) const
  {
    if (point.accepted.has_partner || point.clearance <= moved)
      {
        ContactPointMode mode_here = mode;
        if (parameters.slip_along_previous_gap)
          mode_here.slip_direction =
            configuration.side[master_side()].frame * point.accepted_traction;
        update_contact_point(law,
                             point.accepted,
                             point.phi_0,
                             interpolate(point.basis,
                                         configuration.side[slave].positions),
                             surface,
                             mode_here,
                             point.trial);
        return;
      }
    leave_open(law, point.accepted,
               point.trial); // still beyond the edge
  }



  void
  ContactInterface::add_forces(const SlavePoint &point, NodalSums &sums) const
  {
    if (point.trial.state.status == PointStatus::open)
      return;
    const Eigen::Vector3d f = point.JxW * point.trial.traction;
    spread(point.basis, f, sums[slave]);
    spread(point.trial.basis, -f, sums[master_side()]);
  }



  void
  ContactInterface::add_tangent(const InterfaceConfiguration &configuration,
                                Eigen::MatrixXd              &matrix) const
  {
    add_contact_tangent(points, slave, configuration, matrix);
  }



  void
  ContactInterface::apply_tangent(const InterfaceConfiguration &configuration,
                                  const Eigen::VectorXd        &direction,
                                  Eigen::VectorXd              &result) const
  {
    apply_contact_tangent(points, slave, configuration, direction, result);
  }



  FrictionCoefficient
  ContactInterface::friction(const SlavePoint &point) const
  {
    return point.friction(*parameters.friction, point.trial.state);
  }



  void
  ContactInterface::commit(const InterfaceConfiguration &configuration)
  {
    const MasterSurface    surface = master(configuration);
    const Eigen::Matrix3d &Q       = configuration.side[master_side()].frame;
    const double           moved   = motion(configuration);
    for (const Side side : both_sides)
      accepted_positions[side] = configuration.side[side].positions;
    unprojected = 0;
    spent.begin_step();
    for (SlavePoint &point : points)
      {
        if (!point.accepted.has_partner && point.clearance > moved)
          {
            point.clearance -= moved;
            continue;
          }
        spent.add(point, *parameters.friction, mode_now, Q);
        const ContactPointResult &trial = point.trial;
        point.accepted                  = trial.state;
        point.accepted_traction = Q.transpose() * trial.tangential_traction;
        point.accepted_viscous_traction =
          Q.transpose() * trial.viscous_traction;
        point.accepted_pressure = trial.pressure;
        point.accepted_energy   = trial.energy;
        if (point.accepted.status == PointStatus::open)
          project_accepted(point, surface, configuration, true);
      }
  }



  std::vector<PointStatus>
  ContactInterface::statuses() const
  {
    std::vector<PointStatus> result;
    result.reserve(points.size());
    for (const SlavePoint &point : points)
      result.push_back(point.trial.state.status);
    return result;
  }



  bool
  ContactInterface::has_open_points() const
  {
    return std::any_of(points.begin(),
                       points.end(),
                       [](const SlavePoint &point) {
                         return point.trial.state.status == PointStatus::open;
                       });
  }



  MeanSlip
  ContactInterface::mean_slip(const InterfaceConfiguration &configuration) const
  {
    return Debond::mean_slip(points,
                             slave,
                             configuration,
                             mode_now.frictionless);
  }



  InterfaceSummary
  ContactInterface::summarise() const
  {
    return Debond::summarise(points, law, mode_now);
  }



  std::string
  ContactInterface::describe_failure() const
  {
    if (failed_point < 0)
      return "";
    const SlavePoint  &point = points[failed_point];
    std::ostringstream text;
    text << "no solution of the friction law at the " << name_of(slave)
         << "'s quadrature point at parameters (" << point.xi[0] << ", "
         << point.xi[1] << "), g_s = " << point.accepted.slip << " mm";
    return text.str();
  }
} // namespace Debond
