#include <debond/bulk/bulk_space.h>
#include <debond/bulk/chuck.h>
#include <debond/interface/contact_interface.h>
#include <debond/interface/slip_problem.h>

#include <Eigen/Geometry>

#include <optional>

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
  //
  // One surface carries the points, the other is looked at by them: the
  // classical full-pass algorithm of the paper, Appendix A.2. That is not
  // symmetric. With the implant as slave the points cover its face exactly;
  // with the bone as slave the rim of the implant cuts through elements of the
  // bone, and part of the points face nothing.
  ContactInterface::ContactInterface(const InterfaceParameters &parameters,
                                     const BulkSpace           &bone,
                                     const BulkSpace           &implant)
    : parameters(parameters)
    , law(parameters.law())
    , slave(parameters.slave)
    , touch_tolerance(1e-12 * implant.parameters().characteristic_radius())
    , mesh{{&bone, &implant}}
    , master_is_level(mesh[other(slave)]->surface().is_level())
    , master_is_flat(mesh[other(slave)]->surface().is_flat())
    , along(
        parameters.points_per_element(bone.parameters(), implant.parameters()))
  {
    // A point carries its weight JxW [mm^2] of the reference area, and a
    // history: to begin with no partner, g_s = 0, and the internal variables
    // that the law wants, such as the initial state of a law that ages.
    const auto places = surface_quadrature(mesh[slave]->surface(), along);
    points.resize(places.size());
    for (unsigned int q = 0; q < points.size(); ++q)
      {
        static_cast<SurfaceQuadraturePoint &>(points[q]) = places[q];
        points[q].accepted.internal = law.joint->friction->initial_variables;
      }
    if (law.joint->cohesion)
      shares.resize(points.size());
    for (const Side side : both_sides)
      // no forces before the first evaluate()
      forces[side].setZero(3, mesh[side]->surface().n_control_points());
    // The area of the implant's face [mm^2], whichever side is the slave: what
    // the mean pressure refers to.
    for (const auto &place : surface_quadrature(implant.surface(), along))
      area_of_implant += place.JxW;
    find_facets();
  }



  // phi_0 of Eq. (13) belongs to the implant. A point of the bone that faces no
  // implant at the start has grown together with nothing: its phi_0 stays 0. It
  // can still carry pressure and friction once the implant slides over it, with
  // the coefficient of what is debonded.
  void
  ContactInterface::assign_bonding()
  {
    // The pattern is a field over the implant's face, evaluated here once for
    // all: osseointegration is over before the test begins (footnote 2 of the
    // paper).
    pattern =
      std::make_unique<BondingPattern>(parameters.bonding_of_law(),
                                       mesh[Side::implant]->parameters(),
                                       mesh[Side::implant]->surface(),
                                       along);
    for (SlavePoint &point : points)
      point.faces_implant =
        slave == Side::implant || point.accepted.has_partner;
    // the points of the implant are those of the pattern
    for (unsigned int q = 0; slave == Side::implant && q < points.size(); ++q)
      points[q].phi_0 = pattern->at(q);
    follow_pattern();
  }



  // The implant takes its pattern along. With the bone as slave its points look
  // phi_0 up where they interact now, and what is held at a place where it is
  // held.
  void
  ContactInterface::follow_pattern()
  {
    for (unsigned int q = 0; slave == Side::bone && q < points.size(); ++q)
      if (points[q].faces_implant)
        points[q].phi_0 =
          pattern->at(shares.empty() ? points[q].accepted.xi : shares[q].xi);
  }



  const BodyParameters &
  ContactInterface::implant() const
  {
    return mesh[Side::implant]->parameters();
  }



  // The master as the points need it: its basis, which never changes, over the
  // control points where Newton's method has put them, and the sign that turns
  // a_1 x a_2, Eq. (24), to the side of the slave.
  MasterSurface
  ContactInterface::master(const InterfaceConfiguration &configuration) const
  {
    return {&mesh[master_side()]->surface(),
            &configuration.side[master_side()].positions,
            mesh[master_side()]->outward_sign(),
            master_is_level,
            master_is_flat};
  }



  // Where a point lies over the master, on a part of it that faces the point.
  Projection
  ContactInterface::facing(const SlavePoint             &point,
                           const InterfaceConfiguration &configuration,
                           const Eigen::Vector2d        *guess) const
  {
    const ControlNet     &positions = configuration.side[slave].positions;
    const Eigen::Vector3d normal    = normal_of_slave(point, positions);
    return project(master(configuration),
                   interpolate(point.basis, positions),
                   guess,
                   &normal);
  }



  // The interacting point xi_hat^n of a point that is open: its closest point
  // on the master, so that a point that closes during the next step starts from
  // there, and what it moves along the surface in that step counts as slip.
  Projection
  ContactInterface::project_accepted(
    SlavePoint                   &point,
    const InterfaceConfiguration &configuration,
    const bool                    use_guess)
  {
    // The search starts from the last xi_hat where there is one, and goes over
    // the whole master else. A point beyond the edge has no partner;
    // it keeps its clearance instead, the distance [mm] that the surfaces may
    // move before it has to be asked again.
    const Projection projection =
      facing(point, configuration, use_guess ? &point.accepted.xi : nullptr);
    point.accepted.xi          = projection.xi;
    point.accepted.has_partner = projection.faces;
    point.clearance            = projection.clearance;
    // close to the singular corner of a disk, where there is no clearance, the
    // search may end early: no partner is to be found there anyway
    if (!projection.converged && projection.clearance > 0.)
      ++unprojected;
    return projection;
  }



  // Every point of a surface is a convex combination of control points, so none
  // moves further than the control point that moves most. Of a triangle, whose
  // functions may be negative, by 5/3 of that at most, in its middle.
  //
  // The sum over both sides bounds how much closer [mm] any point of one
  // surface can have come to any point of the other since the accepted state.
  // What is taken off at the start turns with points of the frame 1 mm apart.
  // It costs a pass over the control points, where projecting all points again
  // would cost an iteration for each.
  double
  ContactInterface::motion(const InterfaceConfiguration &configuration) const
  {
    double sum = 0.;
    for (const Side side : both_sides)
      sum += (mesh[side]->surface().has_triangles() ? 5. / 3. : 1.) *
             (configuration.side[side].positions - accepted_positions[side])
               .colwise()
               .norm()
               .maxCoeff();
    return (1. + 4. * at_start.largest_gap) * sum;
  }



  namespace
  {
    /** A step of the points to a configuration. */
    struct StepOfPoints
    {
      const ContactPointLaw        &law;
      const Side                    slave;
      const MasterSurface           master;
      const Place                   start; ///< the implant's, before the step
      const InterfaceConfiguration &configuration;
      const RigidMotion rigid{start, Place::of_implant(configuration)};

      /** That of the master at rest, as its frame has turned. */
      RigidMotion::Normal
      normal(const SurfaceBasis &basis) const
      {
        const Eigen::Matrix3d &Q       = configuration.side[other(slave)].frame;
        const NurbsSurface    &surface = *master.surface;
        if (master.is_level)
          return {master.outward_sign * Q.col(2), true};
        SurfaceGeometry geometry;
        contract(basis, surface.control_points(), geometry);
        return {Q * MasterNormal(geometry, master.outward_sign).n,
                master.is_flat};
      }

      /** Derivatives of turn_of_way() by the components of the chuck that are
       *  unknown. */
      Chuck::Vector6
      turn_by_chuck(const Eigen::Vector3d     &old_x,
                    const RigidMotion::Normal &n) const
      {
        Chuck::Vector6 result = Chuck::Vector6::Zero();
        if (configuration.chuck_unknowns.empty())
          return result;
        const auto by = rigid.gradient_of_turn(old_x, slave, n);
        for (const auto &[k, number] : configuration.chuck_unknowns)
          result[k] = is_rotation(k) ?
                        by.spin.dot(configuration.chuck->axis(k)) :
                        by.centre[k];
        return result;
      }

      /** From the state @p start at @p old_x, in space [mm]: finds what master
       *  and law make of the point (contact_point.cc). */
      void
      update(const SlavePoint        &point,
             const ContactPointState &start,
             const Eigen::Vector3d   &old_x,
             ContactPointMode         mode,
             ContactPointResult      &result) const
      {
        if (law.slip_direction == SlipDirection::integrated)
          {
            result.old_basis.move_to(*master.surface, start.xi);
            const RigidMotion::Normal n = normal(result.old_basis);
            mode.turn                   = rigid.turn_of_way(old_x, slave, n);
            result.turn_by_chuck        = turn_by_chuck(old_x, n);
          }
        const Eigen::Vector3d x =
          interpolate(point.basis, configuration.side[slave].positions);
        update_contact_point(law, start, point.phi_0, x, master, mode, result);
      }
    };
  } // namespace



  const CohesiveShare *
  ContactInterface::held_share(const SlavePoint &point) const
  {
    if (shares.empty())
      return nullptr;
    const CohesiveShare &share = shares[&point - points.data()];
    return share.holds ? &share : nullptr;
  }



  PointTraction
  ContactInterface::traction(const SlavePoint &point) const
  {
    PointTraction result{point.trial.pressure,
                         -point.trial.tangential_traction};
    if (const CohesiveShare *const share = held_share(point))
      {
        result.pressure += share->pressure;
        result.tangential -=
          share->traction - share->normal.dot(share->traction) * share->normal;
      }
    return result;
  }



  // f_A = int N_A t dA on the slave, and the opposite on the master at xi_hat,
  // Eq. (36). What one side gets the other one gives at the same parameters, so
  // that the forces of both sides add up to zero but for rounding. Their
  // moments do up to f times the gap between x and y(xi_hat), by which the
  // springs of the interface are stretched.
  void
  ContactInterface::add_force(const SlavePoint      &point,
                              const Eigen::Vector3d &traction,
                              const SurfaceBasis    &of_master,
                              NodalSums             &sums) const
  {
    const Eigen::Vector3d f = point.JxW * traction;
    spread(point.basis, f, sums[slave]);
    spread(of_master, -f, sums[master_side()]);
  }



  // What Newton's method asks for in each iteration: nodal forces, and the
  // derivatives at every point, for the surfaces as they are proposed. The
  // history of the points goes in and is not changed, so that an iteration owes
  // nothing to the one before and a rejected step leaves nothing behind. Where
  // points have to leave for good an iteration knows which have left before.
  //
  // Points do not know of each other, so they are updated in parallel. Sums are
  // formed in parts that do not depend on the number of threads, and added in
  // the order of the parts: results are the same to the last digit.
  bool
  ContactInterface::evaluate(const InterfaceConfiguration &configuration,
                             ContactPointMode              mode)
  {
    tangent_is_gathered  = false;
    mode.touch_tolerance = touch_tolerance;
    // the master where it is now, and how far things have moved at most since
    // the accepted state. The mode of this step is needed again when it is
    // judged and when it is committed.
    const double moved = motion(configuration);
    mode_now           = mode;
    const StepOfPoints step{
      law, slave, master(configuration), accepted_place, configuration};
    const auto update = [&](const unsigned int q, NodalSums &sums) {
      SlavePoint         &point   = points[q];
      ContactPointResult &result  = point.trial;
      ContactPointMode    of_rest = mode; // the share that rubs
      if (!shares.empty())
        {
          hold(q, configuration, mode, sums);
          of_rest.damage = shares[q].damage;
        }
      // Most points beyond the edge stay there: they need no projection until
      // the surfaces may have come close enough. With the bone as slave that is
      // most of its face in the paper's test.
      if (!point.accepted.has_partner && point.clearance > moved)
        {
          leave_open(law, point.accepted, result);
          return;
        }
      std::optional<ContactPointState> entered;
      if (!point.accepted.has_partner)
        entered = entry(point, configuration);
      step.update(point,
                  entered ? *entered : point.accepted,
                  interpolate(point.basis, accepted_positions[slave]),
                  of_rest,
                  result);
      if (result.path_to_edge > 0.)
        point.path_to_edge = result.path_to_edge;
      else if (mode.leaves_for_good && is_back_at_edge(point))
        {
          leave_open(law, point.accepted, result, result.normal_gap);
          result.path_to_edge = point.path_to_edge;
        }
      if (result.state.status == PointStatus::open)
        return;
      add_force(point, result.traction, result.basis, sums);
    };
    forces = sum_in_chunks(points.size(), zero_sums(configuration), update);
    for (unsigned int q = 0; q < shares.size(); ++q)
      points[q].trial.state.damage = shares[q].damage;
    // One point without a solution is enough to fail the iteration: a traction
    // that is guessed would converge to something. The first one in order is
    // remembered for the message, whichever thread has met it.
    const auto found =
      std::find_if(points.begin(), points.end(), [](const SlavePoint &point) {
        return point.trial.failed;
      });
    failed = found == points.end() ? nullptr : &*found;
    return failed == nullptr;
  }



  // The share of a point that is held at the place where it has bonded pulls
  // there, beside the share that rubs.
  void
  ContactInterface::hold(const unsigned int            q,
                         const InterfaceConfiguration &configuration,
                         const ContactPointMode       &mode,
                         NodalSums                    &sums)
  {
    const SlavePoint &point = points[q];
    CohesiveShare    &share = shares[q];
    share.update(*law.joint,
                 point.begin(*law.joint, mode),
                 interpolate(point.basis, configuration.side[slave].positions),
                 master(configuration));
    if (!share.holds)
      return;
    add_force(point, share.traction, share.basis, sums);
  }



  // A step takes the way of each point over the master to be straight, or an
  // arc where the bodies turn, and its pressure to change evenly. Two halves by
  // way of where the point is in the middle know better. The difference is the
  // error of the step but for a factor of 4/3, that of a method of second
  // order.
  NodalSums
  ContactInterface::difference_of_halves(
    const InterfaceConfiguration &middle,
    const InterfaceConfiguration &configuration) const
  {
    InterfaceConfiguration first = middle, last = configuration;
    first.chuck_unknowns.clear(); // no derivatives
    last.chuck_unknowns.clear();
    const StepOfPoints first_step{
      law, slave, master(first), accepted_place, first},
      last_step{law, slave, master(last), Place::of_implant(first), last};
    ContactPointMode mode = mode_now;
    mode.duration *= 0.5;
    const auto update = [&](const unsigned int q, NodalSums &sums) {
      const SlavePoint        &point = points[q];
      const ContactPointState &begin = point.accepted, &end = point.trial.state;
      // what has left over an edge is gone, whichever half it leaves in
      if (point.trial.path_to_edge > 0. || !begin.has_partner ||
          !end.has_partner || (!slides(begin.status) && !slides(end.status)))
        return;
      ContactPointResult half, whole;
      first_step.update(point,
                        begin,
                        interpolate(point.basis, accepted_positions[slave]),
                        mode,
                        half);
      last_step.update(point,
                       half.state,
                       interpolate(point.basis, first.side[slave].positions),
                       mode,
                       whole);
      // A string forgets errors as it is towed, by exp(-slip / length) in a
      // step. Until then those of earlier steps are in it, too, taken to be
      // those of this one.
      const double length = point.trial.tangential_traction.norm() /
                            law.tangential_penalty,
                   left = length > 0. ?
                            std::exp((begin.slip - end.slip) / length) :
                            0.;
      add_force(point,
                (whole.traction - point.trial.traction) /
                  (1. - std::min(left, 0.9)),
                point.trial.basis,
                sums);
    };
    return sum_in_chunks(points.size(), zero_sums(configuration), update);
  }



  // While the chuck follows the scene only its unknown components change in
  // Newton's method, and others need no derivative. Rates of change do.
  void
  ContactInterface::differentiate_turns(
    const InterfaceConfiguration &configuration)
  {
    tangent_is_gathered = false;
    if (law.slip_direction != SlipDirection::integrated)
      return;
    const StepOfPoints step{
      law, slave, master(configuration), accepted_place, configuration};
    for (SlavePoint &point : points)
      if (slides(point.trial.state.status))
        {
          // one that came over the edge in this step began it there
          const SurfaceBasis &start = point.accepted.has_partner ?
                                        point.trial.old_basis :
                                        point.trial.basis;
          point.trial.turn_by_chuck =
            step.turn_by_chuck(interpolate(point.basis,
                                           accepted_positions[slave]),
                               step.normal(start));
        }
  }



  // The tractions on both faces are not along the gap where stiffnesses differ:
  // the offset m = g - t / eps_t is along the normal [mm]. Where that turns,
  // this couple works, which no potential has. It is dissipated with the slip:
  // doc/explanation/contact.md, Energies. On plane faces, which only tilt, it
  // is some 1e-6 of the work, and left out.
  double
  ContactInterface::couple_work(const SlavePoint      &point,
                                const NodalSums       &before,
                                const Eigen::Matrix3d &old_Q) const
  {
    const ContactPointResult &trial = point.trial;
    if (master_is_flat || trial.state.status == PointStatus::open ||
        point.accepted.status == PointStatus::open)
      return 0.;
    const double h = point.accepted.normal_gap, eps_t = law.tangential_penalty;
    const auto   gap = [&](const NodalSums &at, const SurfaceBasis &y) {
      return Eigen::Vector3d(interpolate(point.basis, at[slave]) -
                             interpolate(y, at[master_side()]));
    };
    const Eigen::Vector3d old_t = old_Q * point.accepted_traction,
                          m     = gap(accepted_positions, trial.basis) -
                              trial.traction / eps_t,
                          along_n =
                            gap(before, trial.old_basis) - old_t / eps_t;
    const PointStart start = point.begin(*law.joint, mode_now);
    const double     p     = law.joint->respond(start, h, 0.).pressure;
    double           work  = 0.;
    if (h != 0. && m.norm() > mode_now.touch_tolerance)
      work = m.dot(old_t) -
             (1. + p / (eps_t * h)) * along_n.dot(trial.tangential_traction);
    if (const CohesiveShare *const share = held_share(point))
      {
        const Eigen::Vector3d old_gap = old_Q * share->gap;
        work +=
          share->stiffness_by_damage * (point.accepted.damage - 1.) *
            old_gap.dot(gap(accepted_positions, share->basis) - share->bears) -
          share->traction.dot(gap(before, share->basis) - old_gap);
      }
    return 0.5 * work;
  }



  // The trial state becomes the accepted one. Tractions are kept in the frame
  // of the master, so that a rotation of the whole changes nothing; the works
  // need both ends of the step, and so come first.
  //
  // From here on there is no return: g_s never falls, and what a bond has lost
  // stays lost.
  void
  ContactInterface::commit(const InterfaceConfiguration &configuration)
  {
    tangent_is_gathered = false;
    // how far things have moved must be known before the positions are replaced
    const Eigen::Matrix3d &Q = configuration.side[master_side()].frame;
    const Eigen::Matrix3d  old_Q =
      slave == Side::bone ? accepted_place.frame : Q;
    const double      moved  = motion(configuration);
    const NodalSums   before = accepted_positions;
    const RigidMotion chuck(accepted_place, Place::of_implant(configuration));
    for (const Side side : both_sides)
      accepted_positions[side] = configuration.side[side].positions;
    accepted_place         = Place::of_implant(configuration);
    unprojected            = 0;
    works.step_dissipation = 0.;
    for (unsigned int q = 0; q < shares.size(); ++q)
      works.add(shares[q], points[q], *law.joint, mode_now, Q);
    for (SlavePoint &point : points)
      {
        point.path_to_edge = 0.;
        // beyond the edge, and still too far to reach it
        if (!point.accepted.has_partner && point.clearance > moved)
          {
            // The bound for the next steps is less by what was used of it. When
            // nothing is left the point is projected anew, below.
            point.clearance -= moved;
            continue;
          }
        const ContactPointResult &trial = point.trial;
        if (trial.state.status != PointStatus::open)
          works.add(point, *law.joint, mode_now, Q);
        else if (point.accepted.status != PointStatus::open)
          works.add_opening(
            point,
            law,
            mode_now,
            Q,
            opening_motion(point, configuration, chuck, before[slave]));
        const double couple = point.JxW * couple_work(point, before, old_Q);
        works.dissipation += couple;
        works.friction += couple;
        // g_s^n and xi_hat^n of the next step, and what its trapezoids begin
        // with: tangential traction and viscous pressure [MPa].
        // The way over the master is summed up in its frame: a way back undoes
        // it there, however the master has turned meanwhile. What is open keeps
        // what it has come to.
        point.accepted = trial.state;
        point.slipped += Q.transpose() * trial.slip_increment;
        point.accepted_traction = Q.transpose() * trial.tangential_traction;
        point.accepted_viscous_traction =
          Q.transpose() * trial.viscous_traction;
        point.accepted_viscous_pressure = trial.viscous_pressure;
        // What is open forgets its interacting point, or it would be pulled
        // back to it when it closes again somewhere else: the gap to the old
        // xi_hat would be a spring stretched over the distance that the
        // surfaces have moved while apart.
        const bool has_left = trial.path_to_edge > 0.;
        point.enters_at     = 0.;
        if (point.accepted.status == PointStatus::open)
          if (const Projection beside =
                project_accepted(point, configuration, true);
              has_left && beside.faces)
            point.enters_at = std::min(0., beside.height);
      }
    accept_shares(configuration);
    follow_pattern();
  }



  // What has closed for the first time, and so was not held in this step, bonds
  // to where its closest point is now.
  void
  ContactInterface::accept_shares(const InterfaceConfiguration &configuration)
  {
    const Eigen::Matrix3d &Q = configuration.side[master_side()].frame;
    for (unsigned int q = 0; q < shares.size(); ++q)
      {
        SlavePoint    &point  = points[q];
        CohesiveShare &share  = shares[q];
        share.gap             = Q.transpose() * share.bears;
        point.accepted.damage = share.damage;
        if (point.accepted.joined && !share.holds && point.phi_0 > 0. &&
            share.damage < 1.)
          share.xi = project(master(configuration),
                             interpolate(point.basis,
                                         configuration.side[slave].positions),
                             &point.accepted.xi)
                       .xi;
      }
  }
} // namespace Debond
