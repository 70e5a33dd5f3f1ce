#include <debond/interface/contact_point.h>
#include <debond/support/skew.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <optional>

namespace Debond
{
  namespace
  {
    using Eigen::Matrix3d;
    using Eigen::Vector2d;
    using Eigen::Vector3d;

    // Columns of w = (x, y, a_1, a_2, y_n).
    constexpr int at_x = 0, at_y = 3, at_a1 = 6;

    // The unit normal that points to the slave, Eq. (24).
    struct Normal
    {
      const SurfaceGeometry &geometry;
      Vector3d               n;
      double                 scale; ///< n = scale * a_1 x a_2

      Normal(const SurfaceGeometry &geometry, const double outward_sign)
        : geometry(geometry)
      {
        const Vector3d m = geometry.a1.cross(geometry.a2);
        scale            = outward_sign / m.norm();
        n                = scale * m;
      }

      // dn for changes of the tangents.
      Vector3d
      change(const Vector3d &da1, const Vector3d &da2) const
      {
        const Vector3d dm =
          scale * (da1.cross(geometry.a2) + geometry.a1.cross(da2));
        return dm - n * n.dot(dm);
      }

      // dn/d(a_1, a_2).
      Eigen::Matrix<double, 3, 6>
      derivative() const
      {
        Eigen::Matrix<double, 3, 6> dm;
        dm << -scale * skew(geometry.a2), scale * skew(geometry.a1);
        return dm - n * (n.transpose() * dm);
      }
    };



    // The friction law of a point in this step: what mu(g_s) means for it, how
    // sliding is resisted by its speed, and where it goes.
    struct PointFriction
    {
      const FrictionParameters &parameters;
      const double              phi_0;
      const bool                frictionless;
      const double              old_slip;
      const bool                is_explicit    = false;
      const double              viscous        = 0.; ///< eta / dt [MPa/mm]
      const Vector3d            slip_direction = Vector3d::Zero();

      FrictionCoefficient
      after(const double distance) const
      {
        FrictionCoefficient result =
          friction_coefficient(parameters,
                               phi_0,
                               old_slip + (is_explicit ? 0. : distance));
        if (frictionless)
          result.mu = result.dmu = 0.;
        if (is_explicit)
          result.dmu = 0.;
        return result;
      }
    };



    // Traction and the two slip equations h = 0 at a trial xi_hat.
    struct SlipEquations
    {
      const ContactPointLaw &law;
      const SurfaceGeometry &geometry;
      const PointFriction   &friction;
      const Vector3d         gap, trial;
      const bool             direction_is_given;
      const Vector3d         pull;
      const Normal           normal;
      const Vector3d        &n;
      const double           g_n, pressure;
      double                 n_part, u_norm, limit;
      double                 resistance; ///< viscous part of the limit
      Vector3d               tau, forward;
      FrictionCoefficient    coefficient;
      Vector3d               t_t, traction, excess;
      Vector2d               h;

      SlipEquations(const ContactPointLaw &law,
                    const PointFriction   &friction,
                    const Vector3d        &x,
                    const Vector3d        &y_old,
                    const SurfaceGeometry &geometry,
                    const double           outward_sign)
        : law(law)
        , geometry(geometry)
        , friction(friction)
        , gap(x - geometry.y)
        , trial(x - y_old)
        , direction_is_given(!friction.slip_direction.isZero(0.))
        , pull(direction_is_given ? friction.slip_direction : trial)
        , normal(geometry, outward_sign)
        , n(normal.n)
        , g_n(n.dot(gap))
        , pressure(g_n < 0. ? -law.normal_penalty * g_n : 0.)
      {
        // direction of slip: the trial gap on the tangent plane at xi_hat
        n_part           = n.dot(pull);
        const Vector3d u = pull - n_part * n;
        u_norm           = u.norm();
        tau =
          has_direction() ? Vector3d(u / u_norm) : Vector3d(Vector3d::Zero());

        // limit mu(g_s) p with g_s = g_s^n + |y - y_n|, Eq. (32); where slip
        // only just begins y - y_n has no direction but the limit tau
        const Vector3d slip     = geometry.y - y_old;
        const double   distance = slip.norm();
        forward =
          distance > 1e-14 * trial.norm() ? Vector3d(slip / distance) : tau;
        coefficient = friction.after(distance);
        resistance  = pressure > 0. ? friction.viscous * distance : 0.;
        limit       = coefficient.mu * pressure + resistance;

        t_t      = limit * tau;
        traction = law.normal_penalty * g_n * n + t_t;
        excess   = gap - t_t / law.tangential_penalty;
        h << geometry.a1.dot(excess), geometry.a2.dot(excess);
      }

