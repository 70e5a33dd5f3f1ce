// The tangent of a contact point on a curved, deformed master - sticking,
// sliding, opening - agrees with automatic differentiation of its equations,
// written here anew: traction and forces on the master with respect to the
// slave point and to every control point of the master. A point sticks if and
// only if its trial traction is within the friction limit. So do viscous
// sliding, an explicit friction coefficient, a given direction of slip, and
// slip that is integrated over the step along a chord or an arc.

#include <debond/geometry/surface_geometry.h>
#include <debond/interface/contact_point.h>
#include <debond/interface/modified_coulomb.h>

#include <Eigen/Geometry>

#include <Sacado.hpp>
#include <array>
#include <string>
#include <vector>

#include "checks.h"
#include "law_of_text.h"

using namespace Debond;

// Derivatives with respect to the slave point and all control points, and with
// respect to the two parameters of the surface.
using Fad   = Sacado::Fad::DFad<double>;
using Local = Sacado::Fad::SFad<double, 2>;

double
value(const double x)
{
  return x;
}
template <typename Number>
double
value(const Number &x)
{
  return x.val();
}



template <typename Number>
using Vector = std::array<Number, 3>;

template <typename Number>
Number
dot(const Vector<Number> &a, const Vector<Number> &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** a + factor b */
template <typename Number>
Vector<Number>
add(const Vector<Number> &a, const Number &factor, const Vector<Number> &b)
{
  Vector<Number> c;
  for (unsigned int i = 0; i < 3; ++i)
    c[i] = a[i] + factor * b[i];
  return c;
}

template <typename Number>
Number
norm(const Vector<Number> &a)
{
  using std::sqrt;
  return sqrt(dot(a, a));
}



/** B-spline i of degree p by the recursion of Cox and de Boor, 0/0 = 0. */
template <typename Number>
Number
b_spline(const std::vector<double> &U,
         const unsigned int         i,
         const unsigned int         p,
         const Number              &u)
{
  if (p == 0)
    return Number(U[i] <= value(u) && value(u) < U[i + 1] ? 1. : 0.);
  Number result = 0.;
  if (U[i + p] > U[i])
    result += (u - U[i]) / (U[i + p] - U[i]) * b_spline(U, i, p - 1, u);
  if (U[i + p + 1] > U[i + 1])
    result += (U[i + p + 1] - u) / (U[i + p + 1] - U[i + 1]) *
              b_spline(U, i + 1, p - 1, u);
  return result;
}

template <typename Number>
Number
b_spline_derivative(const std::vector<double> &U,
                    const unsigned int         i,
                    const unsigned int         p,
                    const Number              &u)
{
  Number result = 0.;
  if (U[i + p] > U[i])
    result += p / (U[i + p] - U[i]) * b_spline(U, i, p - 1, u);
  if (U[i + p + 1] > U[i + 1])
    result -= p / (U[i + p + 1] - U[i + 1]) * b_spline(U, i + 1, p - 1, u);
  return result;
}



/** A point of the master: basis functions of the whole patch, position,
 *  tangents, and the normal that points to the slave. */
template <typename Number>
struct MasterPoint
{
  std::vector<Number> N;
  Vector<Number>      y, a1, a2, n;

  MasterPoint(const MasterSurface               &master,
              const std::vector<Vector<Number>> &positions,
              const std::array<Number, 2>       &xi)
  {
    const NurbsSurface &surface = *master.surface;
    const unsigned int  n_1d[]{surface.knots(0).n_basis_functions(),
                               surface.knots(1).n_basis_functions()};
    std::array<std::vector<Number>, 2> B, dB;
    for (unsigned int d = 0; d < 2; ++d)
      for (unsigned int i = 0; i < n_1d[d]; ++i)
        {
          const auto &U = surface.knots(d).knots();
          B[d].push_back(b_spline(U, i, surface.degree(), xi[d]));
          dB[d].push_back(b_spline_derivative(U, i, surface.degree(), xi[d]));
        }

    Number              W = 0., W_1 = 0., W_2 = 0.;
    std::vector<Number> w, w_1, w_2;
    for (unsigned int j = 0; j < n_1d[1]; ++j)
      for (unsigned int i = 0; i < n_1d[0]; ++i)
        {
          const double weight = surface.weights()[w.size()];
          w.push_back(weight * B[0][i] * B[1][j]);
          w_1.push_back(weight * dB[0][i] * B[1][j]);
          w_2.push_back(weight * B[0][i] * dB[1][j]);
          W += w.back();
          W_1 += w_1.back();
          W_2 += w_2.back();
        }
    y = a1 = a2 = {{0., 0., 0.}};
    for (unsigned int A = 0; A < w.size(); ++A)
      {
        N.push_back(w[A] / W);
        const Number N_1 = (w_1[A] - N[A] * W_1) / W;
        const Number N_2 = (w_2[A] - N[A] * W_2) / W;
        y                = add(y, N[A], positions[A]);
        a1               = add(a1, N_1, positions[A]);
        a2               = add(a2, N_2, positions[A]);
      }
    for (unsigned int i = 0; i < 3; ++i)
      n[i] = master.outward_sign * (a1[(i + 1) % 3] * a2[(i + 2) % 3] -
                                    a1[(i + 2) % 3] * a2[(i + 1) % 3]);
    const Number length = norm(n);
    for (Number &component : n)
      component /= length;
  }
};



/** Eqs. (11) and (13). */
template <typename Number>
Number
friction_coefficient_at(const ModifiedCoulombParameters &friction,
                        const double                     phi_0,
                        const Number                    &g_s)
{
  using std::sin;
  const double b_s   = friction.transition_factor;
  const Number x     = g_s / friction.sliding_threshold;
  Number       decay = 1.;
  if (value(x) > 1. + 2. * b_s)
    decay = 0.;
  else if (value(x) >= 1.)
    decay = 0.5 - 0.5 * sin(M_PI / (2. * b_s) * (x - b_s - 1.));
  return phi_0 * decay * friction.mu_unbroken +
         (1. - phi_0 * decay) * friction.mu_broken;
}



/** Rate and state, which a test may choose instead. */
struct RateAndState
{
  double mu_0 = 0.4, A = 0.05, B = 0.08, V_0 = 0.01, D = 0.02, theta_0 = 3;
  bool   ageing = true, is_used = false;

  FrictionLawPointer
  law() const
  {
    const std::string evolution = ageing ? "ageing" : "slip";
    return law_of_text(
      "set Friction law = rate and state\nsubsection Rate and state\n"
      "set Reference coefficient = 0.4\nset Direct effect = 0.05\n"
      "set Evolution effect = 0.08\nset Reference speed = 0.01\n"
      "set Sliding distance = 0.02\nset Initial state = 3\n"
      "set Evolution = " +
      evolution + "\nend\n");
  }

  template <typename Number>
  Number
  mu(const Number &distance, const double dt) const
  {
    using std::exp;
    using std::log;
    const Number V = distance / dt, decay = exp(-distance / D);
    Number       theta = D / V + (theta_0 - D / V) * decay;
    if (!ageing)
      theta = D / V * exp(decay * log(V * theta_0 / D));
    return mu_0 + A * log(1. + V / V_0) + B * log(V_0 * theta / D);
  }
};



/** What a point is and what it is asked to do. */
struct Setting
{
  ContactPointLaw           law;
  double                    eps_n = 600;
  ModifiedCoulombParameters friction; ///< frictionless: with zero coefficients
  bool                      frictionless_law = false;
  bool                      is_explicit      = false; ///< mu at g_s^n
  RateAndState              rate_and_state;
  ContactPointMode          mode;
  ContactPointState         old_state;
  double                    phi_0        = 0.9;
  double                    turn         = 0.; ///< of the way in the step
  double                    old_pressure = 0.; ///< before the step
  MasterSurface             master;
  Eigen::Vector3d           x;

  double
  bond() const
  {
    return old_state.broken ? 0. : phi_0;
  }

  void
  rub_with(FrictionLawPointer friction_law)
  {
    law.joint = friction_under_pressure(eps_n, std::move(friction_law));
  }

  void
  set_friction(const ModifiedCoulombParameters &parameters)
  {
    friction = parameters;
    rub_with(modified_coulomb(parameters));
  }

  void
  set_frictionless()
  {
    friction = {0., 0.};
    rub_with(modified_coulomb({}, ModifiedCoulomb::Coefficients::none));
    frictionless_law = true;
  }
};

/** The penalty law with the gap split at a point of the master. */
template <typename Number>
struct Gap
{
  Number         g_n, pressure;
  Vector<Number> tangential;

  Gap(const Setting             &setting,
      const Vector<Number>      &x,
      const MasterPoint<Number> &at)
  {
    const Vector<Number> g = add(x, Number(-1.), at.y);
    g_n                    = dot(at.n, g);
    pressure               = 0.;
    if (value(g_n) < 0.)
      pressure = -setting.eps_n * g_n;
    tangential = add(g, Number(-g_n), at.n);
  }
};

template <typename Number>
Vector<Number>
penalty_traction(const Setting             &setting,
                 const Gap<Number>         &gap,
                 const MasterPoint<Number> &at)
{
  Vector<Number> t;
  for (unsigned int i = 0; i < 3; ++i)
    t[i] = setting.eps_n * gap.g_n * at.n[i] +
           setting.law.tangential_penalty * gap.tangential[i];
  return t;
}

/** mu p + eta V. */
template <typename Number>
Number
friction_limit(const Setting &setting,
               const Number  &pressure,
               const Number  &distance)
{
  const Number mu =
    setting.rate_and_state.is_used ?
      setting.rate_and_state.mu(distance, setting.mode.duration) :
      friction_coefficient_at(setting.friction,
                              setting.bond(),
                              Number(setting.old_state.slip + distance));
  Number result = mu * pressure;
  if (setting.law.viscosity > 0.)
    result += setting.law.viscosity * distance / setting.mode.duration;
  return result;
}



/** The gap of a point that tows its interacting point, by the closed forms of a
 *  string on a chord, and of the equation of Riccati on an arc; the slid
 *  distance is added to @p g_s. */
template <typename Number>
Vector<Number>
towed_gap(const Setting             &setting,
          const Vector<Number>      &x,
          const MasterPoint<Number> &old,
          const MasterPoint<Number> &at,
          const Number              &pressure,
          Number                    &g_s)
{
  using std::atan, std::atan2, std::cos, std::exp, std::log, std::sin,
    std::sqrt, std::tan;
  const double eps = setting.law.tangential_penalty, turn = setting.turn;
  const auto   flat = [&](const Vector<Number> &v) {
    return add(v, Number(-dot(v, at.n)), at.n);
  };
  Vector<Number> g_0;
  for (unsigned int c = 0; c < 3; ++c)
    g_0[c] = setting.old_state.gap[0] * old.a1[c] +
             setting.old_state.gap[1] * old.a2[c];
  const Vector<Number> motion =
    flat(add(add(x, Number(-1.), old.y), Number(-1.), g_0));
  const Number         S = norm(motion);
  const Vector<Number> e = add({{0., 0., 0.}}, Number(1. / S), motion);
  const Vector<Number> m{{at.n[1] * e[2] - at.n[2] * e[1],
                          at.n[2] * e[0] - at.n[0] * e[2],
                          at.n[0] * e[1] - at.n[1] * e[0]}};
  const Number         g_e = dot(g_0, e), g_m = dot(g_0, m);

  // where it begins to slide, by Newton's method with differences
  const Number mu_old    = friction_limit(setting, Number(1.), Number(1e-200));
  const Number A         = mu_old * setting.old_pressure / eps,
               B         = mu_old * pressure / eps - A;
  const auto at_fraction = [&](const Number &f, Number &a, Number &b) {
    const double ratio = turn == 0. ? 1. : 1. / std::sin(0.5 * turn);
    const Number part  = turn == 0. ? f : Number(sin(0.5 * turn * f) * ratio);
    a                  = g_e + S * part * cos(0.5 * turn * (f - 1.));
    b                  = g_m + S * part * sin(0.5 * turn * (f - 1.));
    return Number(a * a + b * b - (A + f * B) * (A + f * B));
  };
  Number     f       = 1., a, b;
  const auto iterate = [](Number &unknown, const auto &residual) {
    for (unsigned int i = 0; i < 80; ++i)
      {
        const double h = 1e-6;
        const double slope =
          (value(residual(Number(unknown + h * value(unknown)))) -
           value(residual(Number(unknown - h * value(unknown))))) /
          (2. * h * value(unknown));
        // shortened, lest it goes to and fro about a kink of the law
        unknown -= 0.7 * residual(unknown) / slope;
      }
  };
  iterate(f, [&](const Number &at) { return at_fraction(at, a, b); });
  at_fraction(f, a, b);
  const Number L_0 = sqrt(a * a + b * b);
  const double arc = turn == 0. ? 1. : 0.5 * turn / std::sin(0.5 * turn);
  const Number s   = (1. - f) * S * arc;
  const Number u_0 = tan(0.5 * (atan2(b, a) - turn * (f - 0.5)));

  Number     u_1;
  const auto missing = [&](const Number &distance) {
    const Number L_1 = friction_limit(setting, pressure, distance) / eps;
    const Number L   = 0.5 * (L_0 + L_1);
    Number       slid;
    if (turn == 0.)
      {
        u_1  = u_0 * exp(-s / L);
        slid = s + L * log((1. + u_1 * u_1) / (1. + u_0 * u_0));
      }
    else
      {
        const Number kappa = -turn / (S * arc),
                     D     = sqrt(1. - kappa * kappa * L * L);
        const Number u_a = (1. - D) / (kappa * L), u_b = (1. + D) / (kappa * L);
        const Number w = (u_0 - u_a) / (u_0 - u_b) * exp(-D * s / L);
        u_1            = (u_a - u_b * w) / (1. - w);
        const Number q = (u_0 - u_b) / (u_1 - u_b);
        slid = D * s + L * log(q * q * (1. + u_1 * u_1) / (1. + u_0 * u_0));
      }
    return Number(distance - slid + L_1 - L_0);
  };
  Number distance = s;
  iterate(distance, missing);
  missing(distance);
  g_s += distance;
  const Number angle = 2. * atan(u_1) + 0.5 * turn;
  const Number L_1   = friction_limit(setting, pressure, distance) / eps;
  return add(add({{0., 0., 0.}}, Number(L_1 * cos(angle)), e),
             Number(L_1 * sin(angle)),
             m);
}



/** The two equations of sliding at @p at, Eqs. (29) and (30). */
template <typename Number>
std::array<Number, 2>
slip_equations(const Setting             &setting,
               const Vector<Number>      &x,
               const MasterPoint<Number> &old,
               const MasterPoint<Number> &at,
               Number                    &g_s)
{
  const Gap<Number> gap(setting, x, at);
  Number            mu = 0.;
  g_s                  = setting.old_state.slip;
  if (setting.law.slip_direction == SlipDirection::integrated)
    {
      const Vector<Number> excess =
        add(gap.tangential,
            Number(-1.),
            towed_gap(setting, x, old, at, gap.pressure, g_s));
      return {{dot(at.a1, excess), dot(at.a2, excess)}};
    }
  Number viscous = 0.;
  if (!setting.mode.frictionless)
    {
      const Number distance = norm(add(at.y, Number(-1.), old.y));
      g_s += distance;
      mu = friction_coefficient_at(setting.friction,
                                   setting.bond(),
                                   setting.is_explicit ?
                                     Number(setting.old_state.slip) :
                                     g_s);
      if (setting.rate_and_state.is_used)
        mu = setting.rate_and_state.mu(distance, setting.mode.duration);
      if (setting.law.viscosity > 0. && !setting.frictionless_law)
        viscous = setting.law.viscosity * distance / setting.mode.duration;
    }
  Vector<Number> pull = add(x, Number(-1.), old.y);
  if (setting.law.slip_direction == SlipDirection::previous_gap)
    pull = add(add({{0., 0., 0.}}, Number(setting.old_state.gap[0]), old.a1),
               Number(setting.old_state.gap[1]),
               old.a2);
  const Vector<Number> u = add(pull, Number(-dot(pull, at.n)), at.n);
  const Number         elastic =
    (mu * gap.pressure + viscous) / (setting.law.tangential_penalty * norm(u));
  const Vector<Number> excess = add(gap.tangential, Number(-elastic), u);
  return {{dot(at.a1, excess), dot(at.a2, excess)}};
}



/** The seeded kinematics of a setting. */
template <typename Number>
struct Kinematics
{
  Vector<Number>              x;
  std::vector<Vector<Number>> positions;
};

Kinematics<Local>
constants(const Setting &setting)
{
  Kinematics<Local> kinematics;
  const ControlNet &net = *setting.master.positions;
  kinematics.positions.resize(net.cols());
  for (unsigned int c = 0; c < 3; ++c)
    {
      kinematics.x[c] = setting.x[c];
      for (unsigned int A = 0; A < net.cols(); ++A)
        kinematics.positions[A][c] = net(c, A);
    }
  return kinematics;
}

Kinematics<Fad>
seeded(const Setting &setting)
{
  Kinematics<Fad>   kinematics;
  const ControlNet &net     = *setting.master.positions;
  const int         n_seeds = 3 + 3 * net.cols();
  kinematics.positions.resize(net.cols());
  for (unsigned int c = 0; c < 3; ++c)
    {
      kinematics.x[c] = Fad(n_seeds, c, setting.x[c]);
      for (unsigned int A = 0; A < net.cols(); ++A)
        kinematics.positions[A][c] = Fad(n_seeds, 3 + 3 * A + c, net(c, A));
    }
  return kinematics;
}



/** Newton's method for xi_hat on numbers that carry derivatives, until these
 *  have converged as well. Starts at @p xi; returns how far it moved. */
double
solve_slip(const Setting         &setting,
           const Kinematics<Fad> &kinematics,
           std::array<Fad, 2>    &xi,
           Fad                   &g_s)
{
  const std::array<double, 2> start = {{xi[0].val(), xi[1].val()}};
  const std::array<Fad, 2>    xi_old{
    {setting.old_state.xi[0], setting.old_state.xi[1]}};
  const MasterPoint<Fad> old(setting.master, kinematics.positions, xi_old);

  const Kinematics<Local>    fixed = constants(setting);
  const std::array<Local, 2> xi_old_fixed{
    {setting.old_state.xi[0], setting.old_state.xi[1]}};
  const MasterPoint<Local> old_fixed(setting.master,
                                     fixed.positions,
                                     xi_old_fixed);
  for (unsigned int iteration = 0; iteration < 12; ++iteration)
    {
      const std::array<Local, 2> xi_local{
        {Local(2, 0, xi[0].val()), Local(2, 1, xi[1].val())}};
      const MasterPoint<Local>   at_local(setting.master,
                                        fixed.positions,
                                        xi_local);
      Local                      unused;
      const std::array<Local, 2> h_local =
        slip_equations(setting, fixed.x, old_fixed, at_local, unused);
      Eigen::Matrix2d J;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          J(i, j) = h_local[i].dx(j);
      const double determinant = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);

      const MasterPoint<Fad>   at(setting.master, kinematics.positions, xi);
      const std::array<Fad, 2> h =
        slip_equations(setting, kinematics.x, old, at, g_s);
      const Fad step_1 = (J(1, 1) * h[0] - J(0, 1) * h[1]) / determinant;
      const Fad step_2 = (J(0, 0) * h[1] - J(1, 0) * h[0]) / determinant;
      xi[0] -= step_1;
      xi[1] -= step_2;
    }
  return std::hypot(xi[0].val() - start[0], xi[1].val() - start[1]);
}



