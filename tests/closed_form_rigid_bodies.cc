// Torque of two rigid bodies on the elastic frictional interface: the values of
// an independent computation, the elementary formula of a constant friction
// coefficient, the balance of stick, slip and traction point by point.

#include <debond/closed_forms.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <cmath>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

using namespace Debond;

constexpr double pi     = dealii::numbers::PI;
constexpr double degree = pi / 180.;

void
report(const std::string &what, const double deviation, const double limit)
{
  std::cout << what << " below " << limit << ": ";
  if (deviation < limit) // false for NaN as well
    std::cout << "yes" << std::endl;
  else
    std::cout << "NO, " << deviation << std::endl;
}



/** Keeps a NaN once there is one, which std::max would not. */
void
keep_largest(double &largest, const double value)
{
  if (!std::isnan(largest) && !(value <= largest))
    largest = value;
}



RigidBodiesTorsion::Parameters
paper()
{
  RigidBodiesTorsion::Parameters parameters;
  parameters.radius             = 2.5;
  parameters.normal_penalty     = 585;
  parameters.tangential_penalty = 585;
  parameters.push_in            = 2.6 / 585;
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
elementary_torque(const RigidBodiesTorsion::Parameters &parameters,
                  const double                          mu,
                  const double                          theta)
{
  const double p = parameters.normal_penalty * parameters.push_in;
  const double R = parameters.radius;
  const double c = mu * p / (parameters.tangential_penalty * theta);
  return c >= R ?
           pi / 2. * parameters.tangential_penalty * theta * std::pow(R, 4) :
           2. / 3. * pi * mu * p * (std::pow(R, 3) - std::pow(c, 3) / 4.);
}



void
check_constant_friction()
{
  // Three ways to make the coefficient constant, with unequal penalties.
  auto coulomb               = paper();
  coulomb.normal_penalty     = 1200;
  coulomb.tangential_penalty = 300;
  coulomb.friction.kind      = FrictionLawKind::coulomb;
  auto equal                 = coulomb;
  equal.friction.kind        = FrictionLawKind::modified_coulomb;
  equal.friction.mu_unbroken = equal.friction.mu_broken;
  auto unbonded              = coulomb;
  unbonded.friction.kind     = FrictionLawKind::modified_coulomb;
  unbonded.phi_0             = 0;

  double largest = 0;
  for (const auto &parameters : {coulomb, equal, unbonded})
    {
      const RigidBodiesTorsion problem(parameters);
      for (const double angle : {0.01, 0.1, 0.163, 0.17, 0.5, 1., 10., 360.})
        {
          const double expected =
            elementary_torque(parameters, 0.4, angle * degree);
          keep_largest(largest,
                       std::abs(problem.torque(angle * degree) / expected -
                                1.));
        }
    }
  report("relative deviation from the elementary formula", largest, 1e-12);

  auto frictionless          = paper();
  frictionless.friction.kind = FrictionLawKind::frictionless;
  report("torque without friction",
         std::abs(RigidBodiesTorsion(frictionless).torque(degree)),
         1e-12);
}



void
check_points()
{
  const auto               parameters = paper();
  const RigidBodiesTorsion problem(parameters);
  const double             p         = problem.pressure();
  double                   worst_sum = 0, worst_law = 0, worst_excess = 0;
  for (unsigned int i = 1; i <= 25; ++i)
    for (const double angle : {0.03, 0.1, 0.4, 0.8, 1.1, 2., 9.})
      {
        const double r = 0.1 * i, theta = angle * degree;
        const double slip = problem.slip(r, theta);
        const double t    = problem.traction(r, theta);
        keep_largest(worst_sum,
                     std::abs(slip + t / parameters.tangential_penalty -
                              r * theta));
        const double mu =
          friction_coefficient(parameters.friction, 1., slip).mu;
        if (slip > 0)
          keep_largest(worst_law, std::abs(t - mu * p));
        else
          keep_largest(worst_excess, t - mu * p);
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
  auto soft                 = paper();
  soft.tangential_penalty   = 2.6 / 0.115;
  auto softer               = paper();
  softer.tangential_penalty = 2.6 / 0.1153;
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



int
main()
{
  check_known_values();
  check_constant_friction();
  check_points();
  check_uniqueness();
}
