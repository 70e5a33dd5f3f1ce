// Exact solutions of contact on half spaces: partial slip in torsion by
// quadrature against closed forms and against an independent computation, its
// tractions against its torque, limits, inverse; Hertz, Cattaneo and Mindlin;
// the wedge; full stick through an elastic layer. The curves in
// prm/verification/data are theirs.

#include <debond/output/torque_curve.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "checks.h"
#include "exact_half_space.h"

using namespace Debond;

constexpr double pi = M_PI;

// Any numbers but one.
constexpr double R = 2.5, G = 6900., mu = 0.3, P = 70.;

double
relative(const double ours, const double expected)
{
  return std::abs(ours / expected - 1.);
}

template <typename Function>
double
integral(const Function &f, const double from, const double to)
{
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
    f, from, to, 10, 1e-10);
}



void
check_uniform_limit()
{
  const double               q = 1.4;
  const TorsionalPartialSlip problem(R, G, uniform_limit(q));
  const double               T_max = uniform_limit_largest_torque(R, q);

  // an independent computation
  const std::vector<std::pair<double, double>> known{{0.9, 0.536879},
                                                     {0.7, 0.824613},
                                                     {0.5, 0.942331},
                                                     {0.3, 0.988216},
                                                     {0.1, 0.999574}};
  double numbers = 0, closed_form = 0, angle = 0, at_angle = 0, inverse = 0;
  for (const auto &[k, ratio] : known)
    {
      const double c     = k * R;
      const double T     = problem.torque_at_stick_radius(c);
      const double theta = uniform_limit_angle(G, R, q, c);
      grow(numbers, std::abs(T / T_max - ratio));
      grow(closed_form, relative(T, uniform_limit_torque(R, q, c)));
      grow(angle, relative(problem.angle_at_stick_radius(c), theta));
      grow(at_angle,
           relative(uniform_limit_torque_at_angle(G, R, q, theta), T));
      grow(inverse, relative(problem.torque(theta), T));
      grow(inverse, relative(problem.stick_radius(theta), c));
    }
  report("uniform: T/T_max against known values", numbers, 1e-6);
  report("uniform: T against the closed form", closed_form, 1e-11);
  report("uniform: theta against the closed form", angle, 1e-11);
  report("uniform: T(theta) against T(c)", at_angle, 1e-11);
  report("uniform: inverse", inverse, 1e-11);
  report("uniform: T_max", relative(problem.largest_torque(), T_max), 1e-11);
  report("uniform: T at a thousand times the angle of T_max/2",
         relative(problem.torque(1000. * q / G), T_max),
         1e-11);
  report("uniform: odd", problem.torque(-1e-4) == -problem.torque(1e-4));
  report("uniform: nothing at rest", problem.torque(0.), 1e-30);
  // T = (1 - O(theta^2)) times full stick
  const double small = 1e-6 * q / G;
  report("uniform: slope at the start is Reissner's and Sagoci's",
         relative(problem.torque(small), reissner_sagoci_torque(G, R, small)),
         1e-10);
}



void
check_singular_and_hertz_limits()
{
  const TorsionalPartialSlip punch(R, G, flat_punch_limit(R, mu, P));
  const TorsionalPartialSlip hertz(R, G, hertz_limit(R, mu, P));
  double                     punch_angle = 0, hertz_angle = 0, by_parts = 0;
  for (const double k : {0.999, 0.9, 0.5, 0.1, 0.001})
    {
      const double c = k * R;
      grow(punch_angle,
           relative(punch.angle_at_stick_radius(c),
                    flat_punch_limit_angle(G, R, mu, P, c)));
      grow(hertz_angle,
           relative(hertz.angle_at_stick_radius(c),
                    hertz_limit_angle(G, R, mu, P, c)));
      // the same torque from the angles alone, as it first comes
      const auto moment = [](const auto &angle) {
        return [angle](const double s) { return s * s * angle(s); };
      };
      for (const auto &[problem, angle] :
           {std::pair<const TorsionalPartialSlip &,
                      std::function<double(double)>>(
              punch,
              [](double s) { return flat_punch_limit_angle(G, R, mu, P, s); }),
            std::pair<const TorsionalPartialSlip &,
                      std::function<double(double)>>(hertz, [](double s) {
              return hertz_limit_angle(G, R, mu, P, s);
            })})
        grow(by_parts,
             relative(problem.torque_at_stick_radius(c),
                      reissner_sagoci_torque(G, c, angle(c)) +
                        16. * G * integral(moment(angle), c, R)));
    }
  report("flat punch: theta against the closed form", punch_angle, 1e-11);
  report("Hertz: theta against Lubkin's", hertz_angle, 1e-9);
  report("T by parts", by_parts, 1e-9);
  report("flat punch: T_max",
         relative(punch.largest_torque(),
                  flat_punch_limit_largest_torque(R, mu, P)),
         1e-11);
  report("Hertz: T_max",
         relative(hertz.largest_torque(), hertz_limit_largest_torque(R, mu, P)),
         1e-11);

  // K(0) = pi/2: a flat punch sticks everywhere up to mu P / (8 G R^2)
  const double first = mu * P / (8. * G * R * R);
  report("flat punch: angle of first slip",
         relative(punch.angle_of_first_slip(), first),
         1e-11);
  report("Hertz slips at once", hertz.angle_of_first_slip(), 1e-30);
  double stick = 0;
  for (const double part : {0.01, 0.5, 0.999})
    grow(stick,
         relative(punch.torque(part * first),
                  reissner_sagoci_torque(G, R, part * first)));
  report("flat punch: full stick is Reissner's and Sagoci's", stick, 1e-11);

  double inverse = 0, slope = 0;
  for (const auto *problem : {&punch, &hertz})
    for (const double k : {0.95, 0.6, 0.2})
      {
        const double theta = problem->angle_at_stick_radius(k * R);
        grow(inverse, relative(problem->stick_radius(theta), k * R));
        const double h = 1e-4 * theta;
        grow(slope,
             relative((problem->torque(theta + h) -
                       problem->torque(theta - h)) /
                        (2. * h),
                      reissner_sagoci_torque(G, k * R, 1.)));
      }
  report("flat punch, Hertz: inverse", inverse, 1e-9);
  report("dT/dtheta = 16/3 G c^3", slope, 1e-6);
}