/** Largest deviations from the reference, relative to its largest entry. */
struct Deviation
{
  double       xi = 0, slip = 0, traction = 0, dt = 0, dforce = 0, by_turn = 0;
  unsigned int n_other_status = 0, n_other_element = 0;
  double       slip_from = 1e9, slip_to = 0, softening = 0;
};

using Matrix = Eigen::MatrixXd;

double
relative_deviation(const Matrix &ours, const Matrix &reference)
{
  const double scale = reference.cwiseAbs().maxCoeff();
  double       worst = 0;
  for (unsigned int k = 0; k < ours.size(); ++k)
    grow(worst, std::abs(ours(k) - reference(k)) / scale);
  return worst;
}

/** What the program says of the derivatives with respect to x and all control
 *  points: chain rule from w. */
void
chain(const ContactPointResult &result,
      const Eigen::Vector2d    &old_gap,
      const unsigned int        n_control_points,
      Matrix                   &dt,
      Matrix                   &dforce)
{
  Matrix dw = Matrix::Zero(W::size, 3 + 3 * n_control_points);
  for (const int gap : {W::gap, W::trial_gap})
    dw.block<3, 3>(gap, 0).setIdentity();
  const auto add_block =
    [&](const int row, const unsigned int A, const double factor) {
      dw.block<3, 3>(row, 3 + 3 * A) += factor * Eigen::Matrix3d::Identity();
    };
  for (unsigned int a = 0; a < result.basis.size; ++a)
    {
      const unsigned int A = result.basis.control_point[a];
      add_block(W::gap, A, -result.basis.N[a]);
      add_block(W::a1, A, result.basis.N_1[a]);
      add_block(W::a2, A, result.basis.N_2[a]);
    }
  if (result.state.status == PointStatus::slip)
    for (unsigned int a = 0; a < result.old_basis.size; ++a)
      {
        const SurfaceBasis &old = result.old_basis;
        add_block(W::trial_gap, old.control_point[a], -old.N[a]);
        add_block(W::old_gap,
                  old.control_point[a],
                  old_gap[0] * old.N_1[a] + old_gap[1] * old.N_2[a]);
      }

  dt               = result.dt * dw;
  const Matrix dxi = result.dxi * dw;
  dforce           = Matrix::Zero(3 * n_control_points, dw.cols());
  for (unsigned int b = 0; b < result.basis.size; ++b)
    dforce.middleRows<3>(3 * result.basis.control_point[b]) =
      result.basis.N[b] * dt +
      result.traction *
        (result.basis.N_1[b] * dxi.row(0) + result.basis.N_2[b] * dxi.row(1));
}

