// Slip that is integrated over the step (Expert / Slip direction =
// integrated). One point on a turning disk, whose string is of constant length:
// against its equation of motion, integrated by Boost's odeint. A rigid coin
// that is sheared, then twisted: of second order in the step, where slip along
// the trial gap is of first.

#include <debond/interface/slip_problem.h>
#include <debond/models/simulation.h>

#include <boost/numeric/odeint.hpp>

#include <array>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "checks.h"
#include "coin_scene.h"

using namespace Debond;

/** The gap (x, y) and the slid distance of a point at the radius @p r that is
 *  turned by @p turn [rad] about the origin, from (r, 0); @p g: the gap that it
 *  begins with, which is as long as the string. On a circle that is smaller
 * than the string this may go slack. */
std::array<double, 3>
towed_around(const double           r,
             const Eigen::Vector2d &g,
             const double           turn,
             bool                  &goes_slack)
{
  using State    = std::array<double, 3>;
  const double L = g.norm();
  State        state{{g[0], g[1], 0.}};
  const double sign = turn > 0. ? 1. : -1.;
  const auto   rate = [&](const State &y, State &change, const double angle) {
    const double e[]{-std::sin(angle), std::cos(angle)};
    const double pull = (y[0] * e[0] + y[1] * e[1]) / L;
    goes_slack        = goes_slack || sign * pull < 0.;
    for (unsigned int c = 0; c < 2; ++c)
      change[c] = r * (e[c] - pull * y[c] / L);
    change[2] = r * pull;
  };
  boost::numeric::odeint::integrate_adaptive(
    boost::numeric::odeint::make_controlled<
      boost::numeric::odeint::runge_kutta_dopri5<State>>(1e-13, 1e-13),
    rate,
    state,
    0.,
    turn,
    sign * 1e-6);
  return state;
}



void
check_disk()
{
  const double L   = 0.5 * 3. / 585.;
  double       gap = 0., slid = 0.;
  unsigned int n = 0;
  for (const double r : {2.5, 0.5, 0.02, 0.5 * L})
    for (const double turn : {0.01, 0.35, -0.35, 2.})
      for (const double angle : {1.6, 0.7, 2.9})
        {
          const double          sign = turn > 0. ? 1. : -1.;
          const Eigen::Vector2d g(L * std::cos(angle),
                                  sign * L * std::sin(angle)),
            motion(r * std::cos(turn) - r, r * std::sin(turn));
          const Arc      arc(turn);
          const TowedGap ours({arc, g, motion, L, L, L});
          bool           goes_slack = false;
          const auto     exact      = towed_around(r, g, turn, goes_slack);
          if (goes_slack)
            continue;
          ++n;
          grow(
            gap,
            (L * ours.direction - Eigen::Vector2d(exact[0], exact[1])).norm() /
              L);
          grow(slid, std::abs(ours.distance - exact[2]) / (r * std::abs(turn)));
        }
  std::cout << "on a turning disk, " << n << " cases" << std::endl;
  report("  the gap differs over its length", gap, 1e-8);
  report("  the slid distance over the way", slid, 1e-8);
}



/** A gap that is longer than its limit, and comes to be shorter before it is
 *  longer again, is that of a step that begins where it comes to its limit for
 *  good: at the larger root of a quadratic equation. */
void
check_pulled_in_and_out()
{
  const Arc straight(0.);
  double    deviation = 0.;
  for (unsigned int i = 0; i < 20000; ++i)
    {
      const double          angle = random_number(0., 2. * M_PI);
      const Eigen::Vector2d along(std::cos(angle), std::sin(angle)),
        across(-along[1], along[0]);
      const double L = random_number(1e-4, 1e-3), held = random_number(0., L),
                   change = held - L, offset = random_number(-0.5, 0.5) * held,
                   behind     = random_number(1.1, 8.) * L,
                   way        = behind + random_number(2., 50.) * L;
      const Eigen::Vector2d g = offset * across - behind * along,
                            m = way * along;
      // |g + f m| = L + f change
      const double a = way * way - change * change, b = g.dot(m) - L * change,
                   c = g.squaredNorm() - L * L, root = b * b - a * c;
      if (root < 1e-3 * b * b)
        continue;
      const double   f = (-b + std::sqrt(root)) / a, end = L + f * change;
      const TowedGap whole({straight, g, m, L, held, held}),
        rest({straight, g + f * m, (1. - f) * m, end, held, held});
      grow(deviation,
           (whole.direction - rest.direction).norm() +
             std::abs(whole.distance - rest.distance) / way);
    }
  report("pulled in and out again: differs from the part beyond the limit",
         deviation,
         1e-8);
}



const std::string rigid_coin =
  "subsection Bone\n set Material = rigid\nend\n"
  "subsection Implant\n set Material = rigid\n set Cells = 12, 2\nend\n"
  "subsection Chuck\n"
  "  subsection Press\n set Value = 0.0049 * min(t, 1)\n end\n"
  "  subsection Translation x\n"
  "    set Value = 0.02 * min(max(t - 1, 0), 1)\n"
  "  end\n"
  "  subsection Rotation z\n set Value = 2 * max(t - 2, 0)\n end\n"
  "end\n"
  "subsection Load steps\n set Times = 0, 1, 2, 3\nend\n";



std::vector<TorqueRow>
rows(const std::string &direction, const unsigned int n)
{
  const std::string steps = std::to_string(n);
  Simulation        simulation(
    coin_scene(rigid_coin,
               {"Expert/Slip direction=" + direction,
                       "Load steps/Steps=1, " + steps + ", " + steps}));
  simulation.run();
  return simulation.rows();
}



/** Largest difference of Fx, or of the torque, at the rows of @p few, relative
 *  to its largest value. */
double
error(const std::vector<TorqueRow> &few,
      const std::vector<TorqueRow> &many,
      const bool                    of_torque)
{
  const auto value = [&](const TorqueRow &row) {
    return of_torque ? row.torque_Nmm : row.chuck_reaction[0];
  };
  const unsigned int ratio   = (many.size() - 2) / (few.size() - 2);
  double             largest = 0., difference = 0.;
  for (const TorqueRow &row : many)
    grow(largest, std::abs(value(row)));
  for (unsigned int i = 2; i < few.size(); ++i)
    grow(difference,
         std::abs(value(few[i]) - value(many[1 + (i - 1) * ratio])));
  return difference / largest;
}



// The limits are twice what a solution of the same formulas for 2880 points,
// written in Python, has against 8000 steps in each phase.
void
check_order()
{
  const auto reference = rows("integrated", 800);
  for (const auto &[n, force, torque] :
       {std::make_tuple(10, 7.5e-5, 7.0e-6), {100, 1.1e-6, 8.4e-8}})
    {
      const auto here = rows("integrated", n);
      std::cout << "sheared, then twisted in " << n << " steps each"
                << std::endl;
      report("  Fx", error(here, reference, false), 2. * force);
      report("  torque", error(here, reference, true), 2. * torque);
    }
  const auto trial = rows("trial", 100);
  report("slip along the trial gap in 100 steps: Fx is off by more than 1 %",
         error(trial, reference, false) > 0.01);
}



int
main()
{
  check_disk();
  check_pulled_in_and_out();
  check_order();
}
