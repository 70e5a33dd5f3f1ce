#include <debond/support/number_text.h>
#include <debond/system/newton.h>

#include <algorithm>

// Section 5 of doc/developers/walk.md: deal.II's solve_nonlinear_timestep of
// step-44 for two bodies and their interface. The tangent of the interface is
// exact, so that the residual falls quadratically, with two exceptions that
// make up most of this file: the stiffness of a Neo-Hookean bulk is that of an
// earlier state, and friction has a corner between stick and slip.
namespace Debond
{
  namespace
  {
    // S belongs to the state in which a body was condensed last. For a linear
    // body that is all there is. For a Neo-Hookean one it is an approximation,
    // with which the residual of its interior contracts about the strain, a
    // factor of 1e-3 in each iteration.
    //
    // The bulk's tangent is stale if the interior's residual, which an exact
    // tangent would reduce quadratically, is what is left of the residual and
    // has not become a tenth of what it was. The first condition keeps the bulk
    // from being condensed anew because of points that change their state,
    // which a new K does not help against.
    bool
    bulk_contracts_poorly(const std::vector<double> &history,
                          const double               interior_share)
    {
      const std::size_t n = history.size();
      return n >= 2 && interior_share > 0.25 &&
             history[n - 1] > 0.1 * history[n - 2];
    }



    // Neither converging nor about to: no new minimum worth the name in the
    // last eight iterations, or a residual that explodes. Another attempt or
    // half the step is the cheaper then. Ten iterations are granted in any
    // case, as the residual may well grow while points find out whether they
    // slide.
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



    // Recognises that points change between stick, slip and open without an
    // end: all of them are in states that they were in before with a residual
    // not much larger, or the residual has grown for the second time. States
    // that have settled do not count: quadratic convergence has begun then, or
    // will.
    class CycleDetector
    {
    public:
      bool
      sees_cycle(const std::vector<PointStatus> &states, const double error)
      {
        if (!seen.empty() && error > seen.back().second)
          ++n_grown;
        const bool settled = !seen.empty() && states == seen.back().first;
        const bool was_here =
          std::any_of(seen.begin(), seen.end(), [&](const auto &before) {
            return before.first == states && error > 0.5 * before.second;
          });
        seen.emplace_back(states, error);
        return n_grown > 1 || (was_here && !settled);
      }

    private:
      unsigned int                                             n_grown = 0;
      std::vector<std::pair<std::vector<PointStatus>, double>> seen;
    };



    // A line search, for a law with corners: between stick and slip the
    // residual is continuous, but its slope is not, and the tangent of one side
    // may overshoot on the other for ever. With an interface much stiffer than
    // the bodies it does, and smaller steps can make it worse
    // (doc/explanation/solution.md, Cycles).
    //
    // Takes back half of the correction until the residual has become smaller,
    // each time for one residual and no linear solve; returns the residual
    // where this ends. At 1/32 it is left at that, smaller or not: the next
    // correction has another direction.
    CoupledSystem::Residual
    evaluate_shortened(CoupledSystem                   &system,
                       const CoupledSystem::Correction &correction,
                       const ContactPointMode          &mode,
                       const double                     norm_before)
    {
      // Smaller by a tenth of what a linear residual would lose.
      constexpr double   shortest = 1. / 32., descent = 0.1;
      const unsigned int n_unknowns = system.n_unknowns();
      double             fraction   = 1.;
      auto               residual   = system.evaluate(mode);
      // with new contact unknowns the old correction means nothing
      while (fraction > shortest && system.n_unknowns() == n_unknowns &&
             (!residual.why.empty() ||
              residual.norm > (1. - descent * fraction) * norm_before))
        {
          fraction *= 0.5;
          system.correct(correction, -fraction);
          residual = system.evaluate(mode);
        }
      return residual;
    }