/** The derivatives of traction and g_s by the turn of the point's way against
 *  central differences, relative to the traction's. */
double
deviation_by_turn(const Setting &setting, const ContactPointResult &result)
{
  const double       h = 1e-5;
  ContactPointResult varied[2];
  for (const int i : {0, 1})
    {
      ContactPointMode mode = setting.mode;
      mode.turn += (2 * i - 1) * h;
      update_contact_point(setting.law,
                           setting.old_state,
                           setting.phi_0,
                           setting.x,
                           setting.master,
                           mode,
                           varied[i]);
    }
  const double scale = result.dt.col(W::turn).norm();
  return std::max(((varied[1].traction - varied[0].traction) / (2. * h) -
                   result.dt.col(W::turn))
                      .norm() /
                    scale,
                  setting.law.tangential_penalty *
                    std::abs((varied[1].state.slip - varied[0].state.slip) /
                               (2. * h) -
                             result.dpath[W::turn]) /
                    scale);
}

/** Compares a closed point. */
void
compare(const Setting    &setting,
        const PointStatus expected,
        Deviation        &deviation)
{
  ContactPointResult result;
  update_contact_point(setting.law,
                       setting.old_state,
                       setting.phi_0,
                       setting.x,
                       setting.master,
                       setting.mode,
                       result);
  if (result.failed || result.state.status != expected)
    {
      ++deviation.n_other_status;
      return;
    }

  const Kinematics<Fad> kinematics = seeded(setting);
  std::array<Fad, 2>    xi{{result.state.xi[0], result.state.xi[1]}};
  Fad                   g_s = setting.old_state.slip;
  if (expected == PointStatus::slip)
    grow(deviation.xi, solve_slip(setting, kinematics, xi, g_s));
  else
    grow(deviation.xi, (result.state.xi - setting.old_state.xi).norm());
  grow(deviation.slip, std::abs(result.state.slip - g_s.val()));
  deviation.slip_from = std::min(deviation.slip_from, g_s.val());
  deviation.slip_to   = std::max(deviation.slip_to, g_s.val());
  deviation.softening = std::max(deviation.softening, result.softening);
  deviation.n_other_element +=
    (setting.master.surface->element_of(setting.old_state.xi) !=
     result.basis.element);

  const MasterPoint<Fad> at(setting.master, kinematics.positions, xi);
  const Vector<Fad>      t =
    penalty_traction(setting, Gap<Fad>(setting, kinematics.x, at), at);

  const unsigned int n_cp    = kinematics.positions.size();
  const unsigned int n_seeds = 3 + 3 * n_cp;
  Matrix             traction(3, 1), dt(3, n_seeds);
  Matrix             dforce = Matrix::Zero(3 * n_cp, n_seeds);
  for (unsigned int c = 0; c < 3; ++c)
    {
      traction(c, 0) = t[c].val();
      for (unsigned int k = 0; k < n_seeds; ++k)
        dt(c, k) = t[c].dx(k);
      for (unsigned int B = 0; B < n_cp; ++B)
        {
          const Fad force = at.N[B] * t[c];
          for (unsigned int k = 0; k < n_seeds; ++k)
            dforce(3 * B + c, k) = force.dx(k);
        }
    }
  Matrix our_dt, our_dforce;
  chain(result, setting.old_state.gap, n_cp, our_dt, our_dforce);
  grow(deviation.traction, relative_deviation(result.traction, traction));
  grow(deviation.dt, relative_deviation(our_dt, dt));
  if (setting.law.slip_direction == SlipDirection::integrated)
    grow(deviation.by_turn, deviation_by_turn(setting, result));
  grow(deviation.dforce, relative_deviation(our_dforce, dforce));
}



