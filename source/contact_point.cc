#include <debond/contact_point.h>
#include <debond/skew.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <optional>

namespace Debond
{
  namespace
  {
    using Eigen::Matrix3d;
    using Eigen::RowVector3d;
    using Eigen::Vector2d;
    using Eigen::Vector3d;
    using Gradient = Eigen::Matrix<double, 1, 15>;
    using Jacobian = Eigen::Matrix<double, 3, 15>;

    // Columns of w = (x, y, a_1, a_2, y_n).
    constexpr int at_x = 0, at_y = 3, at_a1 = 6, at_a2 = 9, at_y_old = 12;

    // The unit normal that points to the slave and its derivatives, Eq. (24).
    struct Normal
    {
      Vector3d n;
      Matrix3d dn_da1, dn_da2;

      Normal(const SurfaceGeometry &geometry, const double outward_sign)
      {
        const Vector3d m      = geometry.a1.cross(geometry.a2);
        const double   length = m.norm();
        n                     = outward_sign / length * m;
        const Matrix3d project =
          outward_sign / length * (Matrix3d::Identity() - n * n.transpose());
        dn_da1 = -project * skew(geometry.a2);
        dn_da2 = project * skew(geometry.a1);
      }
    };



    // Normal gap g_n = n . (x - y) with its gradient.
    struct NormalGap
    {
      double   value;
      Gradient gradient;

      NormalGap(const Normal &normal, const Vector3d &gap)
        : value(normal.n.dot(gap))
        , gradient(Gradient::Zero())
      {
        gradient.segment<3>(at_x)  = normal.n;
        gradient.segment<3>(at_y)  = -normal.n;
        gradient.segment<3>(at_a1) = gap.transpose() * normal.dn_da1;
        gradient.segment<3>(at_a2) = gap.transpose() * normal.dn_da2;
      }
    };



    // d(eps g_n n) for a factor eps.
    void
    add_normal_part(const double     factor,
                    const Normal    &normal,
                    const NormalGap &gap,
                    Jacobian        &dt)
    {
      dt += factor * normal.n * gap.gradient;
      dt.middleCols<3>(at_a1) += factor * gap.value * normal.dn_da1;
      dt.middleCols<3>(at_a2) += factor * gap.value * normal.dn_da2;
    }



    // The friction law of a point: what mu(g_s) means for it in this step.
    struct PointFriction
    {
      const FrictionParameters &parameters;
      const double              phi_0;
      const bool                frictionless;

      FrictionCoefficient
      operator()(const double slip) const
      {
        FrictionCoefficient result =
          friction_coefficient(parameters, phi_0, slip);
        if (frictionless)
          result.mu = result.dmu = 0.;
        return result;
      }
    };



    // Traction and the two slip equations h = 0 at a trial xi_hat, with their
    // derivatives with respect to w at fixed xi_hat.
    struct SlipEquations
    {
      double                       g_n, pressure, softening;
      Vector3d                     t_t, traction;
      Vector2d                     h;
      Jacobian                     dt;
      Eigen::Matrix<double, 2, 15> dh;

