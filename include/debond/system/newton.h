#pragma once

#include <debond/system/coupled_system.h>

#include <string>
#include <vector>

namespace Debond
{
  /** Options of the iteration of one step. */
  struct NewtonOptions
  {
    double       residual_tolerance = 1e-8; ///< relative to the contact force
    unsigned int max_iterations     = 25;
    /** Mode in which points are updated; with stick_first closed points stick
     * in the first iteration only. */
    ContactPointMode points;
    /** Shorten corrections once the states of the points go round in a cycle.
     *  Where the load cannot be followed, only full corrections find the state
     *  that it jumps to. */
    bool shorten_in_cycles = true;
  };

  struct NewtonResult
  {
    bool         converged  = false;
    unsigned int iterations = 0; ///< linear solves
    std::string  why;            ///< if not converged
    /** |residual| / reference force at each evaluation. */
    std::vector<double> history;
  };

  /**
   * Newton's method on the trial state of @p system from where it is, for
   *
   *   r(v_c, q) = S v_c + Q^T f(v_c, q) = 0,
   *
   * and the rows of the chuck, see CoupledSystem. The
   * interface's tangent is exact; for Neo-Hookean bodies the bulk's is the one
   * that was condensed last, and is formed anew when the bulk's residual
   * shrinks too slowly with it. Where points change between stick and slip
   * without an end, corrections are shortened until the residual falls. Never
   * returns converged = true unless the residual of the true law meets the
   * tolerance.
   */
  NewtonResult
  solve_newton(CoupledSystem &system, const NewtonOptions &options);
} // namespace Debond
