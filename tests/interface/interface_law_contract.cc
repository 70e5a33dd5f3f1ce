// What a law of the interface owes the program, whatever it says, of all laws
// that scenes can choose: pressure and limit have the derivatives that it
// gives; nothing is carried beyond its reach; energies balance along any motion
// of a point, to second order in the step; damage is never negative; the limit
// never falls faster than promised; and entries of the same name are the same
// entry. Derivatives and that fall with every friction law, too.

#include <debond/interface/bilinear_bond.h>
#include <debond/interface/modified_coulomb.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "checks.h"
#include "law_of_text.h"

using namespace Debond;

/** The law with its default entries, and the friction of the paper. */
InterfaceLawPointer
law_called(const std::string &name, const BoneLayer &bone = {})
{
  return interface_law_of_text("set Law = " + name + "\n",
                               modified_coulomb(),
                               false,
                               bone);
}



/** A motion of a point: gap and sliding distance by time from 0 to 1. */
struct Motion
{
  double depth, height, turns, slip, phase;

  explicit Motion(std::mt19937 &random)
  {
    std::uniform_real_distribution<double> between(0., 1.);
    depth  = 0.005 * between(random);
    height = 0.03 * std::pow(between(random), 2);
    turns  = 1. + 3. * between(random);
    slip   = 0.08 * std::pow(between(random), 2);
    phase  = between(random);
  }

  double
  gap(const double t) const
  {
    return -depth +
           (depth + height) * t * std::pow(std::sin(M_PI * turns * t), 2);
  }
  double
  slid(const double t) const
  {
    return slip * (t - 0.1 * std::sin(2. * M_PI * (t + phase)));
  }
};



/** A point that is taken through a motion in steps. */
struct Point
{
  const InterfaceLaw &law;
  double              phi_0;
  PointHistory        history;
  double work = 0., lift = 0., damage = 0., friction = 0.; ///< [N/mm]
  double least_damage = 0., crushed = 0.;

  InterfaceResponse
  response() const
  {
    return law.respond(law.begin(history, phi_0), history.normal_gap, 0.);
  }

  /** Whether it is carried. */
  bool
  step(const double g_n, const double distance)
  {
    const PointStart        start    = law.begin(history, phi_0);
    const bool              was_open = history.normal_gap == PointHistory::far;
    const InterfaceResponse before   = response(),
                            after    = law.respond(start, g_n, distance);
    if (g_n >= law.reach(start, distance))
      {
        if (!was_open)
          history = law.open(history);
        return false;
      }
    const PointWork by_law = law.work(start, g_n, distance);
    if (!was_open)
      {
        work -=
          0.5 * (before.pressure + after.pressure) * (g_n - history.normal_gap);
        lift += by_law.lift;
        damage += by_law.damage;
        friction += by_law.friction;
      }
    least_damage       = std::min(least_damage, by_law.damage);
    const double depth = history.crushed;
    history            = law.advance(start, g_n, distance);
    crushed += law.bone.work(depth, history.crushed);
    least_damage = std::min(least_damage, history.crushed - depth);
    return true;
  }
};



