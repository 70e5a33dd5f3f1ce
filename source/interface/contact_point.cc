#include <debond/interface/slip_problem.h>

#include <Eigen/Dense>

#include <cmath>

namespace Debond
{
  using Eigen::Matrix3d;
  using Eigen::Vector2d;
  using Eigen::Vector3d;

  void
  leave_open(const ContactPointLaw   &law,
             const ContactPointState &old_state,
             ContactPointResult      &result)
  {
    result.failed = result.negative_friction = false;
    result.state                             = old_state; // damage stays
    result.state.status                      = PointStatus::open;
    if (old_state.status != PointStatus::open)
      law.normal->open(result.state);
    result.traction = result.tangential_traction = result.viscous_traction =
      result.slip_increment                      = Vector3d::Zero();
    result.normal_gap = result.pressure = result.energy = result.softening = 0.;
    result.dt.setZero();
    result.dxi.setZero();
  }



  namespace
  {
    // Columns of w = (x, y, a_1, a_2, y_n).
    constexpr int at_x = 0, at_y = 3, at_a1 = 6;

    // The friction of a point in a step of this mode. The state is that of the
    // beginning, and so is the phi_0 that is left.
    PointFriction
    friction_of(const ContactPointLaw   &law,
                const ContactPointState &start,
                const double             phi_0,
                const ContactPointMode  &mode)
    {
      return {*law.friction,
              friction_state(start, phi_0, mode.duration),
              mode.frictionless,
              law.explicit_friction,
              viscous_stiffness(law, mode),
              mode.slip_direction};
    }



    // Gaps that are no more than rounding are no contact, so that rounding
    // cannot wear a bond; but where all points stick they are one, so that
    // touching bodies under a loaded chuck have a tangent.
    bool
    is_closed(const ContactPointLaw  &law,
              const PointHistory     &history,
              const ContactPointMode &mode,
              const double            g_n)
    {
      const double reach = law.normal->reach(history);
      return mode.stick_first ? g_n < reach + mode.touch_tolerance :
                                g_n < reach - mode.touch_tolerance;
    }



    // The trial state: xi_hat stays at xi_hat^n, and all of the tangential gap
    // is elastic, t = -p n + eps_t g_t, Eqs. (27) and (28).
    void
    set_stick(const ContactPointLaw   &law,
              const ContactPointState &old_state,
              const PointFriction     &friction,
              const Vector3d          &gap,
              const MasterNormal      &normal,
              ContactPointResult      &result)
    {
      const Vector3d      &n        = normal.n;
      const double         g_n      = n.dot(gap);
      const NormalResponse response = law.normal->respond(g_n, old_state);
      const double eps_n = response.stiffness, eps_t = law.tangential_penalty;
      result.state        = old_state;
      result.state.status = PointStatus::stick;
      if (!friction.frictionless) // a state may age at rest
        result.state.internal = friction.law.advance(friction.start, 0.);
      result.normal_gap          = g_n;
      result.pressure            = std::max(0., response.pressure);
      result.softening           = 0.;
      result.tangential_traction = eps_t * (gap - g_n * n);
      result.traction = -response.pressure * n + result.tangential_traction;
      result.energy   = response.energy +
                      0.5 * result.tangential_traction.squaredNorm() / eps_t;
      result.slip_increment = result.viscous_traction = Vector3d::Zero();
      // dt = eps_t dg + (eps_n - eps_t) n dg_n - (p + eps_t g_n) dn
      result.dxi.setZero();
      result.dt.setZero();
      const Matrix3d along_gap =
        eps_t * Matrix3d::Identity() + (eps_n - eps_t) * n * n.transpose();
      result.dt.middleCols<3>(at_x)        = along_gap;
      result.dt.middleCols<3>(at_y)        = -along_gap;
      const Eigen::Matrix<double, 3, 6> dn = normal.derivative();
      result.dt.middleCols<6>(at_a1) =
        (eps_n - eps_t) * (n * (gap.transpose() * dn)) -
        (response.pressure + eps_t * g_n) * dn;
    }



    // A point that closes without an xi_hat^n of its own sticks where it is: it
    // has no tangential gap, and xi_hat, its projection, moves with it as on a
    // frictionless interface.
    void
    follow_projection(const ContactPointLaw   &law,
                      const ContactPointState &start,
                      const Vector3d          &x,
                      const Vector3d          &y,
                      const MasterSurface     &master,
                      ContactPointResult      &result)
    {
      PointFriction none = friction_of(law, start, 0., ContactPointMode());
      none.frictionless  = true;
      ContactPointResult projected;
      SlipProblem        problem(law, none, start, x, y, master);
      if (problem.solve(start.xi, projected) != SlipOutcome::solved)
        return;
      problem.report(projected);
      result.dt  = projected.dt;
      result.dxi = projected.dxi;
    }



    // An open point beyond the edge of the master has no xi_hat^n: it starts
    // where it is now, if it faces the master at all.
    bool
    find_partner(const Vector3d      &x,
                 const MasterSurface &master,
                 ContactPointState   &state)
    {
      if (state.has_partner)
        return true;
      const Projection projection = project(master, x, nullptr);
      state.xi                    = projection.xi;
      state.has_partner           = projection.faces;
      return state.has_partner;
    }
  } // namespace



