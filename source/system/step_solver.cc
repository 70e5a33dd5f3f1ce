#include <debond/support/number_text.h>
#include <debond/system/step_solver.h>

#include <cmath>

// Section 4 of doc/developers/walk.md: the state at the end of a step. The
// paper goes through 100 to 2500 load steps and does not say what happens when
// one does not converge. Here a failure is met first by another start of
// Newton's method, and by a smaller step only then, for which Simulation asks.
namespace Debond
{
  // Row 0 is a step like any other, but with no time before it: the first time
  // of the scene counts as accepted until it is solved.
  StepSolver::StepSolver(const ModelParameters &parameters,
                         CoupledSystem         &system)
    : parameters(parameters)
    , system(system)
    , accepted_time(parameters.load_steps.times.front())
  {}



  // From the straight line through the last two states: near the solution if
  // nothing happens in the step that did not in the last one. Where a phase of
  // the loading begins, for instance the rotation after the push-in, or where
  // many points begin to slide, the line points elsewhere.
  const StepSolver::Attempt StepSolver::extrapolated{true, false, false};
  // From the last state. The implant goes along with the chuck, and in the
  // first iteration closed points stick, so that it cannot cycle.
  const StepSolver::Attempt StepSolver::from_rest{false, false, false};
  // What leaves over an edge may come back as it lets go, and leave again.
  const StepSolver::Attempt StepSolver::over_edge{false, false, false, true};
  // A load that cannot be followed: the machine may have to jump, and then a
  // residual that grows for a while is no reason to shorten corrections.
  // Shortened ones may end where the residual is smallest, which need not be a
  // state of equilibrium.
  const StepSolver::Attempt StepSolver::jump{false, true, false};
  // Where the springs of the machine are relaxed the chuck stands where the
  // machine does: beyond every state in which they pull. If there is a state of
  // equilibrium behind the fall of the torque, it lies before this one.
  const StepSolver::Attempt StepSolver::beyond{false, true, true};



  // Which attempts a step has, cheapest and safest first. Each that fails costs
  // up to 25 iterations, so that none is made which cannot help.
  std::vector<StepSolver::Attempt>
  StepSolver::attempts(const Step &step) const
  {
    // Along a path (doc/explanation/stability.md, Following the path) the
    // branch is the one that the line points to; another start would leave the
    // direction in which the path goes.
    if (step.by_slip()) // without a prediction nothing slides
      return {step.extrapolate ? extrapolated : from_rest};
    std::vector<Attempt> list;
    if (step.extrapolate)
      list.push_back(extrapolated);
    list.push_back(from_rest); // the prediction may be to blame
    list.push_back(over_edge);
    // A chuck that is loaded or compliant may have no state of equilibrium near
    // the last one, and find one only where it jumps to.
    if (!system.chuck.unknowns().empty())
      list.push_back(jump);
    // With viscosity nothing jumps in steps that are short enough, so that
    // halving the step is the remedy. A loaded component has no spring to be
    // relaxed.
    if (system.chuck.has_compliant_machine() && !system.interface.is_viscous())
      list.push_back(beyond);
    return list;
  }



  // Nothing has happened before the first time: one attempt, from where the
  // bodies were placed, undeformed. Points that are closed there start from
  // their closest points on the master and stick in the first iteration.
  StepResult
  StepSolver::solve_first()
  {
    Step step;
    step.time = accepted_time;
    return make(from_rest, step);
  }



  StepResult
  StepSolver::solve(const Step &step)
  {
    StepResult result;
    // Works are trapezoids over the chords of paths, which are too small by
    // angle^2 / 6 where points slide round in a circle, a thousandth at 5
    // degrees; along the trial gap friction itself is too small by cos(angle /
    // 2). Steps that turn further are not even tried: the residual would not
    // show it. It is the whole step that counts, even if only the first half of
    // it is on trial.
    // A rotation that is found, by a moment or along a path, is not known
    // before. Without friction there is no direction of slip.
    const auto turn = [&](const unsigned int k) {
      return system.chuck.values(step.whole_time)[k] -
             system.chuck.values(accepted_time)[k];
    };
    constexpr auto spin = ChuckComponent::rotation_z;
    if (!step.by_slip() && parameters.has_friction() &&
        !parameters.chuck.component[spin].loaded &&
        std::abs(turn(spin)) > (1. + 1e-9) * largest_turn)
      {
        result.why = "a step may turn the chuck by 5 degrees at most";
        return result;
      }
    // One attempt after the other, until the state is to be accepted. Their
    // order is that of what they cost and of how far they may lead away. A
    // state that is not unique, and would not be in smaller steps either, ends
    // this at once: other starts might find another solution, but none that is
    // more right. Iterations are summed, since they are the cost of the step.
    unsigned int iterations = 0;
    for (const Attempt &attempt : attempts(step))
      {
        if (system.interface.has_come_back() < attempt.leaves)
          continue;
        result = make(attempt, step);
        iterations += result.iterations;
        if (result.is_acceptable() || result.hopeless)
          break;
      }
    result.iterations = iterations;
    return result;
  }