/** A master of size one with 3 x 3 elements, bumps and a distorted net. */
struct Master
{
  std::string  name;
  NurbsSurface surface;
  ControlNet   positions;

  Master(const std::string &name, const NurbsSurface &surface)
    : name(name)
    , surface(surface)
    , positions(surface.control_points())
  {
    for (unsigned int A = 0; A < positions.cols(); ++A)
      positions.col(A) += Eigen::Vector3d(random_number(-0.03, 0.03),
                                          random_number(-0.03, 0.03),
                                          random_number(-0.07, 0.07));
    positions = (Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, -2, 3).normalized())
                   .toRotationMatrix() *
                 positions)
                  .eval();
  }
};

/** Places x at the given gap from the point @p xi of the master. */
void
place(Setting               &setting,
      const Eigen::Vector2d &xi,
      const double           g_n,
      const double           g_t,
      const double           angle)
{
  SurfaceBasis    basis;
  SurfaceGeometry geometry;
  setting.master.surface->evaluate(xi, basis, false);
  contract(basis, *setting.master.positions, false, geometry);
  const Eigen::Vector3d n =
    setting.master.outward_sign * geometry.a1.cross(geometry.a2).normalized();
  const Eigen::Vector3d e_1 = geometry.a1.normalized();
  const Eigen::Vector3d e_2 = n.cross(e_1);
  setting.old_state.xi      = xi;
  setting.mode.turn         = setting.turn;
  setting.x                 = geometry.y + g_n * n +
              g_t * (std::cos(angle) * e_1 + std::sin(angle) * e_2);
}



