#include "exact_half_space.h"

#include <deal.II/base/numbers.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/tools/roots.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace Debond
{
  namespace
  {
    constexpr double pi = dealii::numbers::PI;

    /** sqrt(b^2 - a^2) without cancellation, 0 for a > b. */
    double
    leg(const double b, const double a)
    {
      return std::sqrt(std::max(0., (b - a) * (b + a)));
    }

    template <typename Integrand>
    double
    integral(const Integrand &f, const double from, const double to)
    {
      constexpr unsigned int deepest_bisection = 12;
      return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
        f, from, to, deepest_bisection, 1e-12);
    }
  } // namespace



  double
  shear_modulus_of_pair(const double shear_modulus_1,
                        const double shear_modulus_2)
  {
    return 1. / (1. / shear_modulus_1 + 1. / shear_modulus_2);
  }



  double
  contact_modulus(const double young_modulus_1,
                  const double poisson_ratio_1,
                  const double young_modulus_2,
                  const double poisson_ratio_2)
  {
    return 1. / ((1. - poisson_ratio_1 * poisson_ratio_1) / young_modulus_1 +
                 (1. - poisson_ratio_2 * poisson_ratio_2) / young_modulus_2);
  }



  double
  reissner_sagoci_torque(const double shear_modulus,
                         const double radius,
                         const double angle)
  {
    return 16. / 3. * shear_modulus * std::pow(radius, 3) * angle;
  }



  namespace
  {
    /** The torque through an elastic layer over 16/3 G R^3 theta, with
     *  compliance = G / (eps_t R), on n intervals. */
    double
    torque_through_layer(const double compliance, const unsigned int n)
    {
      const auto towards_edge = [n](const double i) {
        return 1. - std::pow(1. - i / n, 4);
      };
      // integral of 2/pi [asin x - x sqrt(1 - x^2)]
      const auto outside = [](const double x) {
        const double y = leg(1., x);
        return 2. / pi * (x * std::asin(x) + y + y * y * y / 3.);
      };
      Eigen::MatrixXd A(n, n);
      Eigen::VectorXd cubes(n); // int s^3 ds
      for (unsigned int j = 0; j < n; ++j)
        {
          const double from = towards_edge(j), to = towards_edge(j + 1);
          cubes[j] = (std::pow(to, 4) - std::pow(from, 4)) / 4.;
          for (unsigned int i = 0; i < n; ++i)
            {
              const double r    = towards_edge(i + 0.5);
              const double low  = std::max(from, r) / r;
              const double high = std::max(to, r) / r;
              A(i, j) =
                r * (high - low) +
                4. / pi * compliance * (std::acosh(high) - std::acosh(low)) +
                r * (outside(std::min(to, r) / r) -
                     outside(std::min(from, r) / r));
            }
        }
      const Eigen::VectorXd g =
        A.partialPivLu().solve(Eigen::VectorXd::Ones(n));
      return cubes.dot(g);
    }
  } // namespace



  double
  reissner_sagoci_torque(const double shear_modulus,
                         const double radius,
                         const double angle,
                         const double tangential_penalty)
  {
    const double compliance = shear_modulus / (tangential_penalty * radius);
    // the error falls like n^(-3/2)
    const double coarse = torque_through_layer(compliance, 150);
    const double fine   = torque_through_layer(compliance, 300);
    return (fine + (fine - coarse) / (std::pow(2., 1.5) - 1.)) *
           reissner_sagoci_torque(shear_modulus, radius, angle);
  }



  TorsionalPartialSlip::TorsionalPartialSlip(const double radius,
                                             const double shear_modulus,
                                             const Limit &limit)
    : R(radius)
    , G(shear_modulus)
    , q(limit)
  {}



  double
  TorsionalPartialSlip::integrate(
    const double                                 c,
    const double                                 scale,
    const std::function<double(double, double)> &f) const
  {
    // With x = sqrt(r^2 - c^2) and X = sqrt(R^2 - c^2) the integral is that of
    // f q / r dx over 0 < x < X. The lower bound keeps q X finite in the limit
    // c = R.
    const double X          = std::max(leg(R, c), 1e-50 * R);
    const auto   f_q_over_r = [&](const double x, const double to_edge) {
      const double r = std::hypot(c, x);
      return f(r, x) * q(r, to_edge) / r;
    };
    // Near c x = scale sinh(v), which resolves what varies over the scale, near
    // R x = X sin(phi), where q dx is regular.
    const double middle = scale > 0. ? std::sqrt(0.5) : 0.;
    const double inner =
      scale > 0. ? integral(
                     [&](const double v) {
                       const double x = scale * std::sinh(v);
                       return f_q_over_r(x, leg(X, x)) * scale * std::cosh(v);
                     },
                     0.,
                     std::asinh(middle * X / scale)) :
                   0.;
    const double outer = integral(
      [&](const double phi) {
        const double to_edge = X * std::cos(phi);
        return f_q_over_r(X * std::sin(phi), to_edge) * to_edge;
      },
      std::asin(middle),
      pi / 2.);
    return inner + outer;
  }



  double
  TorsionalPartialSlip::angle_at_stick_radius(const double c) const
  {
    return integrate(c, c, [](double, double) { return 1.; }) / (2. * G);
  }



  double
  TorsionalPartialSlip::torque_at_stick_radius(const double c) const
  {
    return 4. * integrate(c, c, [c](const double r, const double from_stick) {
             return 2. / 3. * c * c * c +
                    from_stick *
                      (r * r * std::atan2(from_stick, c) + c * from_stick);
           });
  }



  double
  TorsionalPartialSlip::traction(const double r, const double c) const
  {
    if (r >= c)
      return q(r, leg(R, r));
    const double inside = leg(c, r);
    return 2. / pi * r * inside *
           integrate(c, inside, [inside](double, const double from_stick) {
             return 1. / (inside * inside + from_stick * from_stick);
           });
  }



  double
  TorsionalPartialSlip::largest_torque() const
  {
    return torque_at_stick_radius(0.);
  }



  double
  TorsionalPartialSlip::angle_of_first_slip() const
  {
    return angle_at_stick_radius(R);
  }



  double
  TorsionalPartialSlip::stick_radius(const double theta) const
  {
    if (theta <= angle_of_first_slip())
      return R;
    // where q(0) > 0 the angle grows like -log(c)
    const double smallest = std::log(1e-8);
    const auto   excess   = [&](const double log_k) {
      return angle_at_stick_radius(R * std::exp(log_k)) - theta;
    };
    const double at_smallest = excess(smallest);
    if (at_smallest <= 0.)
      return 0.;
    std::uintmax_t max_iterations = 200;
    const auto     bracket        = boost::math::tools::toms748_solve(
      excess,
      smallest,
      0.,
      at_smallest,
      angle_of_first_slip() - theta,
      boost::math::tools::eps_tolerance<double>(),
      max_iterations);
    return R * std::exp(0.5 * (bracket.first + bracket.second));
  }



  double
  TorsionalPartialSlip::torque(const double theta) const
  {
    const double angle = std::abs(theta);
    const double c     = stick_radius(angle);
    double       T     = torque_at_stick_radius(c);
    // dT/dtheta = 16/3 G c^3 makes up for what the root lacks, and for all of
    // the angle before slip begins
    if (c > 0.)
      T += reissner_sagoci_torque(G, c, angle - angle_at_stick_radius(c));
    return std::copysign(T, theta);
  }



  TorsionalPartialSlip::Limit
  uniform_limit(const double q)
  {
    return [q](double, double) { return q; };
  }



  TorsionalPartialSlip::Limit
  flat_punch_limit(const double radius, const double mu, const double force)
  {
    const double factor = mu * force / (2. * pi * radius);
    return [factor](double, const double to_edge) { return factor / to_edge; };
  }



  TorsionalPartialSlip::Limit
  hertz_limit(const double radius, const double mu, const double force)
  {
    const double factor = 3. * mu * force / (2. * pi * std::pow(radius, 3));
    return [factor](double, const double to_edge) { return factor * to_edge; };
  }



  double
  uniform_limit_angle(const double shear_modulus,
                      const double radius,
                      const double q,
                      const double c)
  {
    return q / (2. * shear_modulus) * std::acosh(radius / c);
  }



  double
  uniform_limit_torque(const double radius, const double q, const double c)
  {
    const double k = c / radius, k_prime = leg(radius, c) / radius;
    return 4. / 3. * q * std::pow(radius, 3) *
           (std::atan2(k_prime, k) + k * k_prime);
  }



  double
  uniform_limit_torque_at_angle(const double shear_modulus,
                                const double radius,
                                const double q,
                                const double angle)
  {
    // k = 1/cosh(x), k' = tanh(x)
    const double x = 2. * shear_modulus * angle / q;
    return 4. / 3. * q * std::pow(radius, 3) *
           (std::atan(std::sinh(x)) + std::tanh(x) / std::cosh(x));
  }



  double
  uniform_limit_largest_torque(const double radius, const double q)
  {
    return 2. / 3. * pi * q * std::pow(radius, 3);
  }



  double
  flat_punch_limit_angle(const double shear_modulus,
                         const double radius,
                         const double mu,
                         const double force,
                         const double c)
  {
    // Boost takes the modulus k', not the parameter k'^2
    return mu * force / (4. * pi * shear_modulus * radius * radius) *
           boost::math::ellint_1(leg(radius, c) / radius);
  }



  double
  flat_punch_limit_largest_torque(const double radius,
                                  const double mu,
                                  const double force)
  {
    return pi / 4. * mu * force * radius;
  }



  double
  hertz_limit_angle(const double shear_modulus,
                    const double radius,
                    const double mu,
                    const double force,
                    const double c)
  {
    const double k_prime = leg(radius, c) / radius;
    return 3. * mu * force / (4. * pi * shear_modulus * radius * radius) *
           (boost::math::ellint_1(k_prime) - boost::math::ellint_2(k_prime));
  }



  double
  hertz_limit_largest_torque(const double radius,
                             const double mu,
                             const double force)
  {
    return 3. * pi / 16. * mu * force * radius;
  }



  HertzContact::HertzContact(const double approach,
                             const double curvature_radius,
                             const double modulus)
    : radius(std::sqrt(curvature_radius * approach))
    , force(4. / 3. * modulus * radius * approach)
    , largest_pressure(2. / pi * modulus *
                       std::sqrt(approach / curvature_radius))
  {}



  double
  HertzContact::pressure(const double r) const
  {
    return largest_pressure * leg(radius, r) / radius;
  }



  double
  CattaneoMindlin::stick_radius(const double tangential_force) const
  {
    return radius *
           std::cbrt(std::max(0., 1. - tangential_force / (mu * force)));
  }



  double
  CattaneoMindlin::displacement(const double tangential_force) const
  {
    const double k = stick_radius(tangential_force) / radius;
    return 3. * mu * force / (16. * radius) * tangential_compliance *
           (1. - k * k);
  }



  double
  CattaneoMindlin::traction(const double r, const double tangential_force) const
  {
    // mu p of the whole contact less that of the disk that sticks
    const double c     = stick_radius(tangential_force);
    const double scale = 3. * mu * force / (2. * pi * std::pow(radius, 3));
    return scale * (leg(radius, r) - leg(c, r));
  }



  double
  wedge_force_ratio(const double slope, const double mu)
  {
    return (slope + mu) / (1. - mu * slope);
  }
} // namespace Debond