  Projection
  project(const MasterSurface   &master,
          const Eigen::Vector3d &x,
          const Eigen::Vector2d *guess)
  {
    const ClosestPoint closest =
      closest_point(*master.surface, *master.positions, x, guess);
    SurfaceBasis    basis;
    SurfaceGeometry geometry;
    master.surface->evaluate(closest.xi, basis, false);
    contract(basis, *master.positions, false, geometry);
    constexpr double smallest_angle = 0.01; // between the tangents
    const bool       regular =
      geometry.a1.cross(geometry.a2).norm() >
      smallest_angle * geometry.a1.norm() * geometry.a2.norm();

    Projection result;
    result.xi        = closest.xi;
    result.converged = closest.converged;
    result.faces     = closest.converged && closest.is_orthogonal && regular;
    // a point below the surface's level may come under it by moving sideways
    // less than its distance
    const Vector3d gap = x - geometry.y;
    const Vector3d n   = MasterNormal(geometry, master.outward_sign).n;
    if (regular)
      result.clearance =
        n.dot(gap) >= 0. ? gap.norm() : (gap - n.dot(gap) * n).norm();
    return result;
  }



  double
  viscous_stiffness(const ContactPointLaw &law, const ContactPointMode &mode)
  {
    const bool resists = !mode.frictionless && mode.duration > 0. &&
                         !law.friction->is_frictionless();
    return resists ? law.viscosity / mode.duration : 0.;
  }



  namespace
  {
    // The point slides, or opens: with p = 0 the same equations project it, and
    // the sign of the gap found there decides. @p y_old: y(xi_hat^n).
    void
    slide_or_open(const ContactPointLaw   &law,
                  const ContactPointState &old_state,
                  const ContactPointState &start,
                  const PointFriction     &friction,
                  const Vector3d          &x,
                  const Vector3d          &y_old,
                  const MasterSurface     &master,
                  const ContactPointMode  &mode,
                  ContactPointResult      &result)
    {
      result.old_basis = result.basis;
      SlipProblem problem(law, friction, start, x, y_old, master);
      SlipOutcome outcome = problem.solve(start.xi, result);
      if (outcome == SlipOutcome::not_found)
        {
          const Projection projection = project(master, x, &start.xi);
          if (projection.converged)
            outcome = projection.faces ? problem.solve(projection.xi, result) :
                                         SlipOutcome::left_patch;
        }
      const double g_n = problem.at_end().g_n;
      if (outcome == SlipOutcome::solved && is_closed(law, start, mode, g_n))
        {
          const Vector2d xi   = result.state.xi;
          result.state        = start;
          result.state.xi     = xi;
          result.state.status = PointStatus::slip;
          problem.report(result);
          result.failed = result.negative_friction =
            problem.at_end().coefficient.mu < 0.;
          return;
        }
      leave_open(law, old_state, result);
      result.failed = outcome == SlipOutcome::not_found;
      if (!result.failed)
        result.normal_gap = g_n;
    }
  } // namespace



  // Where a point with friction is after the step is found by elimination: one
  // that has no partner is open; one that is closed at xi_hat^n and carries no
  // more than friction allows sticks there; what is left slides, or opens.
  void
  update_contact_point(const ContactPointLaw   &law,
                       const ContactPointState &old_state,
                       const double             phi_0,
                       const Vector3d          &x,
                       const MasterSurface     &master,
                       const ContactPointMode  &mode,
                       ContactPointResult      &result)
  {
    result.failed = result.negative_friction = false;
    ContactPointState start                  = old_state;
    if (!find_partner(x, master, start))
      {
        leave_open(law, old_state, result);
        return;
      }

    // the gap at xi_hat^n, Eq. (26), with the normal of Eq. (24)
    SurfaceGeometry geometry;
    master.surface->evaluate(start.xi, result.basis, false);
    contract(result.basis, *master.positions, false, geometry);
    const Vector3d     gap = x - geometry.y;
    const MasterNormal normal(geometry, master.outward_sign);
    const double       g_n    = normal.n.dot(gap);
    const bool         closed = is_closed(law, start, mode, g_n);

    // it sticks while eps_t |g_t| <= mu p, Eqs. (28) and (30), at g_s^n
    const PointFriction friction = friction_of(law, start, phi_0, mode);
    const double        limit    = friction.after(0.).mu *
                         std::max(0., law.normal->respond(g_n, start).pressure);
    const double trial_traction =
      law.tangential_penalty * (gap - g_n * normal.n).norm();
    if (closed && (mode.stick_first || trial_traction <= limit))
      {
        set_stick(law, start, friction, gap, normal, result);
        if (!old_state.has_partner && g_n < 0.)
          follow_projection(law, start, x, geometry.y, master, result);
      }
    else if (mode.stick_first)
      {
        leave_open(law, old_state, result);
        result.normal_gap = g_n;
      }
    else
      slide_or_open(
        law, old_state, start, friction, x, geometry.y, master, mode, result);
  }
} // namespace Debond