// Differences from both sides that agree, where the law has no kink.
void
check_derivatives(const std::string &name, const InterfaceLaw &law)
{
  std::mt19937 random(7);
  double       by_gap = 0., by_slip = 0., beyond = 0., softening = 0.;
  bool         positive = true;
  unsigned int n        = 0;
  for (unsigned int sample = 0; sample < 400; ++sample)
    {
      const Motion motion(random);
      Point        point{law, sample % 3 == 0 ? 1. : 0.3 + 0.0017 * sample, {}};
      const double steps = 2 + sample % 9;
      for (unsigned int i = 0; i < steps; ++i)
        point.step(motion.gap(i / steps),
                   motion.slid((i + 1) / steps) - motion.slid(i / steps));
      const PointStart start = law.begin(point.history, point.phi_0);
      const double     g = motion.gap(1.), d = 1e-4 + motion.slip / steps;
      const auto       at = [&](const double more_g, const double more_d) {
        return law.respond(start, g + more_g, d + more_d);
      };
      const InterfaceResponse now = at(0, 0);
      if (g >= law.reach(start, d)) // open
        continue;
      positive = positive && now.limit >= 0.;
      grow(softening,
           -now.limit_by_slip - law.softening_by_slip(start, now.pressure, d));
      const auto compare = [&](const InterfaceResponse &minus,
                               const InterfaceResponse &plus,
                               const double             h,
                               const double             dp,
                               const double             dL,
                               double                  &worst) {
        const double p_minus = (now.pressure - minus.pressure) / h,
                     p_plus  = (plus.pressure - now.pressure) / h,
                     L_minus = (now.limit - minus.limit) / h,
                     L_plus  = (plus.limit - now.limit) / h;
        // a kink: the slopes on its two sides differ by more than a curve's
        if (std::abs(p_plus - p_minus) + std::abs(L_plus - L_minus) > 3e-2)
          return;
        ++n;
        grow(worst, std::abs(0.5 * (p_minus + p_plus) - dp) / 600.);
        grow(worst, std::abs(0.5 * (L_minus + L_plus) - dL) / 600.);
      };
      const double h = 1e-8;
      compare(
        at(-h, 0), at(h, 0), h, now.pressure_by_gap, now.limit_by_gap, by_gap);
      compare(at(0, -h),
              at(0, h),
              h,
              now.pressure_by_slip,
              now.limit_by_slip,
              by_slip);
      // what a bond still carries where it is given up
      const double reach = law.reach(start, d);
      if (std::isfinite(reach) && point.history.normal_gap < PointHistory::far)
        grow(beyond, std::abs(law.respond(start, reach, d).pressure));
    }
  report(name + ": derivatives by the gap, deviation from differences",
         by_gap,
         1e-6);
  report(name + ": derivatives by the distance", by_slip, 1e-6);
  report(name + ": a hundred of them", n > 100);
  report(name + ": where it opens it carries", beyond, 1e-12);
  report(name + ": the limit falls faster than promised by", softening, 1e-9);
  report(name + ": the limit is not negative", positive);
}



// Work across the gap, and of slip what lifts the faces, is stored, or has
// damaged the bond.
void
check_energies(const std::string &name, const InterfaceLaw &law)
{
  std::mt19937 random(3);
  double       worst = 0., coarse = 0., fine = 0., least = 0.;
  for (unsigned int sample = 0; sample < 60; ++sample)
    {
      const Motion        motion(random);
      std::vector<double> defect;
      double              size = 0.;
      for (const unsigned int steps : {2000, 4000})
        {
          Point  point{law, 1. - 0.01 * sample, {}};
          double stored = 0., missing = 0.;
          point.step(motion.gap(0.), 0.);
          point.crushed = 0.;
          stored        = point.response().energy;
          for (unsigned int i = 0; i < steps; ++i)
            {
              const bool is_carried = point.step(motion.gap((i + 1.) / steps),
                                                 motion.slid((i + 1.) / steps) -
                                                   motion.slid(1. * i / steps));
              if (!is_carried)
                break; // what opens has stored nothing; here it ends
              missing = point.work + point.lift - point.damage - point.crushed -
                        (point.response().energy - stored);
              size = std::max({size, std::abs(point.work), point.damage});
            }
          least = std::min(least, point.least_damage);
          defect.push_back(std::abs(missing) / size);
        }
      grow(worst, defect[1]);
      coarse += defect[0];
      fine += defect[1];
    }
  report(name + ": energies along a motion in 4000 steps balance to",
         worst,
         2e-5);
  report(name + ": and four times better than in 2000, to a quarter",
         std::abs(fine / coarse - 0.25) < 0.06 || worst < 1e-12);
  report(name + ": damage is not negative", -least, 1e-15);
}