      bool
      has_direction() const
      {
        return u_norm > std::numeric_limits<double>::min();
      }

      double
      softening() const
      {
        return std::max(0., -coefficient.dmu) * pressure /
               (law.tangential_penalty + friction.viscous);
      }

      template <int N>
      struct Derivative
      {
        Eigen::Matrix<double, 3, N> traction;
        Eigen::Matrix<double, 2, N> h;
      };

      // Derivatives along N changes of x - y, x - y_n, n, and of a_1 and a_2
      // as far as they change a_alpha . excess.
      template <int N>
      Derivative<N>
      along(const Eigen::Matrix<double, 3, N> &dgap,
            const Eigen::Matrix<double, 3, N> &dtrial,
            const Eigen::Matrix<double, 3, N> &dn,
            const Eigen::Matrix<double, 2, N> &excess_da) const
      {
        using Vectors      = Eigen::Matrix<double, 3, N>;
        using Numbers      = Eigen::Matrix<double, 1, N>;
        const Numbers dg_n = n.transpose() * dgap + gap.transpose() * dn;

        const double along_slip =
          coefficient.dmu * pressure + (pressure > 0. ? friction.viscous : 0.);
        Numbers dlimit = (along_slip * forward).transpose() * (dtrial - dgap);
        if (pressure > 0.)
          dlimit -= coefficient.mu * law.normal_penalty * dg_n;
        Vectors dt_t = tau * dlimit;
        if (has_direction())
          {
            const Vectors dpull =
              direction_is_given ? Vectors(Vectors::Zero()) : dtrial;
            const Numbers dn_part =
              n.transpose() * dpull + pull.transpose() * dn;
            const Vectors du = dpull - n_part * dn - n * dn_part;
            dt_t += limit / u_norm * (du - tau * (tau.transpose() * du));
          }
        const Vectors dexcess = dgap - dt_t / law.tangential_penalty;

        Derivative<N> result;
        result.traction = dt_t + law.normal_penalty * (n * dg_n + g_n * dn);
        result.h        = excess_da;
        result.h.row(0) += geometry.a1.transpose() * dexcess;
        result.h.row(1) += geometry.a2.transpose() * dexcess;
        return result;
      }

      // ... with respect to w.
      Derivative<15>
      along_w() const
      {
        using Vectors = Eigen::Matrix<double, 3, 12>;
        Vectors dgap = Vectors::Zero(), dtrial = Vectors::Zero(),
                dn = Vectors::Zero();
        Eigen::Matrix<double, 2, 12> excess_da =
          Eigen::Matrix<double, 2, 12>::Zero();
        dgap.leftCols<3>()          = Matrix3d::Identity();
        dtrial.middleCols<3>(3)     = Matrix3d::Identity();
        dn.rightCols<6>()           = normal.derivative();
        excess_da.block<1, 3>(0, 6) = excess.transpose();
        excess_da.block<1, 3>(1, 9) = excess.transpose();
        const Derivative<12> d      = along<12>(dgap, dtrial, dn, excess_da);

        Derivative<15> result;
        result.traction << d.traction.leftCols<3>() +
                             d.traction.middleCols<3>(3),
          -d.traction.leftCols<3>(), d.traction.rightCols<6>(),
          -d.traction.middleCols<3>(3);
        result.h << d.h.leftCols<3>() + d.h.middleCols<3>(3),
          -d.h.leftCols<3>(), d.h.rightCols<6>(), -d.h.middleCols<3>(3);
        return result;
      }