/** Traction on the contact face: within the limit, continuous, and of the
 *  torque it should have. */
void
check_traction()
{
  double moment = 0, jump = 0, excess = -1e100;
  for (const auto &limit :
       {uniform_limit(1.4), flat_punch_limit(R, mu, P), hertz_limit(R, mu, P)})
    {
      const TorsionalPartialSlip problem(R, G, limit);
      for (const double k : {0.9, 0.5, 0.1})
        {
          const double c        = k * R;
          const auto   traction = [&](const double r) {
            return problem.traction(r, c);
          };
          // r = c sin(phi) and r = R sin(phi): tractions have the slopes and
          // poles of square roots at c and R
          const double inner = integral(
            [&](const double phi) {
              const double r = c * std::sin(phi);
              return r * r * traction(r) * c * std::cos(phi);
            },
            0.,
            pi / 2.);
          const double outer = integral(
            [&](const double phi) {
              const double r = R * std::sin(phi), w = R * std::cos(phi);
              return r * r * limit(r, w) * w;
            },
            std::asin(k),
            pi / 2.);
          grow(moment,
               relative(2. * pi * (inner + outer),
                        problem.torque_at_stick_radius(c)));
          grow(jump, relative(traction(c * (1. - 1e-12)), traction(c)));
          for (const double x : {0.1, 0.5, 0.9, 0.99})
            grow(excess,
                 traction(x * c) /
                     limit(x * c, R * std::sqrt(1. - x * x * k * k)) -
                   1.);
        }
    }
  report("moment of the tractions against T", moment, 1e-8);
  report("jump of the traction at the stick radius", jump, 1e-5);
  report("excess of sticking points over the limit", excess, 0.);
}



void
check_hertz_and_mindlin()
{
  const double E_star =
    contact_modulus(18000, 0.3, std::numeric_limits<double>::infinity(), 0);
  report("E* against a rigid body",
         relative(E_star, 18000 / (1. - 0.09)),
         1e-14);
  report("modulus of a pair",
         relative(shear_modulus_of_pair(2. * G, 2. * G), G),
         1e-14);

  const double       d = 0.01, Rc = 20.;
  const HertzContact hertz(d, Rc, E_star);
  report("Hertz: p_0 = 3 P / (2 pi a^2)",
         relative(hertz.largest_pressure,
                  1.5 * hertz.force / (pi * hertz.radius * hertz.radius)),
         1e-14);
  report("Hertz: P = (16/9 E*^2 Rc d^3)^(1/2)",
         relative(hertz.force, std::sqrt(16. / 9. * Rc * d * d * d) * E_star),
         1e-14);
  report("Hertz: pressure over the area",
         relative(2. * pi *
                    integral(
                      [&](const double phi) {
                        const double r = hertz.radius * std::sin(phi);
                        return r * hertz.pressure(r) * hertz.radius *
                               std::cos(phi);
                      },
                      0.,
                      pi / 2.),
                  hertz.force),
         1e-12);

  CattaneoMindlin mindlin;
  mindlin.mu                    = mu;
  mindlin.force                 = hertz.force;
  mindlin.radius                = hertz.radius;
  mindlin.tangential_compliance = 1.7 / G;
  const double limit            = mu * hertz.force;
  report("Mindlin: half the ring slips at Q = 7/8 mu P",
         relative(mindlin.stick_radius(0.875 * limit), 0.5 * hertz.radius),
         1e-14);
  // full stick: Q = 8 a / compliance delta
  const double small = 1e-6 * limit;
  report("Mindlin: stiffness of full stick",
         relative(mindlin.displacement(small),
                  small * 1.7 / G / (8. * hertz.radius)),
         1e-6);
  double sum = 0;
  for (const double part : {0.2, 0.7, 1.})
    {
      const double Q = part * limit, c = mindlin.stick_radius(Q);
      const double force =
        integral([&](double r) { return r * mindlin.traction(r, Q); }, 0., c) +
        integral([&](double r) { return r * mindlin.traction(r, Q); },
                 c,
                 hertz.radius);
      grow(sum, relative(2. * pi * force, Q));
    }
  report("Mindlin: traction over the area", sum, 1e-6);

  report("wedge: tan a = 0.1, mu = 0.3",
         std::abs(wedge_force_ratio(0.1, 0.3) - 0.412371),
         1e-6);
  report("wedge: up is down mirrored",
         std::abs(wedge_force_ratio(0.1, -0.3) + wedge_force_ratio(-0.1, 0.3)),
         1e-16);
}