/** Runs a setting over places, directions, masters and sides of them. */
void
check(const std::string         &name,
      const std::vector<Master> &masters,
      const Setting             &basic,
      const double               g_n,
      const double               g_t,
      const PointStatus          expected)
{
  std::cout << name << std::endl;
  Deviation deviation;
  for (const Master &master : masters)
    for (const double sign : {1., -1.})
      for (const Eigen::Vector2d &xi : {Eigen::Vector2d(0.21, 0.3),
                                        Eigen::Vector2d(0.5, 0.62),
                                        Eigen::Vector2d(0.71, 0.36),
                                        Eigen::Vector2d(0.33, 0.655)})
        for (unsigned int direction = 0; direction < 5; ++direction)
          {
            Setting setting = basic;
            setting.master  = {&master.surface, &master.positions, sign};
            place(setting, xi, g_n, g_t, 0.2 + 2. * M_PI / 5. * direction);
            compare(setting, expected, deviation);
          }
  report("  all in this state", deviation.n_other_status == 0);
  report("  interacting point solves the equations, deviation",
         deviation.xi,
         1e-13);
  report("  deviation of g_s [mm]", deviation.slip, 1e-13);
  report("  relative deviation of the traction", deviation.traction, 1e-12);
  report("  relative deviation of its derivatives", deviation.dt, 1e-9);
  if (basic.law.slip_direction == SlipDirection::integrated)
    report("  of those by the turn of its way", deviation.by_turn, 1e-6);
  report("  relative deviation of those of the master's forces",
         deviation.dforce,
         1e-9);
  if (expected == PointStatus::slip && !basic.mode.frictionless &&
      basic.law.joint->friction->has_bond())
    {
      const double begin = basic.friction.sliding_threshold;
      const double end   = begin * (1. + 2. * basic.friction.transition_factor);
      std::cout << "  sliding distances "
                << (deviation.slip_to < begin ? "before" :
                    deviation.slip_from > end ? "after" :
                    deviation.slip_from > begin && deviation.slip_to < end ?
                                                "inside" :
                                                "across")
                << " the softening" << std::endl;
    }
  if (deviation.n_other_element > 0)
    std::cout << "  some go to another element" << std::endl;
  if (deviation.softening > 0.)
    report("  it softens, and the solution is unique",
           deviation.softening > 0.05 && deviation.softening < 1.);
}



