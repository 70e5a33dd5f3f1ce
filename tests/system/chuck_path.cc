// Steps go straight from state to state: how much of the chuck's path they miss
// when it turns back within a step, or goes along a curve.

#include <debond/bulk/chuck.h>
#include <debond/system/chuck_path.h>

#include <cmath>
#include <iostream>

#include "checks.h"

using namespace Debond;

/** The share missed at the last of @p n_steps, whose times go from 0 to 1. */
double
missed_share(const unsigned int     n_steps,
             const ChuckParameters &parameters,
             const bool             aloud = true)
{
  const Chuck chuck(parameters, Eigen::Vector3d::Zero(), 1.);
  ChuckPath   path(parameters);
  for (unsigned int i = 0; i < n_steps; ++i)
    path.add(chuck, double(i) / n_steps, double(i + 1) / n_steps);
  if (aloud)
    std::cout << "  " << path.describe() << std::endl;
  return path.missed_share();
}



void
check_straight_motion()
{
  std::cout << "straight on, at any speed" << std::endl;
  ChuckParameters parameters;
  parameters.component[0].value  = "t^2";
  parameters.component[1].value  = "-2 * t^2";
  parameters.component[2].loaded = true;
  parameters.component[2].value  = "-50 * t";
  parameters.component[5].value  = "10 * t^3";
  report("  missed", missed_share(3, parameters, false), 1e-14);
}



// The lowest point lies in the middle of the last of 14 steps, of which a
// period has 18; its step and that of the highest point miss
// 2 (1 - cos(pi/18)) each.
void
check_turning_back()
{
  std::cout << "a sine" << std::endl;
  const double    c     = std::cos(M_PI / 18);
  const double    exact = 4 * (1 - c) / (4 - c);
  ChuckParameters parameters;
  for (const bool loaded : {false, true})
    {
      parameters.component[5].loaded = loaded;
      parameters.component[5].value  = "5 * sin(2 * pi * 14 / 18 * t)";
      report("  differs from the exact share",
             std::abs(missed_share(14, parameters) - exact),
             1e-14);
    }
}



// Up for four steps and a 16th of the fifth, then down: it misses an eighth of
// a step of five.
void
check_turning_soon()
{
  std::cout << "a triangle" << std::endl;
  ChuckParameters parameters;
  parameters.component[0].value = "min(t, 1.625 - t)";
  report("  differs from the exact share",
         std::abs(missed_share(5, parameters) - 0.025),
         1e-14);
}



// An interference that comes and goes within each step, which its values at the
// ends do not show: all of its path is missed. One that only grows misses
// nothing.
void
check_interference()
{
  std::cout << "an interference" << std::endl;
  const ChuckParameters at_rest;
  const Chuck           chuck(at_rest, Eigen::Vector3d::Zero(), 1.);
  ChuckPath             to_and_fro(at_rest), growing(at_rest);
  for (const double begin : {0., 1., 2.})
    {
      to_and_fro.add(chuck, begin, begin + 1., [](const double t) {
        return 0.02 * std::abs(t - std::floor(t + 0.5));
      });
      growing.add(chuck, begin, begin + 1., [](const double t) {
        return 0.02 * t * t;
      });
    }
  std::cout << "  " << to_and_fro.describe() << std::endl;
  report("  differs from the exact share",
         std::abs(to_and_fro.missed_share() - 1.),
         1e-14);
  report("  missed where it grows", growing.missed_share(), 1e-14);
}



// Chords of a circle in 12 steps, and of 32 times as many; of a larger number,
// which is as many as it takes.
void
check_curve(const unsigned int component)
{
  std::cout << "a circle" << std::endl;
  ChuckParameters parameters;
  parameters.component[component].value     = "3 * cos(2 * pi * t)";
  parameters.component[component + 1].value = "3 * sin(2 * pi * t)";
  report("  differs from the exact share",
         std::abs(missed_share(12, parameters) -
                  (1 - std::sin(M_PI / 12) / (32 * std::sin(M_PI / 384)))),
         1e-14);
  report("  23 steps miss too much", missed_share(23, parameters) > 0);
  report("  24 do not", missed_share(24, parameters, false) == 0);
}



int
main()
{
  check_straight_motion();
  check_turning_back();
  check_turning_soon();
  check_interference();
  check_curve(0); // translations
  check_curve(3); // tilts
}