  namespace
  {
    /** Why the bond would break in a jump. */
    std::string
    describe_softening(const InterfaceSummary    &summary,
                       const InterfaceParameters &interface)
    {
      // A user can act on it: the numbers of the worst point, and the entries
      // that move the bound -dL/dg_s < eps_t.
      return Text()
             << "the friction law softens faster than the interface is stiff, so "
                "that its local solution is not unique and the bond would break "
                "in a jump: at a pressure of p = "
             << summary.softening_pressure
             << " MPa the limit of the traction falls by up to "
             << summary.softening_slope
             << " MPa per mm of slip, and has one solution while that is less "
                "than the stiffness eps_t (with Viscosity: and eta over the "
                "step's duration), "
             << summary.softening_slope / summary.steepest_softening
             << " MPa/mm. What helps: Interface / Viscosity, a larger Interface "
                "/ Tangential stiffness, a larger "
             << interface.friction->entries_against_fall
             << (interface.joint()->pulls() ?
                   ", a smaller Adhesive friction or Strength" :
                   "");
    }
  } // namespace



  // One attempt: where Newton's method begins, how it goes on, and what is to
  // be thought of where it ends.
  StepResult
  StepSolver::make(const Attempt &attempt, const Step &step)
  {
    // Where it begins. The line through the last two states is drawn over the
    // time, or along a path, where time may stand still or fall, over the
    // number of the step; `ratio` is then the size of this one relative to the
    // last.
    const LoadSteppingParameters &load_steps = parameters.load_steps;
    system.predict(step.time,
                   load_steps.follow_path ? n_steps() + step.ratio : step.time,
                   attempt.extrapolates);
    // The step is measured by the growth of the mean sliding distance [mm], and
    // its time is only a guess.
    if (step.by_slip())
      system.prescribe_slip(step.slip);
    if (attempt.relaxes_machine)
      system.chuck.relax_machine();

    // How it goes on. The first iteration from the last state has all closed
    // points stick: sticking points are a linear spring, and cannot
    // go round between stick and slip. Not so after a relaxed machine: points
    // that stick would pull back at once all of it.
    NewtonOptions options;
    options.residual_tolerance = load_steps.residual_tolerance;
    options.points.stick_first =
      !attempt.relaxes_machine && !attempt.extrapolates;
    options.points.leaves_for_good = attempt.leaves;
    // For viscosity and rates, in the scene's unit of time.
    options.points.duration     = step.time - accepted_time;
    options.points.frictionless = !parameters.has_friction_after(accepted_time);
    options.shorten_in_cycles   = !attempt.jumps;

    // What became of it. Where the law falls so steeply that the point's
    // equations have more than one solution, Newton's method finds any of them:
    // p |d mu/d g_s| / eps_t < 1 is needed at every point
    // (doc/explanation/stability.md, One point), with p at the end of the step
    // and the steepest slope that the law still has before the point. With the
    // paper's law, Eq. (13), it is pi phi_0 (mu_ub - mu_b) / (4 a_s b_s). It is
    // judged after each attempt because p is not known before.
    StepResult result;
    static_cast<NewtonResult &>(result) = solve_newton(system, options);
    result.interface                    = system.interface.summarise();
    result.unique = result.interface.steepest_softening < 1.;
    // Smaller steps help only where friction resists the speed: eta / dt then
    // stands beside eps_t, and grows as the step is halved. A converged state
    // without that is the end of the run.
    result.hopeless = result.converged && !result.unique &&
                      parameters.interface.viscosity == 0. &&
                      !parameters.interface.friction->depends_on_rate;
    // a step that failed has failed already; this may be why
    if (!result.unique)
      result.why += (result.why.empty() ? "" : "; ") +
                    describe_softening(result.interface, parameters.interface);
    // A trial that is not accepted leaves no trace, so that the next attempt
    // starts from the same state as this one did.
    if (!result.is_acceptable())
      system.rollback();
    return result;
  }



  // The state that solve() found becomes history. Along a path the
  // time has been found, too, so it is asked for; states are then numbered,
  // since the line of the next prediction cannot be drawn over a time that
  // falls.
  void
  StepSolver::commit()
  {
    ++n_states;
    accepted_time = system.time();
    system.commit(parameters.load_steps.follow_path ? n_steps() :
                                                      accepted_time);
  }
} // namespace Debond
