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

using namespace Debond;

/** The order p in |r_k+1| ~ |r_k|^p that the last three residuals above the
 *  level of rounding show; 0 if there are no three. If the last of them is less
 *  than the square of the one before, which is small, it is 2 at least, however
 *  far that one had come at once. */
double
order(const std::vector<double> &history)
{
  const double round_off = 1e-11;
  for (unsigned int k = history.size() - 1; k >= 2; --k)
    if (history[k] > round_off && history[k - 1] < 0.01 &&
        history[k] < history[k - 1] * history[k - 1])
      return 2.;
    else if (history[k] > round_off)
      return std::log(history[k] / history[k - 1]) /
             std::log(history[k - 1] / history[k - 2]);
  return 0.;
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
    Scene::from_text(R"(
    subsection Bone
      set Material = linear
    end
    subsection Implant
      set Material = linear
    end
    subsection Chuck
      subsection Press
        set Value = 0.0049 * min(t, 1)
      end
      subsection Rotation z
        set Value = max(t - 1, 0)
      end
    end)" + changes,
                     {"Chuck/Press/Value=0.0049 * "
                      "min(t, 1) - " +
                      std::to_string(lift / angle) + " * max(t - 1, 0)"});

  CoupledSystem system(scene);
  NewtonOptions options;
  options.residual_tolerance     = 1e-12;
  options.points.touch_tolerance = 1e-12 * system.R;
  options.points.stick_first     = true;
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
  std::cout << "  the law softens: " << (summary.max_softening > 0.)
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
    subsection Interface
      set Slave = bone
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