      SlipEquations(const ContactPointLaw &law,
                    const PointFriction   &friction,
                    const double           old_slip,
                    const Vector3d        &x,
                    const Vector3d        &y_old,
                    const SurfaceGeometry &geometry,
                    const double           outward_sign)
      {
        const double eps_n = law.normal_penalty, eps_t = law.tangential_penalty;
        const Vector3d  gap = x - geometry.y;
        const Normal    normal(geometry, outward_sign);
        const NormalGap normal_gap(normal, gap);
        const Vector3d &n   = normal.n;
        g_n                 = normal_gap.value;
        const bool pressing = (g_n < 0.);
        pressure            = pressing ? -eps_n * g_n : 0.;

        // direction of slip: the trial gap on the tangent plane at xi_hat
        const Vector3d trial  = x - y_old;
        const double   n_part = n.dot(trial);
        const Vector3d u      = trial - n_part * n;
        const double   u_norm = u.norm();
        Vector3d       tau    = Vector3d::Zero();
        Jacobian       dtau   = Jacobian::Zero();
        if (u_norm > std::numeric_limits<double>::min())
          {
            tau = u / u_norm;
            const Matrix3d across =
              (Matrix3d::Identity() - tau * tau.transpose()) / u_norm;
            const Matrix3d across_n =
              across * (Matrix3d::Identity() - n * n.transpose());
            dtau.middleCols<3>(at_x)     = across_n;
            dtau.middleCols<3>(at_y_old) = -across_n;
            dtau.middleCols<3>(at_a1) =
              across * (-n_part * normal.dn_da1 -
                        n * (trial.transpose() * normal.dn_da1));
            dtau.middleCols<3>(at_a2) =
              across * (-n_part * normal.dn_da2 -
                        n * (trial.transpose() * normal.dn_da2));
          }

        // limit mu(g_s) p with g_s = g_s^n + |y - y_n|, Eq. (32); where slip
        // only just begins y - y_n has no direction but the limit tau
        const Vector3d slip     = geometry.y - y_old;
        const double   distance = slip.norm();
        const Vector3d forward =
          distance > 1e-14 * u_norm ? Vector3d(slip / distance) : tau;
        const FrictionCoefficient coefficient = friction(old_slip + distance);
        softening           = std::max(0., -coefficient.dmu) * pressure / eps_t;
        const double limit  = coefficient.mu * pressure;
        Gradient     dlimit = Gradient::Zero();
        dlimit.segment<3>(at_y)     = coefficient.dmu * pressure * forward;
        dlimit.segment<3>(at_y_old) = -coefficient.dmu * pressure * forward;
        if (pressing)
          dlimit -= coefficient.mu * eps_n * normal_gap.gradient;

        t_t                 = limit * tau;
        traction            = eps_n * g_n * n + t_t;
        const Jacobian dt_t = tau * dlimit + limit * dtau;
        dt                  = dt_t;
        add_normal_part(eps_n, normal, normal_gap, dt);

        const Vector3d excess  = gap - t_t / eps_t;
        Jacobian       dexcess = -dt_t / eps_t;
        dexcess.middleCols<3>(at_x) += Matrix3d::Identity();
        dexcess.middleCols<3>(at_y) -= Matrix3d::Identity();
        h << geometry.a1.dot(excess), geometry.a2.dot(excess);
        dh.row(0) = geometry.a1.transpose() * dexcess;
        dh.row(1) = geometry.a2.transpose() * dexcess;
        dh.block<1, 3>(0, at_a1) += excess.transpose();
        dh.block<1, 3>(1, at_a2) += excess.transpose();
      }

      // Contraction of a derivative with dw/dxi = (0, a_b, a_1b, a_2b, 0).
      template <int rows>
      static Eigen::Matrix<double, rows, 2>
      along_surface(const Eigen::Matrix<double, rows, 15> &d,
                    const SurfaceGeometry                 &geometry)
      {
        Eigen::Matrix<double, rows, 2> result;
        result.col(0) = d.template middleCols<3>(at_y) * geometry.a1 +
                        d.template middleCols<3>(at_a1) * geometry.a11 +
                        d.template middleCols<3>(at_a2) * geometry.a12;
        result.col(1) = d.template middleCols<3>(at_y) * geometry.a2 +
                        d.template middleCols<3>(at_a1) * geometry.a12 +
                        d.template middleCols<3>(at_a2) * geometry.a22;
        return result;
      }
    };



    enum class SlipOutcome
    {
      solved,
      left_patch,
      not_found
    };

    // The local problem of one point: Newton iteration for xi_hat, with line
    // search on |h|. The parameters stay in the patch; an iteration that keeps
    // pushing against the border has left it.
    class SlipProblem
    {
    public:
      SlipProblem(const ContactPointLaw &law,
                  const PointFriction   &friction,
                  const double           old_slip,
                  const Vector3d        &x,
                  const Vector3d        &y_old,
                  const MasterSurface   &master)
        : law(law)
        , friction(friction)
        , old_slip(old_slip)
        , x(x)
        , y_old(y_old)
        , master(master)
      {}

