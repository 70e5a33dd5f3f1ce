#include <debond/interface/contact_point.h>
#include <debond/interface/slip_problem.h>

#include <Eigen/Dense>

namespace Debond
{
  // What happens at one quadrature point of the slave in one step: the
  // constitutive law of the interface, asked as a material law is asked at a
  // quadrature point of the bulk. Positions and history go in; traction, its
  // derivatives and a new history come out, all of it in space, in mm and MPa.
  // Nothing else is read or written, so that points can be updated in any
  // order, and a trial that comes to nothing has cost only its time.
  using Eigen::Matrix3d;
  using Eigen::Vector2d;
  using Eigen::Vector3d;

  // An open point carries nothing and forgets its xi_hat, but not how far it
  // has slid: damage does not heal. The law may note that it has been open.
  //
  // With `Opening breaks bond' that ends the bond; in the paper's law a point
  // that closes again is bonded as before.
  void
  leave_open(const ContactPointLaw   &law,
             const ContactPointState &old_state,
             ContactPointResult      &result,
             const double             g_n)
  {
    ContactPointAnswer open;
    open.normal_gap   = g_n;
    open.state        = old_state;
    open.state.status = PointStatus::open;
    open.state.gap.setZero();
    if (old_state.status != PointStatus::open)
      static_cast<PointHistory &>(open.state) = law.joint->open(old_state);
    // No traction, no stored energy, and no derivatives: an open point drops
    // out of forces and tangent.
    static_cast<ContactPointAnswer &>(result) = open;
    result.dt.setZero();
    result.dxi.setZero();
    result.dpath.setZero();
    if (old_state.has_partner)
      result.basis = result.old_basis;
    result.by_damage = {};
  }



  // The closest point of the master is where a point without a history starts
  // to interact with it. It is no partner if it lies on the edge while x is
  // beyond, nor if the surface has no proper normal there.
  //
  // It is also no partner if the search did not converge: then it stays open,
  // and that is counted, rather than that it sticks to a wrong place.
  Projection
  project(const MasterSurface &master,
          const Vector3d      &x,
          const Vector2d      *guess,
          const Vector3d      *normal)
  {
    // the direction of a_1 x a_2 on pieces that face the slave; the law of a
    // point knows of no normal, and stays on its piece
    Vector3d towards = Vector3d::Zero();
    if (normal != nullptr)
      towards = -master.outward_sign * *normal;
    const ClosestPoint closest = closest_point(*master.surface,
                                               *master.positions,
                                               x,
                                               guess,
                                               normal ? &towards : nullptr);
    // What faces nothing, such as the upper side of a collar in a hole, has no
    // partner. It may come to face something as it turns, but touches nothing
    // before it has come as near as the nearest piece is, whatever way that
    // looks: so long it is not asked again.
    if (!std::isfinite(closest.distance))
      {
        const ClosestPoint nearest =
          closest_point(*master.surface, *master.positions, x);
        Projection nothing;
        nothing.xi        = nearest.xi;
        nothing.converged = true;
        nothing.clearance = nearest.distance;
        return nothing;
      }
    // Where it is, and the tangents there, Eq. (23). In the corners of the
    // disk's patch they are parallel, and their cross product, the normal of
    // Eq. (24), has no direction.
    SurfaceBasis    basis;
    SurfaceGeometry geometry;
    master.surface->evaluate(closest.xi, basis);
    contract(basis, *master.positions, geometry);
    constexpr double smallest_angle = 0.01; // between the tangents
    const bool       regular =
      geometry.a1.cross(geometry.a2).norm() >
      smallest_angle * geometry.a1.norm() * geometry.a2.norm();

    Projection result;
    result.xi        = closest.xi;
    result.converged = closest.converged;
    result.faces     = closest.converged && closest.is_orthogonal && regular;
    // A point below the surface's level may come under it by moving sideways
    // less than its distance. The clearance [mm] is the distance in space for a
    // point above the level of the master, and the distance along it for one
    // below. Where the normal is not to be trusted it stays 0, so that the
    // point is asked every time.
    const Vector3d gap = x - geometry.y;
    const Vector3d n   = MasterNormal(geometry, master.outward_sign).n;
    if (regular)
      {
        result.height = n.dot(gap);
        result.clearance =
          n.dot(gap) >= 0. ? gap.norm() : (gap - n.dot(gap) * n).norm();
      }
    return result;
  }



