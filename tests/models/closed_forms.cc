// The closed forms of torsion. Two rigid bodies on the elastic frictional
// interface: the values of an independent computation, the elementary formula
// of a constant friction coefficient, the balance of stick, slip and traction
// point by point, a bonded disk inside an unbonded ring. The paper's analytical
// model against its integral done by hand. Mathieu's model: its torque against
// the integral of its traction, its limits.

#include <debond/interface/modified_coulomb.h>
#include <debond/models/closed_forms.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <boost/math/quadrature/gauss.hpp>

#include <cmath>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "checks.h"

using namespace Debond;

constexpr double pi     = dealii::numbers::PI;
constexpr double degree = pi / 180.;

TorsionModel::Disk
paper()
{
  TorsionModel::Disk parameters;
  parameters.radius    = 2.5;
  parameters.pressure  = 2.6;
  parameters.stiffness = 585;
  return parameters; // friction: the defaults, 0.58/0.40, 0.022 mm, 0.74
}



void
check_known_values()
{
  const RigidBodiesTorsion                     problem(paper());
  const std::vector<std::pair<double, double>> known{{0.05, 31.3244},
                                                     {0.1, 46.8053},
                                                     {0.2, 49.0312},
                                                     {0.6, 49.3320},
                                                     {1, 45.4386},
                                                     {1.5, 37.9623},
                                                     {2, 35.6912},
                                                     {10, 34.0472}};
  for (const auto &[angle, torque] : known)
    report("deviation [N mm] at " + std::to_string(angle) + " degrees",
           std::abs(problem.torque(angle * degree) - torque),
           1e-4);
  report("deviation from an odd function",
         std::abs(problem.torque(-degree) + problem.torque(degree)),
         1e-12);
}



/** T = 2/3 pi mu p (R^3 - c^3 / 4), c = mu p / (eps_t theta) the radius inside
 *  which points stick; 1/2 pi eps_t theta R^4 while all of them do. */
double
elementary_torque(const TorsionModel::Disk &parameters,
                  const double              mu,
                  const double              theta)
{
  const double p = parameters.pressure;
  const double R = parameters.radius;
  const double c = mu * p / (parameters.stiffness * theta);
  return c >= R ?
           pi / 2. * parameters.stiffness * theta * std::pow(R, 4) :
           2. / 3. * pi * mu * p * (std::pow(R, 3) - std::pow(c, 3) / 4.);
}



void
check_constant_friction()
{
  // Three ways to make the coefficient constant, with unequal penalties.
  auto coulomb      = paper();
  coulomb.pressure  = 1200 * 2.6 / 585;
  coulomb.stiffness = 300;
  coulomb.friction  = modified_coulomb({0.4, 0.4});
  auto equal        = coulomb;
  equal.friction    = modified_coulomb({0.4, 0.4});
  auto unbonded     = coulomb;
  unbonded.friction = modified_coulomb();
  unbonded.phi_0    = 0;

  double largest = 0;
  for (const auto &parameters : {coulomb, equal, unbonded})
    {
      const RigidBodiesTorsion problem(parameters);
      for (const double angle : {0.01, 0.1, 0.163, 0.17, 0.5, 1., 10., 360.})
        {
          const double expected =
            elementary_torque(parameters, 0.4, angle * degree);
          grow(largest,
               std::abs(problem.torque(angle * degree) / expected - 1.));
        }
    }
  report("relative deviation from the elementary formula", largest, 1e-12);

  auto frictionless = paper();
  frictionless.friction =
    Debond::modified_coulomb({}, Debond::ModifiedCoulomb::Coefficients::none);
  report("torque without friction",
         std::abs(RigidBodiesTorsion(frictionless).torque(degree)),
         1e-12);
}



void
check_points()
{
  const auto               parameters = paper();
  const RigidBodiesTorsion problem(parameters);
  const double             p         = problem.disk.pressure;
  double                   worst_sum = 0, worst_law = 0, worst_excess = 0;
  for (unsigned int i = 1; i <= 25; ++i)
    for (const double angle : {0.03, 0.1, 0.4, 0.8, 1.1, 2., 9.})
      {
        const double r = 0.1 * i, theta = angle * degree;
        const double slip = problem.slip(r, theta);
        const double t    = problem.point(r, theta).traction;
        grow(worst_sum, std::abs(slip + t / parameters.stiffness - r * theta));
        const double mu = parameters.friction->coefficient({1., {slip}}, 0.).mu;
        if (slip > 0)
          grow(worst_law, std::abs(t - mu * p));
        else
          grow(worst_excess, t - mu * p);
      }
  report("deviation of slip and elastic path from r theta [mm]",
         worst_sum,
         1e-14);
  report("deviation of sliding points from the friction law [MPa]",
         worst_law,
         1e-11);
  report("excess of sticking points over the friction law [MPa]",
         worst_excess,
         1e-12);
}



