#include <debond/newton.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Debond
{
  namespace
  {
    // Linear systems need no more digits than the step to the tolerance asks
    // for, and no fewer than quadratic convergence shows.
    double
    linear_tolerance(const double error, const double tolerance)
    {
      return std::clamp(0.1 * tolerance / error, 1e-9, 1e-3);
    }



    // The bulk's tangent is stale if the interior's residual, which an exact
    // tangent would reduce quadratically, is what is left of the residual and
    // has not become a tenth of what it was.
    bool
    bulk_contracts_poorly(const std::vector<double> &history,
                          const double               interior_share)
    {
      const std::size_t n = history.size();
      return n >= 2 && interior_share > 0.25 &&
             history[n - 1] > 0.1 * history[n - 2];
    }



    // Neither converging nor about to: no new minimum worth the name in the
    // last eight iterations, or a residual that explodes.
    bool
    hopeless(const std::vector<double> &history)
    {
      const std::size_t n = history.size();
      if (n < 10)
        return false;
      const double recent = *std::min_element(history.end() - 8, history.end());
      const double before =
        *std::min_element(history.begin(), history.end() - 8);
      return recent > 0.5 * before;
    }
  } // namespace



  NewtonResult
  solve_newton(CoupledSystem &system, const NewtonOptions &options)
  {
    NewtonResult result;
    for (unsigned int iteration = 0; true; ++iteration)
      {
        ContactPointMode mode;
        mode.frictionless    = options.frictionless;
        mode.stick_first     = options.stick_first && iteration == 0;
        mode.touch_tolerance = options.touch_tolerance;
        mode.duration        = options.duration;

        const auto residual = system.evaluate(mode);
        if (!residual.valid)
          {
            result.why = residual.why;
            return result;
          }
        const double error = residual.norm / residual.reference;
        result.history.push_back(error);
        if (error <= options.residual_tolerance)
          {
            if (mode.stick_first)
              continue; // nothing to correct; now with the true law
            result.converged = true;
            return result;
          }
        if (iteration == options.max_iterations || hopeless(result.history))
          {
            std::ostringstream why;
            why << "no convergence in " << iteration
                << " iterations, relative residual " << error << ", largest "
                << system.describe_worst_point();
            result.why = why.str();
            return result;
          }
        if (bulk_contracts_poorly(result.history, residual.interior_share))
          {
            if (!system.refactor_bulk())
              {
                result.why = "the stiffness of a body is not positive definite";
                return result;
              }
            system.evaluate(mode); // condensed with the new factor
          }
        if (system.is_unsupported())
          {
            result.why =
              "a loaded chuck has nothing to act against: the bodies are "
              "not in contact";
            return result;
          }
        result.why = system.solve_and_correct(
          linear_tolerance(error, options.residual_tolerance));
        if (!result.why.empty())
          return result;
        ++result.iterations;
      }
  }
} // namespace Debond
