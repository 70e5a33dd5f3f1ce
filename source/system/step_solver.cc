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



  // Near the solution if nothing happens in the step that did not in the last
  // one.
  const StepSolver::Attempt StepSolver::extrapolated{true, false, false};
  const StepSolver::Attempt StepSolver::from_rest{false, false, false};
  // A load that cannot be followed: the machine may have to jump.
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
    if (!step.by_slip() && turns_too_far(step.whole_time))
      {
        result.why = "a step may turn the chuck by 5 degrees at most";
        return result;
      }
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



  // Whether the direction of slip would turn too far in a step to @p time.
  bool
  StepSolver::turns_too_far(const double time) const
  {
    if (parameters.chuck.component[ChuckComponent::rotation_z].loaded ||
        !parameters.has_friction())
      return false;
    const Chuck::Vector6 change =
      system.chuck.values(time) - system.chuck.values(accepted_time);
    return std::abs(change[ChuckComponent::rotation_z]) >
           (1. + 1e-9) * largest_turn;
  }



  void
  StepSolver::start(const Attempt &attempt, const Step &step)
  {
    // accepted states are numbered along a path
    const double parameter =
      parameters.load_steps.follow_path ? n_steps() + step.ratio : step.time;
    system.predict(step.time, parameter, attempt.extrapolates);
    if (step.by_slip())
      system.prescribe_slip(step.slip);
    if (attempt.relaxes_machine)
      system.chuck.relax_machine();
    if (parameters.load_steps.predictor == Predictor::none)
      system.leave_surface_behind();
  }



  NewtonOptions
  StepSolver::options(const Attempt &attempt, const Step &step) const
  {
    const Predictor predictor = parameters.load_steps.predictor;
    NewtonOptions   options;
    options.residual_tolerance = parameters.load_steps.residual_tolerance;
    // points that stick would pull back at once all of a relaxed machine
    options.points.stick_first =
      !attempt.relaxes_machine &&
      (predictor == Predictor::stick_first ||
       (predictor == Predictor::extrapolate && !attempt.extrapolates));
    options.points.duration        = step.time - accepted_time;
    options.shorten_in_cycles      = !attempt.jumps;
    options.points.touch_tolerance = 1e-12 * system.R;
    options.points.frictionless = !parameters.has_friction_after(accepted_time);
    return options;
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



  StepResult
  StepSolver::make(const Attempt &attempt, const Step &step)
  {
    start(attempt, step);
    const NewtonResult newton = solve_newton(system, options(attempt, step));
    StepResult         result;
    result.converged  = newton.converged;
    result.why        = newton.why;
    result.iterations = newton.iterations;
    result.interface  = system.interface.summarise();
    result.unique     = result.interface.steepest_softening < 1.;
    // smaller steps help a viscous interface only
    result.hopeless = result.converged && !result.unique &&
                      parameters.interface.viscosity == 0.;
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