/** Open points exert nothing, and nothing is learnt from them. */
void
check_open(const std::vector<Master> &masters, const Setting &basic)
{
  std::cout << "Opening" << std::endl;
  bool all_open = true, all_zero = true, all_keep_slip = true;
  for (const Master &master : masters)
    for (const double sign : {1., -1.})
      for (const double g_t : {0., 0.04})
        for (unsigned int direction = 0; direction < 5; ++direction)
          {
            Setting setting = basic;
            setting.master  = {&master.surface, &master.positions, sign};
            place(setting, {0.45, 0.6}, 0.01, g_t, 0.1 + 1.2 * direction);
            ContactPointResult result;
            result.dt.setOnes(); // what an earlier update left behind
            result.dxi.setOnes();
            result.traction.setOnes();
            result.tangential_traction.setOnes();
            result.slip_increment.setOnes();
            result.viscous_traction.setOnes();
            result.pressure = result.softening = 1.;
            update_contact_point(setting.law,
                                 setting.old_state,
                                 setting.phi_0,
                                 setting.x,
                                 setting.master,
                                 setting.mode,
                                 result);
            all_open = all_open && !result.failed &&
                       result.state.status == PointStatus::open &&
                       result.normal_gap > 0.;
            all_zero = all_zero && result.traction.isZero(0.) &&
                       result.tangential_traction.isZero(0.) &&
                       result.viscous_traction.isZero(0.) &&
                       result.pressure == 0. && result.softening == 0. &&
                       result.dt.isZero(0.) && result.dxi.isZero(0.);
            all_keep_slip =
              all_keep_slip && result.state.slip == setting.old_state.slip;
          }
  report("  all open", all_open);
  report("  forces and tangent exactly zero", all_zero);
  report("  damage does not heal", all_keep_slip);
}



