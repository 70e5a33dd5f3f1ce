// What every friction law owes the program, whatever it says, of all laws that
// scenes can choose: derivatives of the limit by pressure, bond and distance
// are right, works are its integrals, it never falls faster than promised and
// is constant where closed forms take it to be; and entries of the same name
// are the same entry.

#include <debond/interface/pressure_dependence.h>

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
std::vector<PointStart>
states(const FrictionLaw &law)
{
  std::vector<PointStart> all;
  for (const double phi_0 : {1., 0.3})
    for (const double slip : {0., 0.7, 2.})
      for (const double duration : {1e-2, 10.})
        {
          PointStart state;
          state.phi_0            = phi_0;
          state.history.internal = law.initial_variables;
          state.duration         = duration;
          const double slid      = slip * law.characteristic_distance;
          state.history.internal = law.advance(state, slid);
          state.history.slip     = slid;
          all.push_back(state);
        }
  return all;
}



/** Integral of L over the distance, the speed being the same all the way, by
 *  Gauss points between the kinks of the law. */
double
integral_of_limit(const FrictionLaw &law,
                  const PointStart  &start,
                  const double       pressure,
                  const double       distance)
{
  std::vector<double> ends{0.};
  if (!law.depends_on_rate)
    for (const double kink : law.kinks)
      if (kink > start.history.slip && kink < start.history.slip + distance)
        ends.push_back(kink - start.history.slip);
  ends.push_back(distance);
  const auto L = [&](const double d) {
    PointStart there = start;
    there.duration *= d / distance;
    return law.limit_after(there, pressure, d).value;
  };
  double sum = 0.;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    for (unsigned int part = 0; part < 20; ++part)
      {
        const double length = (ends[i + 1] - ends[i]) / 20.;
        const double from   = ends[i] + part * length;
        sum +=
          boost::math::quadrature::gauss<double, 15>::integrate(L,
                                                                from,
                                                                from + length);
      }
  return sum;
}



/** A derivative by differences of fourth order. */
template <typename Function>
double
slope_of(const Function &f, const double x, const double h)
{
  return (8. * (f(x + h) - f(x - h)) - f(x + 2. * h) + f(x - 2. * h)) /
         (12. * h);
}



void
check_law(const std::string &name, const FrictionLawPointer &law)
{
  const double size    = law->characteristic_distance;
  const bool   rate    = law->depends_on_rate;
  double       by_slip = 0, by_pressure = 0, by_bond = 0, work = 0, bond = 0,
         faster = 0, tail = 0;
  bool positive = true;
  for (const PointStart &start : states(*law))
    for (const double p : {0.2, 1., 30.})
      for (double d = 0.0137 * size; d < 20. * size; d *= 1.7)
        {
          const double        g_s = start.history.slip + d;
          const FrictionLimit now = law->limit_after(start, p, d);
          const auto          L   = [&](const double x) {
            return law->limit_after(start, p, x).value;
          };
          const double h = 1e-5 * d;
          // a kink within reach of the difference has no slope
          const auto near_kink = [&](const double kink) {
            return std::abs(g_s - kink) <= 2. * h;
          };
          if (rate ||
              std::none_of(law->kinks.begin(), law->kinks.end(), near_kink))
            grow(by_slip, size / p * std::abs(now.by_slip - slope_of(L, d, h)));
          const auto under = [&](const double pressure) {
            return law->limit_after(start, pressure, d).value;
          };
          grow(by_pressure,
               std::abs(now.by_pressure - slope_of(under, p, 1e-3 * p)));
          const auto with = [&](const double phi) {
            return law->limit(start, phi, p, d).value;
          };
          grow(by_bond, std::abs(now.by_bond - slope_of(with, 0.5, 0.01)) / p);

          const PointWork by_law   = law->work(start, p, d);
          PointStart      unbonded = start;
          unbonded.phi_0           = 0.;
          const double integral    = integral_of_limit(*law, start, p, d),
                       of_broken   = integral_of_limit(*law, unbonded, p, d);
          grow(work,
               std::abs(by_law.friction - integral) /
                 (std::max(p, now.value) * d));
          grow(bond,
               std::abs(by_law.adhesive - (integral - of_broken)) /
                 (std::max(p, now.value) * d));
          positive = positive && now.value >= 0.;
          grow(faster,
               (-now.by_slip - law->steepest_fall(start, p, d)) * size / p);
          if (!rate && g_s >= law->kinks.back())
            grow(tail, std::abs(now.value - L(1000. * d)) / p);
        }
  report(name + ": slope, deviation from differences", by_slip, 1e-7);
  report(name + ": derivative by the pressure", by_pressure, 1e-9);
  report(name + ": derivative by the bond, at its mean", by_bond, 1e-9);
  report(name + ": works, deviation from quadrature", work, 1e-8);
  report(name + ": what of them is the bond's", bond, 1e-8);
  report(name + ": falls faster than promised by", faster, 1e-12);
  report(name + ": beyond the last kink L changes by", tail, 1e-14);
  report(name + ": L is not negative, and has a distance over which it changes",
         positive && size > 0.);
}



// The coefficient is the scene's at the reference pressure, and factors are
// those of the rows, constant beyond.
void
check_values()
{
  const auto mu = [](const PressureDependence &dependence, const double p) {
    return dependence
             .of(law_of_text("set Friction law = coulomb\n"
                             "set Friction coefficient = 0.4\n"))
             ->limit({}, 0., p, 1.)
             .value /
           p;
  };
  const PressureDependence power{0.7, 2., ""}, table{1., 0., "factors.csv"};
  report("at the reference pressure the coefficient differs by",
         std::abs(mu(power, 2.) - 0.4),
         1e-15);
  report("at eight times that by",
         std::abs(mu(power, 16.) - 0.4 * std::pow(8., -0.3)),
         1e-15);
  double worst = 0.;
  for (const auto &[p, factor] :
       {std::pair(0.1, 1.), {0.5, 1.}, {2., 0.8}, {10., 0.75}, {100., 0.6}})
    grow(worst, std::abs(mu(table, p) - 0.4 * factor));
  report("at the rows of a table by", worst, 1e-15);
}



int
main()
{
  std::ofstream("factors.csv")
    << "pressure_MPa,factor\n0.5,1\n2,0.8\n10,0.75\n40,0.6\n";
  for (const FrictionLawPlugin &plugin : all_laws<FrictionLaw>())
    {
      const FrictionLawPointer law = law_called(plugin.name);
      check_law(plugin.name, law);
      // below and above p_0/1000
      check_law(plugin.name + ", p^0.67",
                PressureDependence{0.67, 900., ""}.of(law));
      check_law(plugin.name + ", p^1.3",
                PressureDependence{1.3, 10., ""}.of(law));
      check_law(plugin.name + ", table of factors",
                PressureDependence{1., 0., "factors.csv"}.of(law));
    }
  check_values();
  report("entries of the same name are the same entry",
         entries_are_shared<FrictionLaw>());
}
