#include <debond/interface/slip_problem.h>
#include <debond/support/skew.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace Debond
{
  using Eigen::Matrix3d;
  using Eigen::Vector2d;
  using Eigen::Vector3d;

  MasterNormal::MasterNormal(const SurfaceGeometry &geometry,
                             const double           outward_sign)
    : geometry(geometry)
  {
    const Vector3d m = geometry.a1.cross(geometry.a2);
    scale            = outward_sign / m.norm();
    n                = scale * m;
  }



  Vector3d
  MasterNormal::change(const Vector3d &da1, const Vector3d &da2) const
  {
    const Vector3d dm =
      scale * (da1.cross(geometry.a2) + geometry.a1.cross(da2));
    return dm - n * n.dot(dm); // a unit vector turns, no more
  }



  Eigen::Matrix<double, 3, 6>
  MasterNormal::derivative() const
  {
    Eigen::Matrix<double, 3, 6> dm;
    dm << -scale * skew(geometry.a2), scale * skew(geometry.a1);
    return dm - n * (n.transpose() * dm);
  }



  // A sliding point obeys two equations, for the two parameters of its xi_hat.
  // First the gap g = x - y, Eq. (26), is split along the normal there, Eqs.
  // (24) and (27), which gives the pressure; then comes the direction of slip;
  // then the traction that friction allows.
  SlipEquations::SlipEquations(const ContactPointLaw &law,
                               const PointFriction   &friction,
                               const PointHistory    &history,
                               const Vector3d        &x,
                               const Vector3d        &y_old,
                               const SurfaceGeometry &geometry,
                               const double           outward_sign)
    : slip(geometry.y - y_old)
    , distance(slip.norm())
    , law(law)
    , geometry(geometry)
    , friction(friction)
    , normal(geometry, outward_sign)
    , gap(x - geometry.y)
    , trial_gap(x - y_old)
  {
    g_n             = normal.n.dot(gap);
    normal_response = law.normal->respond(g_n, history);
    pressure        = std::max(0., normal_response.pressure);
    find_direction();
    find_traction();
  }



  // tau is the direction of the trial gap x - y(xi_hat^n) in the tangent plane
  // at xi_hat. Eq. (31) as printed has the previous gap there; it comes as the
  // given direction.
  void
  SlipEquations::find_direction()
  {
    direction_is_given = !friction.slip_direction.isZero(0.);
    pull             = direction_is_given ? friction.slip_direction : trial_gap;
    pull_along_n     = normal.n.dot(pull);
    const Vector3d u = pull - pull_along_n * normal.n;
    pull_along_surface = u.norm();
    has_direction = pull_along_surface > std::numeric_limits<double>::min();
    tau           = Vector3d::Zero();
    if (has_direction)
      tau = u / pull_along_surface;
  }



  // The law is asked at the updated sliding distance, Eq. (32): the traction is
  // t_t = (mu p + eta V) tau, Eq. (30). What the gap is more than the elastic
  // t_t / eps_t must have no part in the surface, Eq. (29).
  void
  SlipEquations::find_traction()
  {
    // where slip only just begins y - y_n has no direction but the limit tau
    forward =
      distance > 1e-14 * trial_gap.norm() ? Vector3d(slip / distance) : tau;
    // A point cannot slide against what pulls it. Where Newton's method looks
    // there, mu goes on along its tangent: the distance alone would have a
    // second solution there, where friction rises with the speed.
    const bool backwards = !direction_is_given && slip.dot(tau) < 0.;
    sense                = backwards ? -1. : 1.;
    coefficient          = friction.after(backwards ? 0. : distance);
    if (backwards)
      coefficient.mu -= coefficient.dmu * distance;
    const double resistance =
      pressure > 0. ? sense * friction.viscous * distance : 0.;
    limit = coefficient.mu * pressure + resistance;

    viscous_traction    = resistance * tau;
    tangential_traction = limit * tau;
    traction = -normal_response.pressure * normal.n + tangential_traction;
    excess   = gap - tangential_traction / law.tangential_penalty;
    h << geometry.a1.dot(excess), geometry.a2.dot(excess);
  }



  template <int N>
  SlipEquations::Derivative<N>
  SlipEquations::along(const Eigen::Matrix<double, 3, N> &dgap,
                       const Eigen::Matrix<double, 3, N> &dtrial,
                       const Eigen::Matrix<double, 3, N> &dn,
                       const Eigen::Matrix<double, 2, N> &excess_da) const
  {
    using Vectors     = Eigen::Matrix<double, 3, N>;
    using Numbers     = Eigen::Matrix<double, 1, N>;
    const Vector3d &n = normal.n;
    // g_n = n . g, and with it p
    const Numbers dg_n = n.transpose() * dgap + gap.transpose() * dn;

    // the limit changes with the sliding distance, y - y_n = (x - y_n) - (x -
    // y), and with the pressure
    Numbers dlimit =
      (sense * resistance_slope() * forward).transpose() * (dtrial - dgap);
    if (pressure > 0.)
      dlimit -= coefficient.mu * normal_response.stiffness * dg_n;
    Vectors dt_t = tau * dlimit;
    // tau turns with the pull, unless it is given, and with the tangent plane
    if (has_direction)
      {
        const Vectors dpull =
          direction_is_given ? Vectors(Vectors::Zero()) : dtrial;
        const Numbers dalong_n = n.transpose() * dpull + pull.transpose() * dn;
        const Vectors du       = dpull - pull_along_n * dn - n * dalong_n;
        dt_t +=
          limit / pull_along_surface * (du - tau * (tau.transpose() * du));
      }
    const Vectors dexcess = dgap - dt_t / law.tangential_penalty;

    Derivative<N> result;
    result.traction = dt_t + (normal_response.stiffness * n * dg_n -
                              normal_response.pressure * dn);
    result.h        = excess_da;
    result.h.row(0) += geometry.a1.transpose() * dexcess;
    result.h.row(1) += geometry.a2.transpose() * dexcess;
    return result;
  }



  // x moves both gaps, y the gap, y_n the trial gap, the tangents the normal.
  SlipEquations::Derivative<15>
  SlipEquations::along_w() const
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
    result.traction << d.traction.leftCols<3>() + d.traction.middleCols<3>(3),
      -d.traction.leftCols<3>(), d.traction.rightCols<6>(),
      -d.traction.middleCols<3>(3);
    result.h << d.h.leftCols<3>() + d.h.middleCols<3>(3), -d.h.leftCols<3>(),
      d.h.rightCols<6>(), -d.h.middleCols<3>(3);
    return result;
  }



  SlipEquations::Derivative<2>
  SlipEquations::along_surface() const
  {
    const SurfaceGeometry      &y = geometry;
    Eigen::Matrix<double, 3, 2> dgap, dn;
    Eigen::Matrix2d             excess_da;
    dgap << -y.a1, -y.a2;
    dn << normal.change(y.a11, y.a12), normal.change(y.a12, y.a22);
    excess_da << excess.dot(y.a11), excess.dot(y.a12), excess.dot(y.a12),
      excess.dot(y.a22);
    return along<2>(dgap, Eigen::Matrix<double, 3, 2>::Zero(), dn, excess_da);
  }



  SlipProblem::SlipProblem(const ContactPointLaw &law,
                           const PointFriction   &friction,
                           const PointHistory    &history,
                           const Vector3d        &x,
                           const Vector3d        &y_old,
                           const MasterSurface   &master)
    : law(law)
    , friction(friction)
    , history(history)
    , x(x)
    , y_old(y_old)
    , master(master)
  {}



  // Newton's method with a line search on |h|. The parameters stay in the
  // patch; an iteration that keeps pushing against the border has left it.
  SlipOutcome
  SlipProblem::solve(const Vector2d &start, ContactPointResult &result)
  {
    constexpr unsigned int max_iterations = 30;
    Vector2d               xi             = start;
    evaluate(xi, result.basis);
    // |h|/|a| is a distance: it cannot be smaller than the rounding of
    // positions, which are of the size of the surface, and of the sliding
    // distance found from them, which moves the traction
    const double rounding =
      1e-16 * (x.norm() + geometry.a1.norm() + geometry.a2.norm());
    const auto round_off = [&] {
      return rounding * (1. + std::abs(equations->resistance_slope()) /
                                law.tangential_penalty);
    };
    unsigned int pushes = 0;
    for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
      {
        const double   error = distance_error();
        const Vector2d step =
          -equations->along_surface().h.inverse() * equations->h;
        if (!step.allFinite())
          return SlipOutcome::not_found;
        if (step.cwiseAbs().maxCoeff() < 1e-15 || error <= round_off())
          break;
        const Vector2d target = (xi + step).cwiseMax(0.).cwiseMin(1.);
        if (target != xi + step && ++pushes > 5)
          return SlipOutcome::left_patch;
        // no descent: fine at the level of rounding, else give up
        if (!search_along(target - xi, error, xi, result.basis))
          break;
      }
    if (distance_error() > 100. * round_off())
      return SlipOutcome::not_found;
    result.state.xi = xi;
    return SlipOutcome::solved;
  }



  // False, and nothing has moved, if no part of the step makes |h| smaller.
  bool
  SlipProblem::search_along(const Vector2d &step,
                            const double    error,
                            Vector2d       &xi,
                            SurfaceBasis   &basis)
  {
    const Vector2d old = xi;
    for (double fraction = 1.; fraction > 0.01; fraction *= 0.5)
      {
        xi = old + fraction * step;
        evaluate(xi, basis);
        if (distance_error() < error)
          return true;
      }
    xi = old;
    evaluate(xi, basis);
    return false;
  }



  // With h(xi_hat, w) = 0 the implicit function theorem gives the motion of
  // xi_hat, dxi = -(dh/dxi)^-1 dh/dw, and the total derivative of the traction.
  void
  SlipProblem::report(ContactPointResult &result) const
  {
    const SlipEquations &e     = *equations;
    result.normal_gap          = e.g_n;
    result.pressure            = e.pressure;
    result.softening           = e.softening();
    result.traction            = e.traction;
    result.tangential_traction = e.tangential_traction;
    result.viscous_traction    = e.viscous_traction;
    result.slip_increment      = e.slip;
    result.energy =
      e.normal_response.energy +
      0.5 * e.tangential_traction.squaredNorm() / law.tangential_penalty;
    if (!friction.frictionless)
      {
        result.state.slip = friction.start.slip + e.distance;
        result.state.internal =
          friction.law.advance(friction.start, e.distance);
      }
    const auto along_w  = e.along_w();
    const auto along_xi = e.along_surface();
    result.dxi          = -along_xi.h.inverse() * along_w.h;
    result.dt           = along_w.traction + along_xi.traction * result.dxi;
  }



  void
  SlipProblem::evaluate(const Vector2d &xi, SurfaceBasis &basis)
  {
    master.surface->evaluate(xi, basis, true);
    contract(basis, *master.positions, true, geometry);
    equations.emplace(
      law, friction, history, x, y_old, geometry, master.outward_sign);
  }



  double
  SlipProblem::distance_error() const
  {
    return Vector2d(equations->h[0] / geometry.a1.norm(),
                    equations->h[1] / geometry.a2.norm())
      .norm();
  }
} // namespace Debond
