#pragma once

#include <debond/models/state_checks.h>
#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>
#include <debond/support/input_error.h>
#include <debond/support/ranks.h>
#include <debond/support/serialization.h>
#include <debond/system/coupled_system.h>
#include <debond/system/step_control.h>
#include <debond/system/step_solver.h>

#include <boost/signals2/signal.hpp>

#include <limits>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace Debond
{
  /**
   * The model `finite elements`: from a scene to a sequence of accepted states,
   * each at the end of a row of the torque curve,
   *
   *     Simulation simulation(scene);
   *     simulation.run();
   *     for (const TorqueRow &row : simulation.rows()) ...
   *
   * Each state solves, in the control points of both contact surfaces and the
   * loaded components of the chuck, the equations of CoupledSystem: contact and
   * friction of the paper, Eqs. (11) to (13) and (23) to (36), between two
   * bodies that are rigid, linear or Neo-Hookean, Eq. (1).
   *
   * It knows no directory, console, clock, signal or file; what does looks on.
   * The checks that make a state trustworthy belong to it: that the residual
   * meets the tolerance and the law had one solution, else a step is not
   * accepted; and StateChecks, whose results are warnings and figures in the
   * rows.
   */
  class Simulation
  {
  public:
    /** Builds meshes and interface of @p scene, of which the subsections
     *  `Study` and `Output` have no meaning here. @p bodies and @p timer: see
     *  CoupledSystem. The ranks that work together now do so in all that
     *  follows, wherever it is called. Throws InputError if there is not enough
     *  memory, or if they have different scenes. */
    explicit Simulation(const Scene              &scene,
                        std::shared_ptr<BodyPair> bodies = nullptr,
                        dealii::TimerOutput      *timer  = nullptr);
    Simulation(const Simulation &) = delete; ///< its parts refer to each other

    /** For who looks on while the simulation runs. A function that is connected
     *  may throw to end it; the simulation can go on from its last row. */
    struct Signals
    {
      /** The newest row, which is complete: the system is in its state, and it
       *  stays if a function throws. */
      boost::signals2::signal<void(const TorqueRow &)> row;
      /** A check was not passed for the first time, see warnings(). The row at
       *  work is not complete yet, and is taken back if a function throws. */
      boost::signals2::signal<void(const Warning &)> warning;
    };
    Signals signals;

    /** Solves for all rows that are left. Throws RunError where the load cannot
     *  be followed; the rows before stay. Throws InputError if an expression of
     *  the scene has no finite value. */
    void
    run();
    /** Solves for one more row; the first is the state at the first time. For
     *  programs that want to look at every state themselves. Throws as run()
     *  does.
     *
     *  All or nothing: whatever is thrown, from here or by a function of the
     *  scene, the simulation is in its last row, to the last bit, and what
     *  comes next is as if this had not been tried. If that state cannot be
     *  brought back, for instance because there is no memory, every call that
     *  follows throws RunError. Of several processes only RunError and
     *  InputError, which all of them meet, can be taken back. */
    void
    advance();
    bool
    is_finished() const
    {
      return step_control.is_finished();
    }

    const std::vector<TorqueRow> &
    rows() const
    {
      return all_rows;
    }
    /** Bodies, chuck and interface in the last accepted state. */
    const CoupledSystem &
    system() const
    {
      return coupled_system;
    }
    /** Works, energies and jumps so far. */
    const StateChecks &
    checks() const
    {
      return state_checks;
    }
    /** Where in the load history the simulation is, and why it ends. */
    const StepControl &
    control() const
    {
      return step_control;
    }
    /** What the checks found, each once; known from the beginning is what the
     *  scene itself warns of. */
    const std::vector<Warning> &
    warnings() const
    {
      return all_warnings;
    }
    /** Between the times of `Output / Motion between', as far as they have been
     *  reached; without them up to the last row. */
    std::vector<RelativeMotion>
    motions() const;

    /** What the measures of the torque curve refer to: contact area, initial
     *  bonding and phases. */
    CurveSettings
    curve_settings() const;

    /** What summary.json is to tell of the steps: `steps`, `smallest_step`,
     *  `newton_iterations`, also of attempts that failed. */
    struct Effort
    {
      unsigned int steps = 0; ///< accepted, sub-steps included
      /** Time of the shortest accepted step. */
      double       smallest_step     = std::numeric_limits<double>::quiet_NaN();
      unsigned int newton_iterations = 0;
    };
    const Effort &
    effort() const
    {
      return so_far;
    }

    /** See serialization.h. Between rows; a simulation that is loaded is one of
     *  the same scene that has just been constructed. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      const Ranks::Together            together(team);
      archive &coupled_system &solver &state_checks;
      archive &so_far.steps &so_far.newton_iterations &so_far.smallest_step;
      archive                                         &accepted_rates;
      std::visit([&archive](auto &chosen) { archive &chosen; }, steps);
      archive &motion_goes_on &motion_begins;
      if constexpr (!is_in_memory<Archive>) // what a row is appended to
        archive &all_rows &all_warnings &all_motions;
      if (Archive::is_loading::value)
        rates = accepted_rates;
    }

    const Scene scene;

  private:
    using Steps = std::variant<PlannedSteps, AdaptiveStepping, PathFollowing>;

    // A step in order: solve_row() asks the control of steps which one to
    // try and has the solver look for the state at its end, accept() makes it
    // history, add_row() says what came of it.
    Steps
    choose_steps() const;
    void
    solve_first_row();
    void
    solve_row();
    StepState
    state() const;
    StepState
    end_of_step(const Step &step);
    void
    accept(const StepResult &result);
    void
    add_row(const InterfaceSummary &summary, unsigned int iterations);
    /** @name Motions between times */
    //@{
    std::optional<double>
    next_mark(double time) const;
    void
    mark_motion();
    void
    add_motion(double time);
    //@}
    void
    set_rates(TorqueRow &row) const;
    [[noreturn]] void
    give_up(const Step &step, const StepResult &result) const;
    void
    judge_whole_run();
    void
    warn(const Warning &warning);

    const Ranks::TeamPointer   team;
    dealii::TimerOutput *const timer;
    // In this order, because each refers to those before.
    CoupledSystem               coupled_system;
    StepSolver                  solver;
    Steps                       steps;
    StepControl                &step_control; ///< the one that was chosen
    StateChecks                 state_checks;
    std::vector<TorqueRow>      all_rows;
    std::vector<Warning>        all_warnings;
    std::vector<RelativeMotion> all_motions;
    bool                        motion_goes_on = false;
    double                      motion_begins  = 0.; ///< its first time
    Effort                      so_far;
    double               reaction_defect = 0; ///< of the last accepted state
    CoupledSystem::Rates rates; ///< of the last step that was solved
    CoupledSystem::Rates accepted_rates;
    SavedState           last_row; ///< while the next one is at work
    /** A row failed, and the state of the last one could not be restored. */
    bool is_lost = false;
  };
} // namespace Debond