  // Viscosity resists the mean speed (g_s - g_s^n) / dt of a step with eta
  // times that, which is eta / dt [MPa/mm] per distance slid: a spring to the
  // local problem, whose stiffness adds to eps_t where uniqueness is asked for.
  // It grows as steps shrink, so that with a viscosity a steep law has one
  // solution in steps that are short enough. In row 0 no time passes, and there
  // is none.
  double
  viscous_stiffness(const ContactPointLaw &law, const ContactPointMode &mode)
  {
    const bool resists = !mode.frictionless && mode.duration > 0. &&
                         !law.joint->friction->is_frictionless;
    return resists ? law.viscosity / mode.duration : 0.;
  }



  namespace
  {
    // What the step starts from. The master has taken xi_hat^n with it, and the
    // parts of the old gap along a_1 and a_2; where slip is integrated over the
    // step the string was L_n / eps_t long.
    void
    bring_along(const MasterNormal &old, PointStep &point)
    {
      const ContactPointState &start = point.before;
      point.y_old                    = old.geometry.y;
      point.old_gap =
        start.gap[0] * old.geometry.a1 + start.gap[1] * old.geometry.a2;
      PointStart before = point.start;
      before.damage     = start.damage;
      point.old_limit =
        point.joint().respond(before, start.normal_gap, 0.).limit /
        point.law.tangential_penalty;
      point.arc = Arc(point.mode.turn);
    }



    // Contact is where g_n < 0, or less than the reach of a law with strength
    // in tension. Gaps that are no more than rounding are no contact, so that
    // rounding cannot wear a bond; but where all points stick they are one,
    // so that touching bodies under a loaded chuck have a tangent.
    //
    // A tolerance of rounding: 1e-12 of the implant's radius.
    bool
    is_closed(const PointStep &point, const double g_n, const double distance)
    {
      const ContactPointMode &mode = point.mode;
      const double reach           = point.joint().reach(point.start, distance);
      return mode.stick_first ? g_n < reach + mode.touch_tolerance :
                                g_n < reach - mode.touch_tolerance;
    }



