#include <debond/geometry/closest_point.h>
#include <debond/interface/contact_point.h>
#include <debond/interface/slip_problem.h>

#include <Eigen/Dense>

#include <cmath>

namespace Debond
{
  using Eigen::Matrix3d;
  using Eigen::Vector2d;
  using Eigen::Vector3d;

  // An open point carries nothing and forgets its xi_hat, but not how far it
  // has slid: damage does not heal. The law may note that it has been open.
  void
  leave_open(const ContactPointLaw   &law,
             const ContactPointState &old_state,
             ContactPointResult      &result)
  {
    result.failed = result.negative_friction = false;
    result.state                             = old_state;
    result.state.status                      = PointStatus::open;
    if (old_state.status != PointStatus::open)
      law.normal->open(result.state);
    result.traction = result.tangential_traction = result.viscous_traction =
      result.slip_increment                      = Vector3d::Zero();
    result.normal_gap = result.pressure = result.energy = result.softening = 0.;
    result.dt.setZero();
    result.dxi.setZero();
  }



  // The closest point of the master is where a point without a history starts
  // to interact with it. It is no partner if it lies on the edge while x is
  // beyond, nor if the surface has no proper normal there.
  Projection
  project(const MasterSurface &master, const Vector3d &x, const Vector2d *guess)
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
    // One point in one step: what is given, and the three ends that it may
    // come to. `start' is the state of the beginning, with an xi_hat^n.
    struct PointStep
    {
      const ContactPointLaw   &law;
      const ContactPointState &old_state;
      const Vector3d          &x;
      const MasterSurface     &master;
      const ContactPointMode  &mode;
      ContactPointResult      &result;
      ContactPointState        start;

      // An open point beyond the edge of the master has no xi_hat^n: it starts
      // where it is now, if it faces the master at all.
      bool
      find_partner()
      {
        if (start.has_partner)
          return true;
        const Projection projection = project(master, x, nullptr);
        start.xi                    = projection.xi;
        start.has_partner           = projection.faces;
        return start.has_partner;
      }

      // What the friction law is to know of the point: the state at the
      // beginning, and with it the bond that is left.
      PointFriction
      friction(const double phi_0) const
      {
        return {*law.friction,
                friction_state(start, phi_0, mode.duration),
                mode.frictionless,
                law.explicit_friction,
                viscous_stiffness(law, mode),
                mode.slip_direction};
      }

      // Contact is where g_n < 0, or less than the reach of a law with strength
      // in tension. Gaps that are no more than rounding are no contact, so that
      // rounding cannot wear a bond; but where all points stick they are one,
      // so that touching bodies under a loaded chuck have a tangent.
      bool
      is_closed(const double g_n) const
      {
        const double reach = law.normal->reach(start);
        return mode.stick_first ? g_n < reach + mode.touch_tolerance :
                                  g_n < reach - mode.touch_tolerance;
      }

      void
      open(const double g_n)
      {
        leave_open(law, old_state, result);
        result.normal_gap = g_n;
      }