    // Solves (S + Q^T (df/dx) Q) dv = -r for the next correction, with a new
    // tangent of the bulk if the old one is stale.
    CoupledSystem::Correction
    find_correction(CoupledSystem             &system,
                    const NewtonOptions       &options,
                    const ContactPointMode    &mode,
                    CoupledSystem::Residual    residual,
                    const std::vector<double> &history)
    {
      if (bulk_contracts_poorly(history, residual.interior_share))
        {
          if (!system.refactor_bulk())
            return {{}, {}, "the stiffness of a body is not positive definite"};
          residual = system.evaluate(mode); // condensed with the new factor
        }
      // Linear systems need no more digits than the step to the tolerance asks
      // for, and no fewer than quadratic convergence shows: the residual of the
      // linear system stays in that of the next iteration. Here a tenth of the
      // tolerance over the present error, but not below 1e-9 nor above 1e-3.
      return system.solve(residual,
                          std::clamp(0.1 * options.residual_tolerance /
                                       history.back(),
                                     1e-9,
                                     1e-3));
    }
  } // namespace



  // Newton's method for r(v_c, q) = 0. Each round is a residual, four reasons
  // to stop, and a correction. The state is that of the system, a trial from
  // where the attempt began; a result that has not converged leaves it where it
  // is, and the caller takes it back.
  NewtonResult
  solve_newton(CoupledSystem &system, const NewtonOptions &options)
  {
    NewtonResult              result;
    CycleDetector             cycle_detector;
    CoupledSystem::Correction correction;
    // Iteration from which on corrections are shortened; 0: none. Not from the
    // start: where nothing cycles full corrections converge quadratically, and
    // shortened ones would spoil that.
    std::size_t cautious_from = 0;
    double      last_norm     = 0.;
    for (unsigned int iteration = 0; true; ++iteration)
      {
        // The residual r = S v_c + Q^T f(v_c) of the state that the last
        // correction led to, by the law of each point
        // (doc/developers/point.md). In the very first round closed points may
        // have to stick, whatever their traction: with the tangent of sticking
        // points the first correction cannot make them cycle.
        ContactPointMode mode = options.points;
        mode.stick_first      = mode.stick_first && iteration == 0;
        const auto residual =
          cautious_from > 0 ?
            evaluate_shortened(system, correction, mode, last_norm) :
            system.evaluate(mode);
        // No residual: a cell is turned inside out, or a point has found no
        // solution of its equations. The caller is told why, and makes
        // another attempt or the step smaller.
        result.why = residual.why;
        if (!result.why.empty())
          return result;
        // Forces are measured by the contact force, so that the tolerance means
        // the same for a light touch and a heavy load.
        const double error = residual.norm / residual.reference;
        last_norm          = residual.norm;
        result.history.push_back(error);
        // Converged, unless points were held that the law might let go. The
        // norm is that of the whole residual, interior included.
        if (error <= options.residual_tolerance)
          {
            if (mode.stick_first)
              continue; // nothing to correct; now with the true law
            result.converged = true;
            return result;
          }
        // Give up early: another attempt at the step is made, or it is halved.
        if (iteration == options.max_iterations ||
            hopeless(
              {result.history.begin() + cautious_from, result.history.end()}))
          {
            result.why = Text() << "no convergence in " << iteration
                                << " iterations, relative residual " << error
                                << ", largest "
                                << system.describe_worst_point(residual);
            return result;
          }
        // The tangent is exact, but only for the present state of each point.
        // Where points go round between stick and slip, full corrections lead
        // nowhere.
        if (!mode.stick_first && cautious_from == 0 &&
            options.shorten_in_cycles &&
            cycle_detector.sees_cycle(system.interface.statuses(), error))
          cautious_from = iteration;
        // Otherwise v <- v + dv. What the correction does to the interior of
        // the bodies belongs to it, so that a part of it can be taken back
        // above.
        correction =
          find_correction(system, options, mode, residual, result.history);
        result.why = correction.why;
        if (!result.why.empty())
          return result;
        system.correct(correction);
        ++result.iterations;
      }
  }
} // namespace Debond
