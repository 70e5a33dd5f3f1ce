#include <debond/models/debonding_run.h>
#include <debond/system/newton.h>

#include <cmath>
#include <sstream>

// The steps of class DebondingProblem: each function that solves for a row
// leaves through a complete row or an exception.

namespace Debond
{
  // Row 0: the state at the first time, solved like a step.
  void
  DebondingProblem::solve_first_row()
  {
    bool         accepted         = false;
    const double time             = state->stepping.time(0);
    state->time                   = time;
    const unsigned int iterations = try_sub_step(time, false, accepted);
    if (!accepted)
      throw RunError("The state at the first time, " + std::to_string(time) +
                     ", could not be found: " + state->last_failure);
    accept(time);
    write_row(iterations);
  }



  bool
  DebondingProblem::is_finished() const
  {
    if (!rows_are_accepted_steps())
      return state->step == state->stepping.n_steps();
    return state->phase == scene.load_steps.steps.size() ||
           (state->path && state->path->has_ended());
  }



  void
  DebondingProblem::solve_next_row()
  {
    if (state->adaptive_stepping)
      solve_adaptive_step();
    else if (state->path)
      solve_step_along_path();
    else
      solve_planned_step();
  }



  void
  DebondingProblem::solve_planned_step()
  {
    LoadStepping      &stepping   = state->stepping;
    unsigned int       iterations = 0;
    const unsigned int step       = ++state->step;
    // a new phase is not the continuation of the last one
    bool extrapolate = !stepping.begins_phase(step);
    for (stepping.begin(step); !stepping.finished();)
      {
        const double time = stepping.target_time();
        if (try_step(time, extrapolate, iterations))
          {
            accept(time);
            stepping.accept();
            extrapolate = true;
          }
        else if (!stepping.reject())
          give_up(step, time);
      }
    write_row(iterations);
  }



  void
  DebondingProblem::solve_adaptive_step()
  {
    CoupledSystem    &system     = *state->system;
    AdaptiveStepping &stepping   = *state->adaptive_stepping;
    unsigned int      iterations = 0;
    if (begin_phase_if_due())
      stepping.begin_phase(state->phase,
                           system.chuck_forces(),
                           system.chuck.values(state->time));
    while (true)
      {
        const double time = stepping.target_time();
        if (turns_too_far(time) || !try_middle(iterations) ||
            !try_step(time, state->extrapolate, iterations))
          {
            if (!stepping.reject())
              give_up(state->step + 1, time);
            continue;
          }
        const double error =
          stepping.error(system.chuck_forces(), system.chuck.values(time));
        if (error > 1. && stepping.shrink(error))
          {
            system.rollback(); // the curve bends too much for this step
            continue;
          }
        ++state->step;
        accept(time);
        stepping.accept(system.chuck_forces(), error);
        state->extrapolate = true;
        write_row(iterations);
        end_phase_if(stepping.phase_is_finished());
        return;
      }
  }



  void
  DebondingProblem::solve_step_along_path()
  {
    CoupledSystem &system     = *state->system;
    PathFollowing &path       = *state->path;
    unsigned int   iterations = 0;
    const auto     mean_slip  = [&]() {
      return system.interface.mean_slip(system.configuration).value;
    };
    if (begin_phase_if_due())
      path.begin_phase(state->phase, mean_slip());
    while (true)
      {
        const PathFollowing::Step step = state->path_step = path.next();
        const unsigned int        before                  = iterations;
        if (!try_step(step.time, step.extrapolate, iterations))
          {
            if (!path.reject(step))
              give_up(state->step + 1, system.time());
            continue;
          }
        if (!path.accept(step, system.time(), mean_slip(), iterations - before))
          {
            system.rollback(); // too far
            continue;
          }
        ++state->step;
        accept(system.time());
        write_row(iterations);
        end_phase_if(path.phase_is_finished());
        return;
      }
  }



  bool
  DebondingProblem::begin_phase_if_due()
  {
    const bool begins = !state->phase_is_begun;
    if (begins)
      state->extrapolate = false;
    state->phase_is_begun = true;
    return begins;
  }



  void
  DebondingProblem::end_phase_if(const bool is_finished)
  {
    if (!is_finished)
      return;
    ++state->phase;
    state->phase_is_begun = false;
  }



  bool
  DebondingProblem::rows_are_accepted_steps() const
  {
    return scene.load_steps.adaptive || scene.load_steps.follow_path;
  }



  // A trial in the middle of the step, where the step control wants one.
  bool
  DebondingProblem::try_middle(unsigned int &iterations)
  {
    AdaptiveStepping &stepping = *state->adaptive_stepping;
    if (!stepping.wants_middle())
      return true;
    if (!try_step(stepping.middle_time(), state->extrapolate, iterations))
      return false;
    stepping.note_middle(state->system->chuck_forces());
    state->system->rollback();
    return true;
  }



