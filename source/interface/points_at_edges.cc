#include <debond/bulk/bulk_space.h>
#include <debond/interface/contact_interface.h>
#include <debond/interface/slip_problem.h>

#include <cmath>
#include <utility>

// Points that come over the edge of the master, and leave it there. Both happen
// at once, while the area that a point stands for crosses the edge little by
// little: so where it begins to interact must not depend on the step, a curve
// must not follow single points, and what springs back must not keep a step
// from having a solution.
namespace Debond
{
  // A point beyond the edge of the master that the step takes over it begins to
  // interact at the place of the edge that was closest to it before the step,
  // and what it moves along the surface from there on counts as slip. Starting
  // where the step ends it would have no tangential gap, and friction would
  // depend on the size of the steps.
  //
  // If it comes square to the edge this is where it crosses it, else within the
  // length of the step. The place where it crosses would depend on the trial
  // state, by derivatives of the surface that the tangent does not know.
  ContactPointState
  ContactInterface::entry(const SlavePoint             &point,
                          const InterfaceConfiguration &configuration) const
  {
    ContactPointState start   = point.accepted;
    MasterSurface     surface = master(configuration);
    const Projection  at      = facing(point, configuration, &start.xi);
    start.has_partner         = at.faces;
    if (start.has_partner)
      {
        start.xi          = at.xi;
        surface.positions = &accepted_positions[master_side()];
        start.xi          = project(surface,
                           interpolate(point.basis, accepted_positions[slave]),
                           &start.xi)
                     .xi;
      }
    return start;
  }



  // Where a point lets go of the edge the bodies may spring back, so that it is
  // on the face again: there is no equilibrium, with it or without. It stands
  // for an area that leaves little by little, and as long as it comes back by a
  // hundredth of that area's width it counts as gone.
  bool
  ContactInterface::is_back_at_edge(const SlavePoint &point) const
  {
    const ContactPointResult &trial = point.trial;
    const double missing = point.path_to_edge - trial.slip_increment.norm();
    return point.path_to_edge > 0. && !trial.failed &&
           trial.state.status != PointStatus::open &&
           std::abs(missing) < 0.01 * std::sqrt(point.JxW);
  }



  // Asked before each attempt at a step: one that keeps them away is made only
  // after others that ended with points on the face that had left it.
  bool
  ContactInterface::has_come_back()
  {
    bool any = false;
    for (SlavePoint &point : points)
      any = (std::exchange(point.path_to_edge, 0.) > 0. &&
             point.trial.state.status != PointStatus::open) ||
            any;
    return any;
  }



  // What they carried in the accepted state, in the directions that tangent
  // and normal have taken with the master since.
  ControlNet
  ContactInterface::let_go(const InterfaceConfiguration &configuration) const
  {
    NodalSums              sums   = zero_sums(configuration);
    const MasterSurface    at_end = master(configuration);
    const Eigen::Matrix3d &Q      = configuration.side[master_side()].frame;
    for (const SlavePoint &point : points)
      if (point.trial.path_to_edge > 0. &&
          point.trial.state.status == PointStatus::open &&
          point.accepted.status != PointStatus::open)
        {
          SurfaceGeometry geometry;
          contract(point.trial.old_basis, *at_end.positions, geometry);
          const double pressure = law.joint
                                    ->respond(point.begin(*law.joint, mode_now),
                                              point.accepted.normal_gap,
                                              0.)
                                    .pressure;
          add_force(point,
                    Q * point.accepted_traction -
                      pressure * MasterNormal(geometry, at_end.outward_sign).n,
                    point.trial.old_basis,
                    sums);
        }
    return sums[Side::implant];
  }
} // namespace Debond