/** Full stick through an elastic layer: between bounds that meet for a soft
 *  layer, and Reissner's and Sagoci's value for a stiff one. */
void
check_elastic_layer()
{
  const double rigid = reissner_sagoci_torque(G, R, 1.);
  double       low = -1., high = -1., rises = -1., last = 0.;
  for (const double eps : {1., 100., 1e3, 1e4, 1e5, 1e6, 1e8})
    {
      const double T = reissner_sagoci_torque(G, R, 1., eps);
      // from above: the face below the disk turns like a rigid one
      const double layer = pi / 2. * eps * std::pow(R, 4);
      grow(high, T * (1. / rigid + 1. / layer) - 1.);
      // from below: the traction is proportional to r
      const double traction =
        pi * pi / 4. * std::pow(R, 8) /
        (8. / 15. * std::pow(R, 5) / G + pi / 2. * std::pow(R, 4) / eps);
      grow(low, traction / T - 1.);
      grow(rises, last / T - 1.);
      last = T;
    }
  report("elastic layer: excess over the upper bound", high, 1e-6);
  report("elastic layer: deficit to the lower bound", low, 1e-6);
  report("elastic layer: fall with the stiffness", rises, 0.);
  report("elastic layer: stiff",
         relative(reissner_sagoci_torque(G, R, 1., 1e13), rigid),
         2e-5);
  report("elastic layer: independent of the units",
         relative(reissner_sagoci_torque(8. * G, 0.5 * R, 1., 160000.),
                  reissner_sagoci_torque(G, R, 1., 10000.)),
         1e-12);
  // An independent Galerkin solution: traction r (1 - r^2)^k, 28 terms, with
  // exact Weber-Schafheitlin integrals. Scenes are compared with these values.
  const double bone = 18000. / 2.6, angle = 0.01 * pi / 180.;
  double       galerkin = 0;
  for (const auto &[eps_t, torque] : {std::pair(1e4, 49.0218),
                                      std::pair(1e5, 88.3973),
                                      std::pair(1e6, 98.7987)})
    grow(galerkin,
         relative(reissner_sagoci_torque(bone, 2.5, angle, eps_t), torque));
  report("elastic layer: against a Galerkin solution", galerkin, 2e-5);
}



/** The curves that scenes are compared with. */
void
check_published_curves()
{
  const std::string directory = DEBOND_SOURCE_DIR "/prm/verification/data/";
  const double      bone = 18000. / 2.6, radius = 2.5, q = 0.1;
  const TorsionalPartialSlip problem(radius, bone, uniform_limit(q));
  double                     stick = 0, slip = 0;
  const auto                 stick_rows =
    read_reference_curve(directory + "reissner_sagoci.csv");
  const auto slip_rows =
    read_reference_curve(directory + "torsional_partial_slip.csv");
  for (const auto &[angle, torque] : stick_rows)
    grow(stick,
         std::abs(reissner_sagoci_torque(bone, radius, angle * pi / 180.) -
                  torque));
  for (const auto &[angle, torque] : slip_rows)
    grow(slip, std::abs(problem.torque(angle * pi / 180.) - torque));
  report("reissner_sagoci.csv [N mm]", stick, 1e-9);
  report("torsional_partial_slip.csv [N mm]", slip, 1e-9);
  // this one was computed independently, by the arithmetic-geometric mean
  const TorsionalPartialSlip sphere(0.5, 6300., hertz_limit(0.5, 0.1, 60.));
  const auto sphere_rows = read_reference_curve(directory + "lubkin.csv");
  double     twist       = 0;
  for (const auto &[angle, torque] : sphere_rows)
    grow(twist, std::abs(sphere.torque(angle * pi / 180.) - torque));
  report("lubkin.csv [N mm]", twist, 1e-6);
  report("rows",
         stick_rows.size() == 11 && slip_rows.size() == 26 &&
           sphere_rows.size() == 21);
}



int
main()
{
  check_uniform_limit();
  check_singular_and_hertz_limits();
  check_traction();
  check_hertz_and_mindlin();
  check_elastic_layer();
  check_published_curves();
}
