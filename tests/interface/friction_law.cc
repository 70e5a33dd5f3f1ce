// The friction coefficient follows Eqs. (11) and (13): bonded up to a_s, half a
// sine down, broken beyond (1 + 2 b_s) a_s; its derivative is that of central
// differences, its integral that of Simpson's rule.

#include <debond/interface/modified_coulomb.h>

#include <string>

#include "checks.h"

using namespace Debond;

/** Eqs. (11) and (13), written anew. */
double
mu(const ModifiedCoulombParameters &parameters,
   const double                     phi_0,
   const double                     g_s)
{
  const double x = g_s / parameters.sliding_threshold;
  const double b = parameters.transition_factor;
  double       s = 0.5 - 0.5 * std::sin(M_PI / (2. * b) * (x - b - 1.));
  if (x <= 1.)
    s = 1.;
  if (x >= 1. + 2. * b)
    s = 0.;
  const double phi = phi_0 * s;
  return phi * parameters.mu_unbroken + (1. - phi) * parameters.mu_broken;
}



void
check(const std::string               &name,
      const ModifiedCoulombParameters &parameters,
      const double                     phi_0)
{
  std::cout << name << std::endl;
  const auto   law   = modified_coulomb(parameters);
  const double a_s   = parameters.sliding_threshold;
  const double end   = a_s * (1. + 2. * parameters.transition_factor);
  double       value = 0, bond = 0, derivative = 0;
  for (unsigned int k = 0; k <= 1000; ++k)
    {
      const double g_s    = 1.5 * end * k / 1000.;
      const auto   result = law->coefficient({phi_0, {g_s}}, 0.);
      grow(value, std::abs(result.mu - mu(parameters, phi_0, g_s)));
      grow(bond,
           std::abs(result.mu - (result.phi * parameters.mu_unbroken +
                                 (1. - result.phi) * parameters.mu_broken)));
      // derivatives are continuous: only the second one jumps at the kinks
      const double step = 1e-6 * a_s;
      grow(derivative,
           a_s * std::abs(result.dmu -
                          (law->coefficient({phi_0, {g_s + step}}, 0.).mu -
                           law->coefficient({phi_0, {g_s - step}}, 0.).mu) /
                            (2. * step)));
    }
  for (const double kink : {a_s, end})
    for (double distance = 0.1; distance > 1e-13; distance *= 0.1)
      for (const double sign : {-1., 1.})
        {
          const double g_s = kink * (1. + sign * distance);
          grow(value,
               std::abs(law->coefficient({phi_0, {g_s}}, 0.).mu -
                        mu(parameters, phi_0, g_s)));
        }
  report("  deviation of mu", value, 1e-14);
  report("  deviation of mu from what phi says", bond, 1e-14);
  report("  deviation of a_s dmu/dg_s", derivative, 1e-8);

  const auto at = [&](const double g_s) {
    return law->coefficient({phi_0, {g_s}}, 0.);
  };
  report("  bonded up to a_s",
         at(0.).phi == phi_0 && at(a_s).phi == phi_0 &&
           at(0.99 * a_s).dmu == 0.);
  report("  less right after",
         at(a_s * (1. + 1e-3)).phi < phi_0 && at(a_s * (1. + 1e-3)).dmu < 0.);
  report("  half at (1 + b_s) a_s, deviation",
         std::abs(at(0.5 * (a_s + end)).phi - 0.5 * phi_0),
         1e-14);
  report("  not yet broken right before (1 + 2 b_s) a_s",
         at(end * (1. - 1e-3)).phi > 0. && at(end * (1. - 1e-3)).dmu < 0.);
  report("  broken from (1 + 2 b_s) a_s on",
         std::abs(at(end * (1. + 1e-15)).phi) +
           std::abs(at(end * (1. + 1e-12)).phi) + at(100. * end).phi +
           std::abs(at(end * (1. + 1e-12)).dmu),
         1e-14);
  report("  no jump at the kinks",
         std::abs(at(a_s * (1. - 1e-9)).mu - at(a_s * (1. + 1e-9)).mu) +
           std::abs(at(end * (1. - 1e-9)).mu - at(end * (1. + 1e-9)).mu),
         1e-14);

  double deviation = 0;
  for (const unsigned int first : {0, 300, 700, 850, 1001})
    {
      double steepest = 0;
      for (unsigned int k = first; k <= 1001; ++k)
        steepest = std::max(steepest, -at(end * k / 1000.).dmu);
      grow(deviation,
           std::abs(law->steepest_fall({phi_0, {end * first / 1000.}}, 1.) -
                    steepest) /
             law->steepest_fall({phi_0}, 1.));
    }
  report("  steepest fall that is left, relative deviation", deviation, 1e-5);

  double integral = 0;
  for (const double from : {0., 0.4 * a_s, 1.3 * a_s, 0.9 * end, 1.1 * end})
    for (const double to : {0.6 * a_s, 1.2 * a_s, 0.95 * end, 1.4 * end})
      {
        double             sum = 0;
        const unsigned int n   = 4000;
        for (unsigned int k = 0; k <= n; ++k)
          sum += (k == 0 || k == n ? 1. :
                  k % 2 == 1       ? 4. :
                                     2.) *
                 (mu(parameters, phi_0, from + (to - from) * k / n) -
                  parameters.mu_broken);
        sum *= (to - from) / (3. * n);
        grow(integral,
             std::abs(law->work({phi_0, {from}}, 1., to - from).friction -
                      parameters.mu_broken * (to - from) - sum) /
               a_s);
      }
  report("  deviation of the integral of mu - mu_b, in a_s", integral, 1e-8);
}



int
main()
{
  ModifiedCoulombParameters parameters;
  check("Values of the paper", parameters, 1.);
  check("Partly bonded", parameters, 0.37);
  parameters.transition_factor = 1.86;
  parameters.sliding_threshold = 0.026;
  check("Values of the second data set", parameters, 1.);

  const double mu_b     = ModifiedCoulombParameters().mu_broken;
  const auto   coulomb  = modified_coulomb({mu_b, mu_b});
  const auto   constant = coulomb->coefficient({1., {0.01}}, 0.02);
  report("Coulomb: mu_b everywhere",
         constant.mu == mu_b && constant.dmu == 0. &&
           coulomb->coefficient({}, 0.).mu == mu_b &&
           coulomb->steepest_fall({}, 1.) == 0. &&
           coulomb->work({}, 1., 1.).friction == mu_b);
  report("  its bond still decays",
         coulomb->coefficient({}, 0.).phi == 1. &&
           coulomb->coefficient({}, 1.).phi == 0.);
  const auto none = modified_coulomb({}, ModifiedCoulomb::Coefficients::none);
  report("Frictionless: zero",
         none->coefficient({}, 0.).mu == 0. &&
           none->coefficient({}, 0.03).dmu == 0. &&
           none->steepest_fall({}, 1.) == 0. &&
           none->work({}, 1., 1.).friction == 0.);
}
