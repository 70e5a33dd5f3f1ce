#pragma once

#include <debond/system/coupled_system.h>
#include <debond/system/newton.h>
#include <debond/system/step_control.h>

#include <vector>

namespace Debond
{
  /** Largest rotation in a step [rad]. Works are summed over the chords of
   *  paths: 5 degrees cost a thousandth of the dissipation. */
  constexpr double largest_turn = 5. * M_PI / 180.;



  /** Outcome of a step. */
  struct StepResult : NewtonResult ///< of the last attempt
  {
    bool unique = false; ///< the law had only one solution at every point
    /** It cannot be unique in smaller steps either. */
    bool             hopeless = false;
    InterfaceSummary interface; ///< of the last attempt

    bool
    is_acceptable() const
    {
      return converged && unique;
    }
  };



  /**
   * Finds the state at the end of a step by one attempt of Newton's method
   * after the other, until one leads to a state that is to be accepted. The
   * state stays a trial until commit(); without one the system is rolled back.
   *
   * Equilibrium alone is not enough: where the friction law falls faster than
   * the interface is stiff, p |d mu/d g_s| > eps_t + eta / dt, a point has
   * several solutions of Eqs. (29) and (30), and which of them is found depends
   * on the start. Such a state is not accepted. Making steps smaller is left to
   * the caller.
   */
  class StepSolver
  {
  public:
    /** Keeps references to both. Accepted states begin at the first time. */
    StepSolver(const ModelParameters &parameters, CoupledSystem &system);

    /** The state at the first time, from where the bodies were placed. */
    StepResult
    solve_first();
    StepResult
    solve(const Step &step);
    /** Accepts the state that has been found. */
    void
    commit();

    /** Of the last accepted state. */
    double
    time() const
    {
      return accepted_time;
    }
    /** Number of accepted steps; the first state is not one. */
    unsigned int
    n_steps() const
    {
      return n_states > 0 ? n_states - 1 : 0;
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &accepted_time &n_states;
    }

  private:
    /** Where Newton's method begins, and how it goes on. */
    struct Attempt
    {
      /** Begins on the line through the last two states. */
      bool extrapolates;
      /** Takes full corrections only, also where points go round in a cycle. */
      bool jumps;
      /** Begins where the springs of the machine are relaxed. */
      bool relaxes_machine;
      /** Points that leave a face over its edge do not come back. */
      bool leaves = false;
    };
    static const Attempt extrapolated, from_rest, over_edge, jump, beyond;
    /** Attempts at a step, in the order in which they are made. */
    std::vector<Attempt>
    attempts(const Step &step) const;

    StepResult
    make(const Attempt &attempt, const Step &step);

    const ModelParameters &parameters;
    CoupledSystem         &system;
    double                 accepted_time;
    unsigned int           n_states = 0;
  };
} // namespace Debond