/** Stick if and only if eps_t |g_t| <= mu(g_s^n) p at xi_hat^n, right up to the
 *  limit; otherwise |t_t| = mu(g_s) p. */
void
check_honesty(const std::vector<Master> &masters, const Setting &basic)
{
  std::cout << "Stick or slip" << std::endl;
  unsigned int n_stick = 0, n_slip = 0, n_wrong = 0, n_failed = 0;
  double       excess = 0;
  for (unsigned int trial = 0; trial < 2000; ++trial)
    {
      const Master &master   = masters[trial % masters.size()];
      Setting       setting  = basic;
      setting.master         = {&master.surface,
                                &master.positions,
                        trial % 3 ? 1. : -1.};
      setting.old_state.slip = random_number(0., 0.07);
      const Eigen::Vector2d xi(random_number(0.2, 0.8),
                               random_number(0.2, 0.8));
      const double          g_n   = random_number(-0.02, -0.001);
      const double          p     = -setting.eps_n * g_n;
      const double          limit = p *
                           friction_coefficient_at(setting.friction,
                                                   setting.phi_0,
                                                   setting.old_state.slip) /
                           setting.law.tangential_penalty;
      // every other point very close to the limit
      const double g_t = trial % 2 == 0 ? random_number(0., 2. * limit) :
                         trial % 4 == 1 ? limit * (1. + 1e-9) :
                                          limit * (1. - 1e-9);
      place(setting, xi, g_n, g_t, random_number(0., 6.));
      ContactPointResult result;
      update_contact_point(setting.law,
                           setting.old_state,
                           setting.phi_0,
                           setting.x,
                           setting.master,
                           setting.mode,
                           result);
      n_failed += result.failed;
      const bool sticks = result.state.status == PointStatus::stick;
      n_wrong += (sticks != (g_t <= limit));
      n_stick += sticks;
      if (sticks)
        grow(excess,
             result.tangential_traction.norm() /
                 (limit * setting.law.tangential_penalty) -
               1.);
      else if (result.state.status == PointStatus::slip)
        {
          ++n_slip;
          const double t =
            result.pressure * friction_coefficient_at(setting.friction,
                                                      setting.phi_0,
                                                      result.state.slip);
          grow(excess, std::abs(result.tangential_traction.norm() / t - 1.));
        }
    }
  report("  more than 500 points stick and 500 slip",
         n_stick > 500 && n_slip > 500);
  report("  no update failed", n_failed == 0);
  report("  all as the trial traction demands", n_wrong == 0);
  report("  traction on or below the limit, deviation", excess, 1e-11);
}