void
check_uniqueness()
{
  // p / eps_t must be below 4 a_s b_s / (pi phi_0 (mu_ub - mu_b)) = 0.11516 mm.
  auto soft        = paper();
  soft.stiffness   = 2.6 / 0.115;
  auto softer      = paper();
  softer.stiffness = 2.6 / 0.1153;
  std::cout << "solution unique just below the bound: "
            << (RigidBodiesTorsion::has_unique_solution(soft) ? "yes" : "NO")
            << std::endl
            << "solution not unique just above it: "
            << (RigidBodiesTorsion::has_unique_solution(softer) ? "NO" : "yes")
            << std::endl;
  try
    {
      RigidBodiesTorsion problem(softer);
      std::cout << "refused: NO" << std::endl;
    }
  catch (const dealii::ExceptionBase &)
    {
      std::cout << "refused: yes" << std::endl;
    }
}



/** A bonded disk in an unbonded ring: the difference of two disks. */
void
check_bonded_disk()
{
  auto mixed            = paper();
  mixed.bonded_radius   = 1.7;
  auto bonded           = paper();
  auto unbonded         = paper();
  unbonded.phi_0        = 0;
  auto inner_bonded     = bonded;
  auto inner_unbonded   = unbonded;
  inner_bonded.radius   = 1.7;
  inner_unbonded.radius = 1.7;
  double largest        = 0;
  for (const double angle : {0.02, 0.1, 0.3, 0.7, 1.2, 2.5, 8.})
    grow(largest,
         std::abs(RigidBodiesTorsion(mixed).torque(angle * degree) -
                  (RigidBodiesTorsion(unbonded).torque(angle * degree) -
                   RigidBodiesTorsion(inner_unbonded).torque(angle * degree) +
                   RigidBodiesTorsion(inner_bonded).torque(angle * degree))));
  report("bonded disk against the sum of its parts [N mm]", largest, 1e-11);
}



/** Eq. (18) with a constant coefficient: 2/3 pi t_max (R^3 - c^3/4). With the
 *  modified law beyond theta_max the numbers of tests/verification/
 *  closed_form_b.prm, which says where they are from. */
void
check_prescribed_angles()
{
  TorsionModel::Disk disk;
  disk.radius   = 2.5;
  disk.pressure = 2.8113;
  const auto form =
    prescribed_angles_torsion(disk, 0.13 * degree, 1.13 * degree);
  double largest = 0;
  for (const double angle : {0.05, 0.13, 0.2, 0.8, 1.12})
    {
      const double c     = 2.5 * std::min(1., 0.13 / angle);
      const double t_max = 0.58 * 2.8113;
      const double T =
        angle < 0.13 ?
          pi / 2 * std::pow(2.5, 3) * t_max * angle / 0.13 :
          2. / 3. * pi * t_max * (std::pow(2.5, 3) - std::pow(c, 3) / 4.);
      grow(largest, std::abs(form->torque(angle * degree) / T - 1.));
    }
  report("Eq. (18) before full sliding, relative", largest, 1e-12);
  report("Eq. (18), T_inf at 10 degrees [N mm]",
         std::abs(form->torque(10 * degree) - 36.82),
         0.005);
  report("Eq. (18), its largest torque [N mm]",
         std::abs(form->torque(1.51 * degree) - 53.35),
         0.005);
}



void
check_crack()
{
  TorsionModel::Disk disk;
  disk.radius      = 2.5;
  const auto form  = crack_torsion(disk, 40, 0.07, 1.1);
  const auto angle = [](const double c) { // Eq. (14)
    return std::sqrt(pi * 0.07 / (4. * c * 40)) +
           1.1 / (2. * 40) * std::acosh(2.5 / c);
  };
  double inverse = 0, torque = 0;
  for (const double c : {2.4, 2., 1.3, 0.6, 0.1})
    {
      const double theta = angle(c);
      grow(inverse, std::abs(form->stick_radius(theta) / c - 1.));
      // r = c sin(s) takes the singularity at the tip away
      const double inside =
        boost::math::quadrature::gauss<double, 30>::integrate(
          [&](const double s) {
            const double r = c * std::sin(s);
            return r * r * form->point(r, theta).traction * c * std::cos(s);
          },
          0.,
          pi / 2);
      const double outside = 1.1 * (std::pow(2.5, 3) - std::pow(c, 3)) / 3.;
      grow(torque,
           std::abs(form->torque(theta) / (2 * pi * (inside + outside)) - 1.));
    }
  report("Eq. (14) and its inverse, relative", inverse, 1e-12);
  report("Eq. (37) of Eqs. (15) and (16), relative", torque, 1e-9);
  const double start = angle(2.5);
  report("Reissner-Sagoci before the crack, relative",
         std::abs(form->torque(start / 3) /
                    (16. / 3. * 40 * std::pow(2.5, 3) * start / 3) -
                  1.),
         1e-14);
  report("torque continuous where the crack starts, relative",
         std::abs(form->torque(start * (1 + 1e-9)) / form->torque(start) - 1.),
         1e-4);
  report("torque of a nearly broken bond, relative",
         std::abs(form->torque(1e3) / (2. / 3. * pi * 1.1 * std::pow(2.5, 3)) -
                  1.),
         1e-3);
}



int
main()
{
  check_known_values();
  check_constant_friction();
  check_points();
  check_uniqueness();
  check_bonded_disk();
  check_prescribed_angles();
  check_crack();
}