    // The trial state: xi_hat stays at xi_hat^n, and all of the tangential
    // gap of Eq. (27) is elastic. Eq. (28) has one penalty for both parts of
    // the gap; here each has its own, t = -p n + eps_t g_t.
    //
    // This is elastic and can be undone: within a step, and from step to
    // step, a point that sticks returns to where it was when the load does.
    // g_s stays.
    void
    stick(const PointStep         &point,
          const InterfaceResponse &response,
          const Vector3d          &gap,
          const MasterNormal      &normal,
          ContactPointResult      &result)
    {
      // g_n and p: the spring eps_n pushes while g_n < 0; a law with strength
      // in tension pulls beyond.
      const Vector3d &n     = normal.n;
      const double    g_n   = n.dot(gap);
      const double    eps_n = -response.pressure_by_gap,
                   eps_t    = point.law.tangential_penalty;
      // xi_hat = xi_hat^n and g_s = g_s^n. The spring eps_t holds the point
      // with what is left of the gap in the tangent plane, (1 - n n^T) g,
      // which need not be zero: this gap is the elastic deformation of the
      // interface, not an error of the penalty.
      const ContactPointState &start = point.before;
      result.state                   = start;
      result.state.status            = PointStatus::stick;
      result.basis                   = result.old_basis;
      result.state.gap               = normal.parts(gap);
      point.carry(response, n, eps_t * (gap - g_n * n), g_n, 0., result);
      result.slip_increment = result.viscous_traction = Vector3d::Zero();

      // The tangent follows from g = x - y and n(a_1, a_2) alone, since
      // xi_hat does not move:
      //   dt = eps_t dg + (eps_n - eps_t) n dg_n - (p + eps_t g_n) dn.
      //   dg = dx - dy,   dg_n = n . dg + g . dn.
      // With the penalty law and eps_n = eps_t all but the first term cancel,
      // and dt = eps dg is Eq. (28) differentiated. Otherwise the turning of
      // the normal has a part.
      result.dxi.setZero();
      const Eigen::Matrix<double, 3, 6> dn = normal.derivative();
      result.dt << eps_t * Matrix3d::Identity() +
                     (eps_n - eps_t) * n * n.transpose(),
        (eps_n - eps_t) * (n * (gap.transpose() * dn)) -
          (response.pressure + eps_t * g_n) * dn,
        Eigen::Matrix<double, 3, W::size - W::trial_gap>::Zero();
      result.by_damage = {};
      result.dpath.setZero();
      if (point.joint().opened(result.state) > point.joint().opened(start))
        {
          result.dpath.segment<3>(W::gap) = n.transpose();
          result.dpath.segment<6>(W::a1)  = gap.transpose() * dn;
        }
    }



    // The point slides, or opens: with p = 0 the same equations project it,
    // and the sign of the gap found there decides. Newton's method starts
    // where the gap at xi_hat^n is as long as its limit there [MPa]; if that
    // fails, from the projection of the point, unless it has left the master.
    //
    // Whether it opens cannot be told from the gap at xi_hat^n: on a curved
    // or tilted master a point may lift off at the old place and touch at the
    // new one, or touch at the old place only.
    void
    slide_or_open(const PointStep    &point,
                  const MasterNormal &old,
                  const Vector3d     &tangential_gap,
                  const double        limit,
                  ContactPointResult &result)
    {
      const ContactPointState &start = point.before;
      SlipProblem              problem(point);
      const double             elastic = limit / point.law.tangential_penalty,
                   length              = tangential_gap.norm();
      const double slip    = length > 0. ? 1. - elastic / length : 0.;
      SlipOutcome  outcome = problem.solve(
        point.master.surface->moved(start.xi,
                                    slip * old.parts(tangential_gap)));
      // The projection is near the solution wherever the tangential gap is
      // small, however far xi_hat^n is, and starting there costs one more
      // search. A point whose projection is beyond the edge has left the
      // master, and opens; a projection that does not converge leaves the
      // failure as it is.
      if (outcome == SlipOutcome::not_found)
        {
          const Projection projection =
            project(point.master, point.x, &start.xi);
          if (projection.converged)
            outcome = projection.faces ? problem.solve(projection.xi) :
                                         SlipOutcome::left_patch;
          // What viscosity carries ends at once where the pressure does. A
          // point that climbs as it slides may find no place on either side
          // of that: it has come to p = 0, and opens.
          if (outcome == SlipOutcome::not_found && projection.faces &&
              point.start.viscous > 0. &&
              projection.height >= point.joint().reach(point.start, 0.))
            return leave_open(point.law, start, result, projection.height);
        }
      // Closed where it has come to: it slides. xi_hat is new, report() adds
      // g_s and traction. The solution of a law that went below mu = 0 would
      // push the point along; it is refused, and with it the step.
      const SlipEquations &end = problem.at_end();
      const double         g_n = end.g_n;
      if (outcome == SlipOutcome::solved && is_closed(point, g_n, end.distance))
        {
          result.state = start;
          result.state.status =
            end.response.shears ? PointStatus::shears :
            end.response.pressure < 0. && end.response.limit == 0. ?
                                  PointStatus::pulled :
                                  PointStatus::slip;
          problem.report(result);
          result.failed = result.negative_friction = end.response.limit < 0.;
          return;
        }
      // Solved with an open gap, or beyond the edge: open. Not found: an open
      // point stands in for the result, marked as failed, so that the
      // iteration is given up and the step made smaller.
      const bool failed = outcome == SlipOutcome::not_found;
      leave_open(point.law, start, result, failed ? 0. : g_n);
      result.failed = failed;
      if (outcome == SlipOutcome::left_patch)
        result.path_to_edge = end.distance;
    }
  } // namespace



