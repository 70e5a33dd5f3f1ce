// What every friction law owes the program, whatever it says, of all laws that
// scenes can choose: the slope is that of mu, works are integrals of mu, mu
// never falls faster than promised and is constant where closed forms take it
// to be; and entries of the same name are the same entry.

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "checks.h"
#include "law_of_text.h"

using namespace Debond;

/** The law with its default entries, and a bond above the friction of what is
 *  broken. */
FrictionLawPointer
law_called(const std::string &name)
{
  std::ofstream("friction_law_contract.csv")
    << "slip_mm,phi\n0,1\n0.01,0.9\n0.02,0.4\n0.03,0.1\n0.05,0\n";
  return law_of_text("set Friction law = " + name +
                     "\nset Friction table = friction_law_contract.csv\n");
}



/** States in which points may be found. */
std::vector<FrictionState>
states(const FrictionLaw &law)
{
  std::vector<FrictionState> all;
  for (const double phi_0 : {1., 0.3})
    for (const double slip : {0., 0.7, 2.})
      for (const double duration : {1e-2, 10.})
        {
          FrictionState state;
          state.phi_0       = phi_0;
          state.internal    = law.initial_variables();
          state.duration    = duration;
          const double slid = slip * law.characteristic_distance();
          state.internal    = law.advance(state, slid);
          state.slip        = slid;
          all.push_back(state);
        }
  return all;
}



/** Integral of mu(distance) - @p less, the speed being the same all the way,
 *  by Gauss points between the kinks of the law. */
double
integral_of_mu(const FrictionLaw   &law,
               const FrictionState &start,
               const double         distance)
{
  std::vector<double> ends{0.};
  if (!law.depends_on_rate())
    for (const double kink : law.kinks())
      if (kink > start.slip && kink < start.slip + distance)
        ends.push_back(kink - start.slip);
  ends.push_back(distance);
  const auto mu = [&](const double d) {
    FrictionState there = start;
    there.duration *= d / distance;
    return law.coefficient(there, d).mu;
  };
  double sum = 0.;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    for (unsigned int part = 0; part < 20; ++part)
      {
        const double length = (ends[i + 1] - ends[i]) / 20.;
        const double from   = ends[i] + part * length;
        sum +=
          boost::math::quadrature::gauss<double, 15>::integrate(mu,
                                                                from,
                                                                from + length);
      }
  return sum;
}



void
check_law(const std::string &name)
{
  const FrictionLawPointer law   = law_called(name);
  const double             size  = law->characteristic_distance();
  double                   slope = 0, work = 0, bond = 0, faster = 0, tail = 0;
  bool                     positive = true;
  for (const FrictionState &start : states(*law))
    for (double d = 0.0137 * size; d < 20. * size; d *= 1.7)
      {
        const FrictionCoefficient now = law->coefficient(start, d);
        const auto                mu  = [&](const double x) {
          return law->coefficient(start, x).mu;
        };
        const double h = 1e-5 * d;
        // a kink within reach of the difference has no slope
        const auto near_kink = [&](const double kink) {
          return std::abs(start.slip + d - kink) <= 2. * h;
        };
        const bool rate = law->depends_on_rate();
        if (rate ||
            std::none_of(law->kinks().begin(), law->kinks().end(), near_kink))
          grow(slope,
               size * std::abs(now.dmu - (8. * (mu(d + h) - mu(d - h)) -
                                          mu(d + 2. * h) + mu(d - 2. * h)) /
                                           (12. * h)));
        grow(work,
             std::abs(law->friction_strength(start, d) -
                      integral_of_mu(*law, start, d)) /
               d);
        FrictionState broken = start;
        broken.phi_0         = 0.;
        grow(bond,
             std::abs(law->coefficient(broken, d).mu -
                      (law->has_bond() ? law->mu_without_bond() : now.mu)));
        positive = positive && now.mu >= 0.;
        grow(faster, (-now.dmu - law->steepest_fall(start, d)) * size);
        if (!rate && start.slip + d >= law->kinks().back())
          grow(tail, std::abs(now.mu - mu(1000. * d)));
      }
  report(name + ": slope, deviation from differences", slope, 1e-7);
  report(name + ": works, deviation from quadrature, per distance", work, 1e-8);
  report(name + ": mu without a bond, deviation", bond, 1e-15);
  report(name + ": falls faster than promised by", faster, 1e-12);
  report(name + ": beyond the last kink mu changes by", tail, 1e-14);
  report(name +
           ": mu is not negative, and has a distance over which it changes",
         positive && size > 0.);
}



int
main()
{
  for (const FrictionLawPlugin &plugin : friction_law_plugins())
    check_law(plugin.name);
  report("entries of the same name are the same entry",
         entries_are_shared(friction_law_plugins()));
}