      // The trial state: xi_hat stays at xi_hat^n, and all of the tangential
      // gap of Eq. (27) is elastic. Eq. (28) has one penalty for both parts of
      // the gap; here each has its own, t = -p n + eps_t g_t.
      void
      stick(const PointFriction &friction,
            const Vector3d      &gap,
            const MasterNormal  &normal)
      {
        const Vector3d      &n        = normal.n;
        const double         g_n      = n.dot(gap);
        const NormalResponse response = law.normal->respond(g_n, start);
        const double eps_n = response.stiffness, eps_t = law.tangential_penalty;
        result.state        = start;
        result.state.status = PointStatus::stick;
        if (!friction.frictionless) // a state may age at rest
          result.state.internal = friction.law.advance(friction.start, 0.);
        result.normal_gap          = g_n;
        result.pressure            = std::max(0., response.pressure);
        result.softening           = 0.;
        result.tangential_traction = eps_t * (gap - g_n * n);
        result.traction = -response.pressure * n + result.tangential_traction;
        // the potential that Eq. (28) comes from
        result.energy = response.energy +
                        0.5 * result.tangential_traction.squaredNorm() / eps_t;
        result.slip_increment = result.viscous_traction = Vector3d::Zero();

        // The tangent follows from g = x - y and n(a_1, a_2) alone, since
        // xi_hat does not move:
        //   dt = eps_t dg + (eps_n - eps_t) n dg_n - (p + eps_t g_n) dn.
        constexpr int at_x = 0, at_y = 3, at_a1 = 6; // columns of w
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

      // A point that closes without an xi_hat^n of its own sticks where it is:
      // it has no tangential gap, and xi_hat, its projection, moves with it as
      // on a frictionless interface.
      void
      follow_projection(const Vector3d &y)
      {
        const PointFriction none{*law.friction,
                                 friction_state(start, 0.),
                                 true,
                                 law.explicit_friction};
        ContactPointResult  projected;
        SlipProblem         problem(law, none, start, x, y, master);
        if (problem.solve(start.xi, projected) != SlipOutcome::solved)
          return;
        problem.report(projected);
        result.dt  = projected.dt;
        result.dxi = projected.dxi;
      }

      // The point slides, or opens: with p = 0 the same equations project it,
      // and the sign of the gap found there decides. @p y_old: y(xi_hat^n).
      // Newton's method starts from xi_hat^n; if that fails, from the
      // projection of the point, unless it has left the master.
      void
      slide_or_open(const PointFriction &friction, const Vector3d &y_old)
      {
        result.old_basis = result.basis;
        SlipProblem problem(law, friction, start, x, y_old, master);
        SlipOutcome outcome = problem.solve(start.xi, result);
        if (outcome == SlipOutcome::not_found)
          {
            const Projection projection = project(master, x, &start.xi);
            if (projection.converged)
              outcome = projection.faces ?
                          problem.solve(projection.xi, result) :
                          SlipOutcome::left_patch;
          }
        const double g_n = problem.at_end().g_n;
        if (outcome == SlipOutcome::solved && is_closed(g_n))
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
        const bool failed = outcome == SlipOutcome::not_found;
        open(failed ? 0. : g_n);
        result.failed = failed;
      }
    };
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
    PointStep step{law, old_state, x, master, mode, result, old_state};
    if (!step.find_partner())
      {
        step.open(0.);
        return;
      }

    // The gap to the old interacting point, Eq. (26) at xi_hat^n, where that is
    // now; and its normal part, Eq. (27), along the normal of Eq. (24).
    const ContactPointState &start = step.start;
    SurfaceGeometry          geometry;
    master.surface->evaluate(start.xi, result.basis, false);
    contract(result.basis, *master.positions, false, geometry);
    const Vector3d     gap = x - geometry.y;
    const MasterNormal normal(geometry, master.outward_sign);
    const double       g_n    = normal.n.dot(gap);
    const bool         closed = step.is_closed(g_n);

    // If the point stuck, it would carry the trial traction eps_t |g_t|, Eq.
    // (28). It does while that is no more than the mu p of Eq. (30), with mu at
    // the sliding distance g_s^n that it comes with.
    const PointFriction friction = step.friction(phi_0);
    const double        limit    = friction.after(0.).mu *
                         std::max(0., law.normal->respond(g_n, start).pressure);
    const double trial_traction =
      law.tangential_penalty * (gap - g_n * normal.n).norm();
    if (closed && (mode.stick_first || trial_traction <= limit))
      {
        step.stick(friction, gap, normal);
        if (!old_state.has_partner && g_n < 0.)
          step.follow_projection(geometry.y);
      }
    else if (mode.stick_first)
      step.open(g_n);
    else
      step.slide_or_open(friction, geometry.y);
  }
} // namespace Debond
