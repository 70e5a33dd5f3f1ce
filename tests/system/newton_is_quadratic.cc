// Newton's method converges quadratically, and soon, in steps in which the
// interface slips and softens. Bodies are linear, so everything nonlinear is
// the interface, and the last iterations show whether its tangent is exact.

#include <debond/scene/scene.h>
#include <debond/support/runtime.h>
#include <debond/system/newton.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "checks.h"
#include "coin_scene.h"
#include "pressed_and_turned.h"
#include "softening.h"

using namespace Debond;

constexpr double round_off = 1e-11;



/** The order p in |r_k+1| ~ |r_k|^p that the last three residuals above the
 *  level of rounding show. It is 2 at least, however far the one before had
 * come at once, if the last of them is of the size of the square of that, or,
 * where there are no three, if what followed is at most that or rounding. */
double
order(const std::vector<double> &history)
{
  const auto is_square = [&](const unsigned int k, const double floor) {
    return history[k - 1] < 0.01 &&
           history[k] < std::max(floor, 10. * history[k - 1] * history[k - 1]);
  };
  unsigned int k = history.size() - 1; // the last above rounding
  while (k > 0 && history[k] <= round_off)
    --k;
  if (k < 2)
    return k + 1 < history.size() && is_square(k + 1, round_off) ? 2. : 0.;
  return is_square(k, 0.) ? 2. :
                            std::log(history[k] / history[k - 1]) /
                              std::log(history[k - 1] / history[k - 2]);
}



/** Made up: a first correction that leads to @p second of the first residual,
 *  then residuals that fall by @p next, to what rounding leaves. */
template <typename Next>
bool
is_taken_for_quadratic(const double second, const Next &next)
{
  std::vector<double> history{1., second};
  while (history.back() > 1e-12)
    history.push_back(next(history.back()) + 1e-13);
  return order(history) >= 1.8;
}



void
check_order()
{
  bool knows_squares = true, knows_lines = true;
  for (double second = 0.09; second > 1e-9; second *= 0.7)
    {
      for (const double factor : {1e-4, 0.1, 1., 5.})
        knows_squares =
          knows_squares && is_taken_for_quadratic(second, [&](const double r) {
            return factor * r * r;
          });
      for (const double factor : {0.5, 0.1, 1e-2, 1e-3})
        knows_lines =
          knows_lines && (second < 1e-6 ||
                          !is_taken_for_quadratic(second, [&](const double r) {
                            return factor * r;
                          }));
    }
  report("Quadratic convergence is known, however fast", knows_squares);
  report("Linear convergence is no such", knows_lines);
}



/** Presses in, and turns by @p angle in one step that starts from where the
 *  implant was, lifted by @p lift [mm] meanwhile. */
void
check(const std::string &name,
      const std::string &changes,
      const double       angle,
      const double       lift = 0.)
{
  const Scene scene =
    coin_scene(R"(
    subsection Bone
      set Material = linear
    end
    subsection Implant
      set Material = linear
    end
)" + pressed_then("Rotation z", "max(t - 1, 0)") +
                 changes,
               {"Chuck/Press/Value=0.0049 * "
                "min(t, 1) - " +
                std::to_string(lift / angle) + " * max(t - 1, 0)"});

  CoupledSystem system(scene);
  NewtonOptions options;
  options.residual_tolerance = 1e-12;
  options.points.stick_first = true;
  system.start(0.);
  std::cout << name << std::endl;
  for (const double time : {0., 1.})
    {
      system.predict(time, time, false);
      report("  push-in converges", solve_newton(system, options).converged);
      system.commit(time);
    }

  system.predict(1. + angle, 1. + angle, false);
  const NewtonResult result  = solve_newton(system, options);
  const auto         summary = system.interface.summarise();
  report("  the step converges", result.converged);
  // of what rubs, beside what a bond holds, and of what is pulled
  const auto   all      = system.interface.statuses();
  const double n_moving = std::count_if(all.begin(), all.end(), slides);
  report("  more than a third of the interface slips",
         summary.share_slip + summary.share_pulled > 0.33 ||
           n_moving > 0.33 * all.size());
  std::cout << "  the law softens: " << softens(system.interface, 0.)
            << std::endl;
  const bool is_quadratic = order(result.history) >= 1.8;
  report("  at most eight iterations", result.iterations <= 8);
  report("  order of convergence at least 1.8", is_quadratic);
  if (!is_quadratic)
    for (const double error : result.history)
      std::cout << "    " << error << std::endl;
}



int
main()
{
  set_up_libraries();
  check_order();
  const std::string stiff         = R"(
    subsection Interface
      set Normal stiffness = 20000
    end)";
  const std::string rough         = R"(
    subsection Interface
      set Friction coefficient unbroken = 1.5
    end)";
  const std::string soft_in_shear = R"(
    subsection Interface
      set Normal stiffness            = 6000
      set Tangential stiffness = 1000
    end)";
  const std::string bone_is_slave = R"(
    subsection Expert
      subsection Interface
        set Slave = bone
      end
    end)";
  const std::string tilted        = R"(
    subsection Chuck
      subsection Translation x
        set Value = 0.02 * max(t - 1, 0)
      end
      subsection Rotation x
        set Value = 0.1 * max(t - 1, 0)
      end
      subsection Rotation y
        set Value = -0.05 * max(t - 1, 0)
      end
    end)";

  const auto law = [](const std::string &name) {
    return "\n    subsection Interface\n      set Law = " + name + "\n    end";
  };

  check("Main scene", "", 1.);
  check("Stiff interface, before the law softens", stiff, 0.2);
  check("Rough interface", stiff + rough, 1.);
  check("Interface soft in shear", soft_in_shear, 1.);
  check("The bone is the slave", stiff + bone_is_slave, 0.7);
  check("Turned, tilted and shifted", stiff + tilted, 0.7);
  check("The same, the bone is the slave", stiff + tilted + bone_is_slave, 0.7);
  check("Adhesive", law("adhesive") + tilted, 1.);
  check("Adhesive, in tension", law("adhesive"), 0.4, 0.01);
  check("Adhesive, pulled off", law("adhesive") + tilted, 0.4, 0.02);
  check("Dilatant", law("dilatant") + tilted, 0.7);
  check("Mixed mode, pressed", law("mixed mode"), 0.4);
  check("Mixed mode, in tension", law("mixed mode") + tilted, 0.2, 0.015);
}