  // Where a point with friction is after the step is found by elimination: one
  // that has no partner is open; one that is closed at xi_hat^n and carries no
  // more than friction allows sticks there; what is left slides, or opens.
  //
  // The order costs little: a point that sticks needs no more of the master
  // than what it had at xi_hat^n, and only what slides an iteration. It is a
  // return mapping, as of plasticity: an elastic trial, a limit, and a
  // correction on the limit, with g_s in the place of the accumulated plastic
  // strain.
  void
  update_contact_point(const ContactPointLaw   &law,
                       const ContactPointState &start,
                       const double             phi_0,
                       const Vector3d          &x,
                       const MasterSurface     &master,
                       const ContactPointMode  &mode,
                       ContactPointResult      &result)
  {
    result.failed = result.negative_friction = false;
    result.path_to_edge                      = 0.;
    if (!start.has_partner) // beyond the edge
      return leave_open(law, start, result);

    // The gap to the old interacting point, Eq. (26) at xi_hat^n, where that is
    // now; and its normal part, Eq. (27), along the normal of Eq. (24).
    SurfaceGeometry geometry;
    result.old_basis.move_to(*master.surface, start.xi);
    contract(result.old_basis, *master.positions, geometry);
    const Vector3d     gap = x - geometry.y;
    const MasterNormal normal(geometry, master.outward_sign);
    const double       g_n = normal.n.dot(gap);

    // If the point stuck, it would carry the trial traction eps_t |g_t|, Eq.
    // (28). It does while that is no more than the L = mu p of Eq. (30), with
    // mu at the sliding distance g_s^n that it comes with.
    //
    // mu is asked with the distance 0: a law with a state that ages has aged in
    // this step, and for one that depends on the speed this is V = 0. A limit
    // and a traction in MPa are compared, both along the surface as it is now.
    // Where the limit is 0 a point slides, even where nothing has moved yet:
    // rounding would decide what sticks.
    //
    // In the frictionless part of a load history (`Friction starts at') nothing
    // rubs and g_s does not grow.
    PointStep point{
      law,
      mode,
      master,
      start,
      x,
      law.joint->begin(start, phi_0, mode.duration, mode.frictionless)};
    point.start.viscous = viscous_stiffness(law, mode);
    if (law.joint->cohesion)
      point.start.damage = mode.damage;
    const bool              closed   = is_closed(point, g_n, 0.);
    const InterfaceResponse response = law.joint->respond(point.start, g_n, 0.);
    const Vector3d          tangential_gap = gap - g_n * normal.n;
    const double            trial_traction =
      law.tangential_penalty * tangential_gap.norm();
    // In the first iteration of some attempts all closed points are made to
    // stick, whatever they would carry: the tangent is then that of bodies
    // joined by springs, and the iteration cannot begin with a cycle of stick
    // and slip. The true law takes over in the next one.
    const bool holds = response.limit > 0. && trial_traction <= response.limit;
    if (closed && (mode.stick_first || holds))
      stick(point, response, gap, normal, result);
    else if (mode.stick_first || (!closed && holds))
      // a bond that is still to form would hold it in place
      leave_open(law, start, result, g_n);
    else
      {
        bring_along(normal, point);
        slide_or_open(point, normal, tangential_gap, response.limit, result);
      }
  }
} // namespace Debond