      // ... with respect to the two parameters of the surface.
      Derivative<2>
      along_surface() const
      {
        const SurfaceGeometry      &y = geometry;
        Eigen::Matrix<double, 3, 2> dgap, dn;
        Eigen::Matrix2d             excess_da;
        dgap << -y.a1, -y.a2;
        dn << normal.change(y.a11, y.a12), normal.change(y.a12, y.a22);
        excess_da << excess.dot(y.a11), excess.dot(y.a12), excess.dot(y.a12),
          excess.dot(y.a22);
        return along<2>(dgap,
                        Eigen::Matrix<double, 3, 2>::Zero(),
                        dn,
                        excess_da);
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
                  const Vector3d        &x,
                  const Vector3d        &y_old,
                  const MasterSurface   &master)
        : law(law)
        , friction(friction)
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
        result.softening           = e.softening();
        result.traction            = e.traction;
        result.tangential_traction = e.t_t;
        result.viscous_traction    = e.resistance * e.tau;
        result.slip_increment      = geometry.y - y_old;
        if (!friction.frictionless)
          result.state.slip = friction.old_slip + result.slip_increment.norm();
        const auto along_w  = e.along_w();
        const auto along_xi = e.along_surface();
        result.dxi          = -along_xi.h.inverse() * along_w.h;
        result.dt           = along_w.traction + along_xi.traction * result.dxi;
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
          law, friction, x, y_old, geometry, master.outward_sign);
      }

      Vector2d
      newton_step() const
      {
        return -equations->along_surface().h.inverse() * equations->h;
      }

      double
      distance_error() const
      {
        return Vector2d(equations->h[0] / geometry.a1.norm(),
                        equations->h[1] / geometry.a2.norm())
          .norm();
      }

      const ContactPointLaw &law;
      const PointFriction   &friction;
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
      result.traction = result.tangential_traction = result.viscous_traction =
        result.slip_increment                      = Vector3d::Zero();
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
              ContactPointResult      &result)
    {
      const double eps_n = law.normal_penalty, eps_t = law.tangential_penalty;
      const Vector3d &n          = normal.n;
      const double    g_n        = n.dot(gap);
      result.state               = old_state;
      result.state.status        = PointStatus::stick;
      result.normal_gap          = g_n;
      result.pressure            = std::max(0., -eps_n * g_n);
      result.softening           = 0.;
      result.tangential_traction = eps_t * (gap - g_n * n);
      result.traction            = eps_n * g_n * n + result.tangential_traction;
      result.slip_increment = result.viscous_traction = Vector3d::Zero();
      result.dxi.setZero();
      result.dt.setZero();
      const Matrix3d along_gap =
        eps_t * Matrix3d::Identity() + (eps_n - eps_t) * n * n.transpose();
      result.dt.middleCols<3>(at_x)        = along_gap;
      result.dt.middleCols<3>(at_y)        = -along_gap;
      const Eigen::Matrix<double, 3, 6> dn = normal.derivative();
      result.dt.middleCols<6>(at_a1) =
        (eps_n - eps_t) * (n * (gap.transpose() * dn) + g_n * dn);
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
      const PointFriction none{law.friction, 0., true, start.slip};
      ContactPointResult  projected;
      SlipProblem         problem(law, none, x, y, master);
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



  double
  viscous_stiffness(const ContactPointLaw &law, const ContactPointMode &mode)
  {
    const bool resists = !mode.frictionless && mode.duration > 0. &&
                         law.friction.kind != FrictionLawKind::frictionless;
    return resists ? law.viscosity / mode.duration : 0.;
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
    const Vector3d gap = x - geometry.y;
    const Normal   normal(geometry, master.outward_sign);
    const double   normal_gap = normal.n.dot(gap);
    result.normal_gap         = normal_gap;

    const double touch =
      mode.stick_first ? mode.touch_tolerance : -mode.touch_tolerance;
    const bool          closed = normal_gap < touch;
    const PointFriction friction{law.friction,
                                 start.bond_left(phi_0),
                                 mode.frictionless,
                                 start.slip,
                                 law.explicit_friction,
                                 viscous_stiffness(law, mode),
                                 mode.slip_direction};
    const double        limit =
      friction.after(0.).mu * std::max(0., -law.normal_penalty * normal_gap);
    const double trial_traction =
      law.tangential_penalty * (gap - normal_gap * normal.n).norm();
    if (closed && (mode.stick_first || trial_traction <= limit))
      {
        set_stick(law, start, gap, normal, result);
        if (!old_state.has_partner && normal_gap < 0.)
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
    SlipProblem problem(law, friction, x, geometry.y, master);
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