  bool
  DebondingProblem::try_step(const double  time,
                             const bool    extrapolate,
                             unsigned int &iterations)
  {
    if (!state->path_step.by_slip && turns_too_far(time))
      return false;
    bool       accepted = false;
    const bool predict =
      extrapolate && scene.load_steps.predictor == Predictor::extrapolate;
    iterations += try_sub_step(time, predict, accepted);
    // The prediction may be to blame. A step by its slip needs it: without,
    // nothing slides.
    if (!accepted && predict && !state->path_step.by_slip)
      iterations += try_sub_step(time, false, accepted);
    // the machine may have to jump
    if (!accepted && !state->path_step.by_slip &&
        !state->system->chuck.unknowns().empty())
      iterations += try_sub_step(time, false, accepted, Start::jump);
    // with viscosity nothing jumps in steps that are short enough
    if (!accepted && !state->path_step.by_slip &&
        state->system->chuck.has_compliant_machine() &&
        scene.interface.viscosity == 0.)
      iterations += try_sub_step(time, false, accepted, Start::beyond);
    return accepted;
  }



  bool
  DebondingProblem::turns_too_far(const double time)
  {
    const ChuckComponentParameters &rotation =
      scene.chuck.component[ChuckComponent::rotation_z];
    if (rotation.loaded ||
        scene.interface.friction.kind == FrictionLawKind::frictionless)
      return false;
    const Chuck &chuck = state->system->chuck;
    const bool   too_far =
      std::abs(chuck.values(time)[ChuckComponent::rotation_z] -
               chuck.values(state->time)[ChuckComponent::rotation_z]) >
      (1. + 1e-9) * largest_turn;
    if (too_far)
      state->last_failure = "a step may turn the chuck by 5 degrees at most";
    return too_far;
  }



  void
  DebondingProblem::give_up(const unsigned int step, const double time) const
  {
    std::ostringstream message;
    message << "Step " << step;
    if (!rows_are_accepted_steps())
      message << " of " << state->stepping.n_steps();
    message << " failed at time " << time << ", angle "
            << state->system->chuck.position()[ChuckComponent::rotation_z] *
                 180. / M_PI
            << " deg, with the smallest allowed part of a step: "
            << state->last_failure;
    if (!state->path && !state->system->chuck.unknowns().empty())
      message << ". A prescribed load may be more than the interface can "
                 "carry; prescribing the displacement or angle instead, or "
                 "Load steps / Path following = slip, follows the fall";
    throw RunError(message.str());
  }



  void
  DebondingProblem::start_trial(const double time, const bool extrapolate)
  {
    CoupledSystem &system = *state->system;
    if (!state->path)
      {
        system.predict(time, extrapolate);
        return;
      }
    // accepted states are numbered along the path
    system.predict(time,
                   state->accepted_steps + state->path_step.ratio,
                   extrapolate);
    if (state->path_step.by_slip)
      system.prescribe_slip(state->path_step.slip);
  }



  unsigned int
  DebondingProblem::try_sub_step(const double time,
                                 const bool   extrapolate,
                                 bool        &accepted,
                                 const Start  start)
  {
    CoupledSystem  &system    = *state->system;
    const Predictor predictor = scene.load_steps.predictor;
    NewtonOptions   options;
    options.residual_tolerance = scene.load_steps.residual_tolerance;
    options.stick_first        = predictor == Predictor::stick_first ||
                          (predictor == Predictor::extrapolate && !extrapolate);
    options.duration          = time - state->time;
    options.shorten_in_cycles = start == Start::as_before;
    options.touch_tolerance   = 1e-12 * system.R;
    options.frictionless      = !next_step_has_friction();
    start_trial(time, extrapolate);
    if (start == Start::beyond)
      {
        system.chuck.relax_machine();
        options.stick_first = false; // it would pull all of it back at once
      }
    if (predictor == Predictor::none)
      system.leave_surface_behind();
    const NewtonResult result = solve_newton(system, options);
    state->newton_iterations += result.iterations;
    state->last_failure = result.why;
    accepted            = is_unique() && result.converged;
    if (!accepted)
      system.rollback();
    return result.iterations;
  }



  // It starts at a planned time, up to rounding.
  bool
  DebondingProblem::next_step_has_friction() const
  {
    const std::vector<double> &times = scene.load_steps.times;
    return state->time >= scene.interface.friction.starts_at -
                            1e-9 * (times.back() - times.front());
  }



  // Smaller steps help a viscous interface only. A step that failed has failed
  // already; this may be why.
  bool
  DebondingProblem::is_unique()
  {
    InterfaceSummary &summary = state->interface_summary;
    summary                   = state->system->interface.summarise();
    if (summary.steepest_softening < 1.)
      return true;
    if (state->last_failure.empty() && scene.interface.viscosity == 0.)
      {
        std::ostringstream message;
        // there is one row for each step that is done, the first one's is 0
        message << "Step " << state->rows.size() << ", after time "
                << state->time << ": " << describe_softening(summary);
        throw RunError(message.str());
      }
    state->last_failure +=
      (state->last_failure.empty() ? "" : "; ") + describe_softening(summary);
    return false;
  }



  void
  DebondingProblem::accept(const double time)
  {
    CoupledSystem &system          = *state->system;
    const double   reaction_defect = system.reaction_defect();
    if (state->step > 0)
      {
        ++state->accepted_steps;
        state->smallest_step =
          std::fmin(state->smallest_step, std::abs(time - state->time));
        if (next_step_has_friction() &&
            scene.interface.friction.kind != FrictionLawKind::frictionless)
          state->checks.add_way(state->step, system.chuck, state->time, time);
      }
    system.commit(state->path ? state->accepted_steps : time);
    state->time = time;
    state->checks.add(state->step,
                      system,
                      state->interface_summary,
                      reaction_defect);
  }
} // namespace Debond