      SlipOutcome
      solve(const Vector2d &start, ContactPointResult &result)
      {
        constexpr unsigned int max_iterations = 30;
        Vector2d               xi             = start;
        evaluate(xi, result.basis);
        // |h|/|a| is a distance: it cannot be smaller than the rounding of
        // positions, which are of the size of the surface
        const double round_off =
          1e-16 * (x.norm() + geometry.a1.norm() + geometry.a2.norm());
        unsigned int pushes = 0;
        for (unsigned int iteration = 0; iteration < max_iterations;
             ++iteration)
          {
            const double   error = distance_error();
            const Vector2d step  = newton_step();
            if (!step.allFinite())
              return SlipOutcome::not_found;
            const bool last =
              step.cwiseAbs().maxCoeff() < 1e-15 || error <= round_off;
            if (last)
              break;
            const Vector2d target = (xi + step).cwiseMax(0.).cwiseMin(1.);
            if (target != xi + step && ++pushes > 5)
              return SlipOutcome::left_patch;
            const Vector2d full       = target - xi;
            const Vector2d old        = xi;
            double         best_error = std::numeric_limits<double>::max();
            for (double fraction = 1.; fraction > 0.01; fraction *= 0.5)
              {
                xi = old + fraction * full;
                evaluate(xi, result.basis);
                best_error = distance_error();
                if (best_error < error)
                  break;
              }
            if (!(best_error < error))
              {
                // no descent: fine at the level of rounding, else give up
                if (error > 100. * round_off)
                  return SlipOutcome::not_found;
                xi = old;
                evaluate(xi, result.basis);
                break;
              }
          }
        if (distance_error() > 100. * round_off)
          return SlipOutcome::not_found;
        result.state.xi = xi;
        return SlipOutcome::solved;
      }

      // Writes the slipping state; the motion of xi_hat is eliminated:
      // dxi = -(dh/dxi)^-1 dh/dw.
      void
      report(ContactPointResult &result) const
      {
        const SlipEquations &e     = *equations;
        result.normal_gap          = e.g_n;
        result.pressure            = e.pressure;
        result.softening           = e.softening;
        result.traction            = e.traction;
        result.tangential_traction = e.t_t;
        result.slip_increment      = geometry.y - y_old;
        if (!friction.frictionless)
          result.state.slip = old_slip + result.slip_increment.norm();
        result.dxi = -jacobian().inverse() * e.dh;
        result.dt =
          e.dt + SlipEquations::along_surface<3>(e.dt, geometry) * result.dxi;
      }

      double
      normal_gap() const
      {
        return equations->g_n;
      }

    private:
      void
      evaluate(const Vector2d &xi, SurfaceBasis &basis)
      {
        master.surface->evaluate(xi, basis, true);
        contract(basis, *master.positions, true, geometry);
        equations.emplace(
          law, friction, old_slip, x, y_old, geometry, master.outward_sign);
      }

      Eigen::Matrix2d
      jacobian() const
      {
        return SlipEquations::along_surface<2>(equations->dh, geometry);
      }

      Vector2d
      newton_step() const
      {
        return -jacobian().inverse() * equations->h;
      }

      double
      distance_error() const
      {
        return std::hypot(equations->h[0] / geometry.a1.norm(),
                          equations->h[1] / geometry.a2.norm());
      }

      const ContactPointLaw &law;
      const PointFriction   &friction;
      const double           old_slip;
      const Vector3d        &x, &y_old;
      const MasterSurface   &master;

      SurfaceGeometry              geometry;
      std::optional<SlipEquations> equations;
    };



    void
    set_open(const ContactPointLaw   &law,
             const ContactPointState &old_state,
             ContactPointResult      &result)
    {
      result.state        = old_state; // damage does not heal
      result.state.status = PointStatus::open;
      if (law.opening_breaks_bond && old_state.status != PointStatus::open)
        result.state.broken = true;
      result.traction = result.tangential_traction = result.slip_increment =
        Vector3d::Zero();
      result.pressure = result.softening = 0.;
      result.dt.setZero();
      result.dxi.setZero();
    }



