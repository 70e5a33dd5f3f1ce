#include <debond/system/step_solver.h>

#include <cmath>
#include <sstream>

namespace Debond
{
  StepSolver::StepSolver(const ModelParameters &parameters,
                         CoupledSystem         &system)
    : parameters(parameters)
    , system(system)
    , accepted_time(parameters.load_steps.times.front())
  {}



  // From the straight line through the last two states: near the solution if
  // nothing happens in the step that did not in the last one.
  const StepSolver::Attempt StepSolver::extrapolated{true, false, false};
  // From the last state. The implant goes along with the chuck, and in the
  // first iteration closed points stick, so that it cannot cycle.
  const StepSolver::Attempt StepSolver::from_rest{false, false, false};
  // A load that cannot be followed: the machine may have to jump, and then a
  // residual that grows for a while is no reason to shorten corrections.
  const StepSolver::Attempt StepSolver::jump{false, true, false};
  // Beyond every state in which the springs of the machine pull, there is one
  // behind the fall.
  const StepSolver::Attempt StepSolver::beyond{false, true, true};



  std::vector<StepSolver::Attempt>
  StepSolver::attempts(const Step &step) const
  {
    const bool predicts = step.extrapolate && parameters.load_steps.predictor ==
                                                Predictor::extrapolate;
    if (step.by_slip()) // without a prediction nothing slides
      return {predicts ? extrapolated : from_rest};
    std::vector<Attempt> list;
    if (predicts)
      list.push_back(extrapolated);
    list.push_back(from_rest); // the prediction may be to blame
    if (!system.chuck.unknowns().empty())
      list.push_back(jump);
    // with viscosity nothing jumps in steps that are short enough
    if (system.chuck.has_compliant_machine() &&
        parameters.interface.viscosity == 0.)
      list.push_back(beyond);
    return list;
  }



  // Nothing has happened before the first time: one attempt, from where the
  // bodies were placed.
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
    // A sliding point is pulled along the chord of its path. If that turns too
    // far from the direction at its end the step is not even tried.
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
    // order is that of what they cost and of how far they may lead away.
    unsigned int iterations = 0;
    for (const Attempt &attempt : attempts(step))
      {
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
    describe_softening(const InterfaceSummary &summary, const FrictionLaw &law)
    {
      const double       slope = summary.softening_slope;
      std::ostringstream text;
      text << "the friction law softens faster than the interface is stiff, so "
              "that its local solution is not unique and the bond would break "
              "in a jump: at a pressure of p = "
           << summary.softening_pressure
           << " MPa the stiffness eps_t (with Viscosity: and eta over the "
              "step's duration) makes p / eps_t = "
           << summary.steepest_softening / slope
           << " mm, and less than 1 / |d mu/d g_s| = " << 1. / slope
           << " mm has one solution. What helps: Interface / Viscosity, a "
              "larger Interface / Tangential penalty stiffness, a larger "
           << law.entries_against_fall();
      return text.str();
    }
  } // namespace



  // One attempt: where Newton's method begins, how it goes on, and what is to
  // be thought of where it ends.
  StepResult
  StepSolver::make(const Attempt &attempt, const Step &step)
  {
    // Where it begins. Accepted states are numbered along a path.
    const LoadSteppingParameters &load_steps = parameters.load_steps;
    system.predict(step.time,
                   load_steps.follow_path ? n_steps() + step.ratio : step.time,
                   attempt.extrapolates);
    if (step.by_slip())
      system.prescribe_slip(step.slip);
    if (attempt.relaxes_machine)
      system.chuck.relax_machine();
    if (load_steps.predictor == Predictor::none)
      system.leave_surface_behind();

    // How it goes on. Points that stick would pull back at once all of a
    // relaxed machine.
    NewtonOptions options;
    options.residual_tolerance = load_steps.residual_tolerance;
    options.points.stick_first =
      !attempt.relaxes_machine &&
      (load_steps.predictor == Predictor::stick_first ||
       (load_steps.predictor == Predictor::extrapolate &&
        !attempt.extrapolates));
    options.points.duration        = step.time - accepted_time;
    options.points.touch_tolerance = 1e-12 * system.R;
    options.points.frictionless = !parameters.has_friction_after(accepted_time);
    options.shorten_in_cycles   = !attempt.jumps;

    // What became of it. Where the law falls so steeply that the point's
    // equations have more than one solution, Newton's method finds any of them:
    // p |d mu/d g_s| / eps_t < 1 is needed at every point (doc/model.md,
    // Uniqueness).
    StepResult result;
    static_cast<NewtonResult &>(result) = solve_newton(system, options);
    result.interface                    = system.interface.summarise();
    result.unique = result.interface.steepest_softening < 1.;
    // smaller steps help only where friction resists the speed
    result.hopeless = result.converged && !result.unique &&
                      parameters.interface.viscosity == 0. &&
                      !parameters.interface.friction->depends_on_rate();
    // a step that failed has failed already; this may be why
    if (!result.unique)
      result.why +=
        (result.why.empty() ? "" : "; ") +
        describe_softening(result.interface, *parameters.interface.friction);
    if (!result.is_acceptable())
      system.rollback();
    return result;
  }



  void
  StepSolver::commit()
  {
    ++n_states;
    accepted_time = system.time();
    system.commit(parameters.load_steps.follow_path ? n_steps() :
                                                      accepted_time);
  }
} // namespace Debond