int
main()
{
  const std::vector<Master> masters = {
    Master("rectangle", NurbsSurface::rectangle(1.2, 1., 3, 3)),
    Master("disk", NurbsSurface::disk(0.6, 3))};

  Setting basic;
  basic.rub_with(modified_coulomb());
  basic.law.tangential_penalty = 250;
  basic.law.slip_direction     = SlipDirection::trial;
  basic.old_state.status       = PointStatus::stick;
  basic.old_state.has_partner  = true;
  const double      g_n        = -0.02;
  const PointStatus slip = PointStatus::slip, stick = PointStatus::stick;

  Setting setting        = basic;
  setting.old_state.slip = 0.01;
  check("Stick", masters, setting, g_n, 0.015, stick);
  setting.mode.stick_first = true;
  check("Stick whatever the traction", masters, setting, g_n, 0.06, stick);

  setting = basic;
  check("Slip, bonded", masters, setting, g_n, 0.04, slip);
  setting.old_state.slip = 0.018;
  check("Slip, softening", masters, setting, g_n, 0.045, slip);
  setting.old_state.slip = 0.035;
  check("Slip that just begins, softening", masters, setting, g_n, 0.025, slip);
  setting.old_state.slip = 0.06;
  check("Slip, broken", masters, setting, g_n, 0.05, slip);
  check("Slip from element to element", masters, setting, g_n, 0.08, slip);

  setting.old_state.slip   = 0.;
  setting.old_state.broken = true;
  check("Slip, bond broken by opening", masters, setting, g_n, 0.035, slip);

  setting                  = basic;
  setting.old_state.status = PointStatus::open;
  setting.old_state.slip   = 0.018;
  check("Closing in stick", masters, setting, g_n, 0.01, stick);
  check("Closing in slip", masters, setting, g_n, 0.045, slip);

  setting = basic;
  setting.set_friction({0.4, 0.4});
  check("Slip, Coulomb", masters, setting, g_n, 0.045, slip);
  setting.set_frictionless();
  check("Frictionless law", masters, setting, g_n, 0.05, slip);
  setting                   = basic;
  setting.old_state.slip    = 0.03;
  setting.mode.frictionless = true;
  check("Frictionless for now", masters, setting, g_n, 0.05, slip);

  setting                        = basic;
  setting.law.tangential_penalty = 1200;
  setting.old_state.slip         = 0.03;
  check("Slip, eps_t > eps_n", masters, setting, g_n, 0.015, slip);

  setting                = basic;
  setting.law.viscosity  = 30;
  setting.mode.duration  = 0.5;
  setting.old_state.slip = 0.018;
  check("Viscous slip, softening", masters, setting, g_n, 0.055, slip);
  setting.set_frictionless();
  check(
    "Frictionless law, no viscosity either", masters, setting, g_n, 0.05, slip);
  setting                = basic;
  setting.old_state.slip = 0.035;
  setting.is_explicit    = true;
  const auto lagging     = std::make_shared<InterfaceLaw>(*setting.law.joint);
  lagging->explicit_friction = true;
  setting.law.joint          = initialised(lagging);
  check("Slip, explicit coefficient", masters, setting, g_n, 0.045, slip);
  setting                    = basic;
  setting.old_state.slip     = 0.018;
  setting.law.slip_direction = SlipDirection::previous_gap;
  setting.old_state.gap      = {0.01, 0.017};
  check("Slip along the previous gap", masters, setting, g_n, 0.045, slip);

  // The gap of the step before has a third to all of the length at which it
  // slides, some 0.028 mm.
  for (const double turn : {0., 0.6, -1.})
    for (const double length : {0.01, 0.017})
      {
        setting                      = basic;
        setting.turn                 = turn;
        setting.law.slip_direction   = SlipDirection::integrated;
        setting.old_state.gap        = {length, -0.5 * length};
        setting.old_pressure         = 11.;
        setting.old_state.normal_gap = -11. / setting.eps_n;
        std::cout << "Gap " << length << ", turn " << turn << std::endl;
        check("Integrated slip, bonded", masters, setting, g_n, 0.05, slip);
        setting.old_state.slip = 0.018;
        check("Integrated slip, softening", masters, setting, g_n, 0.07, slip);
        setting.law.viscosity = 30;
        setting.mode.duration = 0.5;
        check("Integrated slip, viscous", masters, setting, g_n, 0.07, slip);
      }

  for (const bool ageing : {true, false})
    {
      setting                       = basic;
      setting.rate_and_state.ageing = ageing;
      setting.rub_with(setting.rate_and_state.law());
      setting.old_state.internal =
        setting.law.joint->friction->initial_variables;
      setting.rate_and_state.is_used = true;
      setting.mode.duration          = 0.5;
      check(ageing ? "Slip, ageing state" : "Slip, state of the slip law",
            masters,
            setting,
            g_n,
            0.045,
            slip);
      check("Stick, with it", masters, setting, g_n, 0.01, stick);
    }

  setting                = basic;
  setting.old_state.slip = 0.01;
  check_open(masters, setting);
  check_honesty(masters, basic);
}