    // Everything at xi_hat^n: t = eps_n g_n n + eps_t g_t.
    void
    set_stick(const ContactPointLaw   &law,
              const ContactPointState &old_state,
              const Vector3d          &gap,
              const Normal            &normal,
              const NormalGap         &normal_gap,
              ContactPointResult      &result)
    {
      const double eps_n = law.normal_penalty, eps_t = law.tangential_penalty;
      result.state               = old_state;
      result.state.status        = PointStatus::stick;
      result.normal_gap          = normal_gap.value;
      result.pressure            = std::max(0., -eps_n * normal_gap.value);
      result.softening           = 0.;
      result.tangential_traction = eps_t * (gap - normal_gap.value * normal.n);
      result.traction =
        eps_n * normal_gap.value * normal.n + result.tangential_traction;
      result.slip_increment = Vector3d::Zero();
      result.dxi.setZero();
      result.dt.setZero();
      result.dt.middleCols<3>(at_x) = eps_t * Matrix3d::Identity();
      result.dt.middleCols<3>(at_y) = -eps_t * Matrix3d::Identity();
      add_normal_part(eps_n - eps_t, normal, normal_gap, result.dt);
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
      const PointFriction none{law.friction, 0., true};
      ContactPointResult  projected;
      SlipProblem         problem(law, none, start.slip, x, y, master);
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
    const Vector3d n   = Normal(geometry, master.outward_sign).n;
    if (regular)
      result.clearance =
        n.dot(gap) >= 0. ? gap.norm() : (gap - n.dot(gap) * n).norm();
    return result;
  }



  void
  update_contact_point(const ContactPointLaw   &law,
                       const ContactPointState &old_state,
                       const double             phi_0,
                       const Vector3d          &x,
                       const MasterSurface     &master,
                       const ContactPointMode  &mode,
                       ContactPointResult      &result)
  {
    result.failed           = false;
    ContactPointState start = old_state;
    if (!find_partner(x, master, start))
      {
        set_open(law, old_state, result);
        return;
      }

    SurfaceGeometry geometry;
    master.surface->evaluate(start.xi, result.basis, false);
    contract(result.basis, *master.positions, false, geometry);
    const Vector3d  gap = x - geometry.y;
    const Normal    normal(geometry, master.outward_sign);
    const NormalGap normal_gap(normal, gap);
    result.normal_gap = normal_gap.value;

    const double touch =
      mode.stick_first ? mode.touch_tolerance : -mode.touch_tolerance;
    const bool          closed = normal_gap.value < touch;
    const PointFriction friction{law.friction,
                                 start.broken ? 0. : phi_0,
                                 mode.frictionless};
    const double        limit = friction(start.slip).mu *
                         std::max(0., -law.normal_penalty * normal_gap.value);
    const double trial_traction =
      law.tangential_penalty * (gap - normal_gap.value * normal.n).norm();
    if (closed && (mode.stick_first || trial_traction <= limit))
      {
        set_stick(law, start, gap, normal, normal_gap, result);
        if (!old_state.has_partner && normal_gap.value < 0.)
          follow_projection(law, start, x, geometry.y, master, result);
        return;
      }
    if (mode.stick_first)
      {
        set_open(law, old_state, result);
        return;
      }

    // Slip, or open: with p = 0 the same equations project the point, and the
    // sign of the gap found there decides.
    result.old_basis = result.basis;
    SlipProblem problem(law, friction, start.slip, x, geometry.y, master);
    SlipOutcome outcome = problem.solve(start.xi, result);
    if (outcome == SlipOutcome::not_found)
      {
        const Projection projection = project(master, x, &start.xi);
        if (projection.converged)
          outcome = projection.faces ? problem.solve(projection.xi, result) :
                                       SlipOutcome::left_patch;
      }
    if (outcome == SlipOutcome::solved && problem.normal_gap() < touch)
      {
        const Vector2d xi   = result.state.xi;
        result.state        = start;
        result.state.xi     = xi;
        result.state.status = PointStatus::slip;
        problem.report(result);
      }
    else if (outcome == SlipOutcome::not_found)
      {
        set_open(law, old_state, result);
        result.failed = true;
      }
    else
      {
        const double g_n = problem.normal_gap();
        set_open(law, old_state, result);
        result.normal_gap = g_n;
      }
  }
} // namespace Debond