// The share that is held: derivatives of its damage; in a fixed direction the
// work is that of a triangle, whose height is given by the strengths and whose
// area by Benzeggagh and Kenane's criterion; damage never falls.
void
check_cohesion(const std::string &name, const InterfaceLaw &law)
{
  PointHistory history;
  history.joined         = true;
  double       deviation = 0., work = 0., strength = 0., falls = 0.;
  const double N = 5., T = 5., G_I = 0.05, G_II = 0.1, K = 2000., eta = 2.;
  for (const double angle : {0., 0.2, 0.7, 1.3, 0.5 * M_PI})
    {
      const double n = std::cos(angle), t = std::sin(angle), B = t * t,
                   G          = G_I + (G_II - G_I) * std::pow(B, eta),
                   onset      = 1. / std::hypot(n * K / N, t * K / T),
                   end        = 2. * G / (K * onset);
      const unsigned int m    = 100000;
      double             area = 0., before = 0., largest = 0., damage = 0.;
      for (unsigned int i = 1; i <= m; ++i)
        {
          const double           d = 1.01 * end * i / m;
          const CohesiveResponse now =
            law.cohesion->hold(law.begin(history, 1.), n * d, t * d);
          area += 0.5 * (before + now.stiffness * d) * 1.01 * end / m;
          before  = now.stiffness * d;
          largest = std::max(largest, before);
          grow(falls, damage - now.damage);
          damage         = now.damage;
          const double h = 1e-7 * end;
          if (i % 997 == 0 && damage > 0. && damage < 1.)
            {
              const auto at = [&](const double more_n, const double more_t) {
                return law.cohesion
                  ->hold(law.begin(history, 1.), n * d + more_n, t * d + more_t)
                  .damage;
              };
              if (n > 0.1)
                grow(deviation,
                     end * std::abs((at(h, 0.) - at(-h, 0.)) / (2. * h) -
                                    now.damage_by_normal));
              if (t > 0.1)
                grow(deviation,
                     end * std::abs((at(0., h) - at(0., -h)) / (2. * h) -
                                    now.damage_by_tangential));
            }
        }
      grow(work, std::abs(area / G - 1.));
      grow(strength, std::abs(largest / (K * onset) - 1.));
      PointHistory damaged = history;
      damaged.damage       = 0.5;
      grow(falls,
           0.5 - law.cohesion->hold(law.begin(damaged, 1.), 0.1 * n * end, 0.)
                   .damage);
    }
  report(name + ": derivatives of the damage", deviation, 1e-6);
  report(name + ": work to the end, deviation from the criterion", work, 1e-6);
  report(name + ": largest traction, deviation from the onset", strength, 1e-4);
  report(name + ": damage falls by", falls, 1e-15);
}



// Bone that is crushed in one step and in many, deeper and deeper: the same
// depth, and on the way back and forth again the spring alone.
void
check_crushing(const std::string &name, const InterfaceLaw &law)
{
  double difference = 0., elastic = 0.;
  for (const double depth : {0.002, 0.004, 0.02})
    {
      Point once{law, 0.8, {}}, often{law, 0.8, {}};
      once.step(-depth, 0.);
      for (unsigned int i = 1; i <= 9; ++i)
        often.step(-depth * i / 9., 0.);
      grow(difference, std::abs(once.history.crushed - often.history.crushed));
      const double p         = once.response().pressure;
      const bool   is_closed = once.step(-0.7 * depth, 0.);
      grow(elastic,
           std::abs((is_closed ? once.response().pressure : 0.) -
                    std::max(0., p - 0.3 * law.stiffness * depth)));
      once.step(-depth, 0.);
      grow(elastic, std::abs(once.response().pressure - p));
    }
  report(name + ": crushed in one step and in nine", difference, 1e-15);
  report(name + ": unloads and reloads along the spring", elastic, 1e-12);
}



/** With all friction laws that it takes. */
void
check_frictions(const std::string &name)
{
  std::ofstream("interface_law_contract.csv")
    << "slip_mm,phi\n0,1\n0.01,0.9\n0.02,0.4\n0.03,0.1\n0.05,0\n";
  for (const FrictionLawPlugin &plugin : all_laws<FrictionLaw>())
    {
      const FrictionLawPointer friction =
        law_of_text("set Friction law = " + plugin.name +
                    "\nset Friction table = interface_law_contract.csv\n");
      try
        {
          check_derivatives(name + ", " + plugin.name,
                            *interface_law_of_text("set Law = " + name + "\n",
                                                   friction));
        }
      catch (const EntryError &error) // refused, or without work to climb
        {
          report(name + ", " + plugin.name + ": refused",
                 friction->depends_on_rate || friction->is_frictionless);
        }
    }
}



int
main()
{
  for (const InterfaceLawPlugin &plugin : all_laws<InterfaceLaw>())
    {
      const InterfaceLawPointer law = law_called(plugin.name);
      check_frictions(plugin.name);
      check_derivatives(plugin.name, *law);
      check_energies(plugin.name, *law);
      if (law->cohesion)
        check_cohesion(plugin.name, *law);
      for (const double H : {0., 150.})
        {
          const std::string name =
            plugin.name + ", crushed bone, H = " + std::to_string(int(H));
          const InterfaceLawPointer crushed =
            law_called(plugin.name, BoneLayer{1.2, H});
          check_derivatives(name, *crushed);
          check_energies(name, *crushed);
          if (!crushed->pulls())
            check_crushing(name, *crushed);
        }
    }
  report("entries of the same name are the same entry",
         entries_are_shared<InterfaceLaw>());
}
