// Law = mixed mode with Criterion = power law: pulled along a straight gap, a
// bond takes the work G, G^-eta = ((1 - B) / G_I)^eta + (B / G_II)^eta, B being
// the share along the face, and damage has the derivatives of differences. All
// else: interface_law_contract.

#include <debond/interface/bilinear_bond.h>
#include <debond/interface/interface_law.h>

#include <cmath>

#include "checks.h"
#include "law_of_text.h"

using namespace Debond;

int
main()
{
  const double G_I = 0.05, G_II = 0.1, exponent = 1.3;
  const auto   law =
    interface_law_of_text("set Law = mixed mode\nsubsection Mixed mode\n"
                          "set Criterion = power law\n"
                          "set Stiffness = 2000\nset Fracture energy I = 0.05\n"
                          "set Fracture energy II = 0.1\nend\n"
                          "subsection Expert\nsubsection Mixed mode\n"
                          "set Exponent = 1.3\nend\nend\n",
                          modified_coulomb());
  PointHistory history;
  history.joined    = true;
  const auto damage = [&](const double n, const double t) {
    return law->cohesion->hold(law->begin(history, 1.), n, t);
  };
  double work = 0., slopes = 0.;
  for (const double angle : {0.2, 0.7, 1.3})
    {
      const double n = std::cos(angle), t = std::sin(angle), B = t * t,
                   G          = std::pow(std::pow((1. - B) / G_I, exponent) +
                                  std::pow(B / G_II, exponent),
                                -1. / exponent);
      const unsigned int m    = 20000;
      const double       step = 0.08 / m; // beyond the end
      double             area = 0.;
      for (unsigned int i = 1; i <= m; ++i)
        {
          const double           d   = step * (i - 0.5);
          const CohesiveResponse now = damage(n * d, t * d);
          area += now.stiffness * d * step;
          if (i % 97 != 0 || now.damage <= 0.01 || now.damage >= 0.99)
            continue;
          const double h = 1e-7 * d;
          grow(slopes,
               d * std::abs((damage(n * d + h, t * d).damage -
                             damage(n * d - h, t * d).damage) /
                              (2. * h) -
                            now.damage_by_normal));
          grow(slopes,
               d * std::abs((damage(n * d, t * d + h).damage -
                             damage(n * d, t * d - h).damage) /
                              (2. * h) -
                            now.damage_by_tangential));
        }
      grow(work, std::abs(area / G - 1.));
    }
  report("work to the end, deviation from the criterion", work, 1e-4);
  report("derivatives of the damage, deviation from differences", slopes, 1e-6);
}
