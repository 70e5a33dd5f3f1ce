#pragma once

// What compiled tests of whole scenes share: scenes that are taken step by
// step with the state at hand, and scenes that the program runs.

#include <debond/models/debonding_problem.h>
#include <debond/support/runtime.h>
#include <debond/system/newton.h>

#include <cmath>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "checks.h"
#include "coin_scene.h"

/** Entries of a scene, and more. */
inline std::vector<std::string>
operator+(std::vector<std::string> list, const std::vector<std::string> &more)
{
  list.insert(list.end(), more.begin(), more.end());
  return list;
}



/** A scene taken step by step. Steps are not halved: one that does not converge
 *  ends the test. */
class DrivenScene
{
public:
  explicit DrivenScene(const std::string              &text,
                       const std::vector<std::string> &overrides = {})
    : scene(coin_scene(text, overrides))
    , system(scene)
    , times(scene.load_steps.planned_times())
  {
    system.start(times[0]);
    solve();
  }

  /** Goes to the next planned time. False if there is none. */
  bool
  advance()
  {
    if (step + 1 == times.size())
      return false;
    ++step;
    solve();
    return true;
  }

  /** Goes to a planned time. */
  void
  advance_to(const double time)
  {
    while (times[step] < time && advance())
      ;
    if (times[step] != time)
      throw std::runtime_error("no step ends at this time");
  }

  double
  time() const
  {
    return times[step];
  }

  double
  angle_deg() const
  {
    return system.chuck.position()[5] * 180. / M_PI;
  }

  const Debond::Scene   scene;
  Debond::CoupledSystem system;
  /** Newton iterations of the last step. */
  unsigned int iterations = 0;

private:
  void
  solve()
  {
    Debond::NewtonOptions options;
    options.residual_tolerance = scene.load_steps.residual_tolerance;
    options.points.stick_first = scene.load_steps.step_in_phase(step) <= 1;
    if (step > 0)
      options.points.duration = times[step] - times[step - 1];
    options.points.frictionless =
      step > 0 &&
      times[step - 1] < scene.interface.friction_starts_at - 1e-9 * times[step];
    system.predict(times[step], times[step], !options.points.stick_first);
    const Debond::NewtonResult result = solve_newton(system, options);
    iterations                        = result.iterations;
    if (!result.converged)
      throw std::runtime_error("step " + std::to_string(step) + ": " +
                               result.why);
    system.commit(times[step]);
  }

  const std::vector<double> times;
  unsigned int              step = 0;
};



/** The rows of a scene that the program runs, with results in the directory
 *  results/@p name. */
inline std::vector<Debond::TorqueRow>
run_scene(const std::string              &name,
          const std::string              &text,
          const std::vector<std::string> &overrides = {})
{
  Debond::Scene scene                  = coin_scene(text, overrides);
  scene.output.directory               = "results/" + name;
  scene.output.fields_every            = 0;
  scene.output.quiet                   = true;
  scene.output.overwrite_other_results = true;
  Debond::DebondingProblem problem(scene);
  problem.run();
  return problem.rows;
}



/** The main of all these tests. */
inline int
run_test(void (*test)())
{
  Debond::set_up_libraries();
  try
    {
      test();
      return 0;
    }
  catch (const std::exception &error)
    {
      std::cout << "NO, stopped: " << error.what() << std::endl;
      return 1;
    }
}
