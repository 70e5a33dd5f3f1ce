#ifndef debond_models_simulation_h
#define debond_models_simulation_h

#include <debond/models/state_checks.h>
#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>
#include <debond/system/adaptive_stepping.h>
#include <debond/system/coupled_system.h>
#include <debond/system/path_following.h>
#include <debond/system/planned_steps.h>
#include <debond/system/step_solver.h>

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace Debond
{
  class Simulation;

  /** What looks on while a simulation runs. Each function may throw to end it;
   *  the simulation is then in the last accepted state. */
  class SimulationObserver
  {
  public:
    virtual ~SimulationObserver() = default;
    /** run() begins: with the first row, or after some rows if it goes on. */
    virtual void
    started(const Simulation & /*simulation*/)
    {}
    /** There are rows, and a further one is to be solved for. */
    virtual void
    next_row(const Simulation & /*simulation*/)
    {}
    /** A step was accepted: the row at work may need several. */
    virtual void
    step_accepted(const Simulation & /*simulation*/)
    {}
    /** The newest row; the system is in its state. */
    virtual void
    row(const Simulation & /*simulation*/, const TorqueRow & /*row*/)
    {}
    /** A check was not passed for the first time, see Simulation::warnings().
     */
    virtual void
    warned(const Warning & /*warning*/)
    {}
    /** There is no further row. */
    virtual void
    finished(const Simulation & /*simulation*/)
    {}
  };



  /**
   * The model `finite elements`: from a scene to a sequence of accepted states,
   * each at the end of a row of the torque curve,
   *
   *     Simulation simulation(scene);
   *     simulation.run();
   *     for (const TorqueRow &row : simulation.rows()) ...
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
     *  CoupledSystem. Throws InputError if there is not enough memory. */
    explicit Simulation(const Scene              &scene,
                        std::shared_ptr<BodyPair> bodies = nullptr,
                        dealii::TimerOutput      *timer  = nullptr);
    Simulation(const Simulation &) = delete; ///< its parts refer to each other

    /** @p observer is told from now on, after those before; it must outlive
     *  run() and advance(). */
    void
    add(SimulationObserver &observer);

    /** Solves for all rows that are left. Throws RunError where the load cannot
     *  be followed; the rows before stay. Throws InputError if an expression of
     *  the scene has no finite value. */
    void
    run();
    /** Solves for one more row; the first is the state at the first time. */
    void
    advance();
    bool
    is_finished() const
    {
      return step_control.is_finished();
    }

    const Scene &
    scene() const
    {
      return the_scene;
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
    const StateChecks &
    checks() const
    {
      return state_checks;
    }
    const StepControl &
    control() const
    {
      return step_control;
    }
    const std::vector<Warning> &
    warnings() const
    {
      return all_warnings;
    }

    /** Time of the last accepted state. */
    double
    time() const
    {
      return solver.time();
    }
    /** Number of accepted steps, sub-steps included. */
    unsigned int
    n_steps() const
    {
      return solver.n_steps();
    }
    /** Time of the shortest accepted step; NaN before the first. */
    double
    smallest_step() const
    {
      return shortest_step;
    }
    /** Of all attempts, also of those that failed. */
    unsigned int
    newton_iterations() const
    {
      return all_iterations;
    }

    /** See serialization.h. Between rows; a simulation that is loaded is one of
     *  the same scene that has just been constructed. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &coupled_system &solver &state_checks;
      std::visit([&archive](auto &steps) { archive &steps; }, steps);
      archive &all_rows &all_warnings &all_iterations &shortest_step;
    }

  private:
    using Steps = std::variant<PlannedSteps, AdaptiveStepping, PathFollowing>;

    static Steps
    choose_steps(const Scene &scene);
    void
    solve_first_row();
    void
    solve_row();
    StepState
    state() const;
    void
    accept(const StepResult &result);
    void
    add_row(const InterfaceSummary &summary, unsigned int iterations);
    [[noreturn]] void
    give_up(const Step &step, const StepResult &result) const;
    void
    refuse_jump(const StepResult &result) const;
    void
    judge_whole_run();
    void
    warn(const Warning &warning);
    template <typename Function>
    void
    tell(const Function &function) const;

    const Scene                       the_scene;
    CoupledSystem                     coupled_system;
    StepSolver                        solver;
    Steps                             steps;
    StepControl                      &step_control; ///< of the above
    StateChecks                       state_checks;
    std::vector<SimulationObserver *> observers;
    std::vector<TorqueRow>            all_rows;
    std::vector<Warning>              all_warnings;
    unsigned int                      all_iterations = 0;
    double                            shortest_step  = CurveMeasures::undefined;
  };
} // namespace Debond
#endif
