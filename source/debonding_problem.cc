#include <debond/adaptive_stepping.h>
#include <debond/closed_forms.h>
#include <debond/console.h>
#include <debond/coupled_system.h>
#include <debond/debonding_problem.h>
#include <debond/energy_balance.h>
#include <debond/field_output.h>
#include <debond/newton.h>
#include <debond/number_text.h>
#include <debond/path_following.h>
#include <debond/profile_output.h>
#include <debond/runtime.h>

#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <set>
#include <sstream>

namespace Debond
{
  /** Everything that lives as long as a run. */
  struct DebondingProblem::Run
  {
    explicit Run(const Scene &scene)
      : console(scene.output.console, std::cout)
      , timer(std::cout,
              dealii::TimerOutput::never,
              dealii::TimerOutput::wall_times)
      , stepping(scene.load_steps)
    {}

    Console                            console;
    dealii::TimerOutput                timer;
    dealii::Timer                      wall_clock;
    LoadStepping                       stepping;
    std::unique_ptr<AdaptiveStepping>  adaptive_stepping; ///< if wanted
    std::unique_ptr<ResultDirectory>   directory;
    std::shared_ptr<BodyPair>          given_bodies; ///< if there are any
    std::unique_ptr<CoupledSystem>     system;
    std::unique_ptr<TorqueCurveWriter> torque_writer;
    std::unique_ptr<FieldOutput>       field_output;
    std::unique_ptr<ProfileOutput>     profiles;
    ReferenceCurve                     reference;
    std::unique_ptr<PathFollowing>     path; ///< if wanted
    PathFollowing::Step                path_step;
    EnergyBalance                      energy;
    ReleasedEnergy                     released;
    /** Of the accepted state. */
    ContactInterface::Summary interface_summary;
    double                    reaction_defect = 0;
    /** Names of the checks that the next row does not pass. */
    std::set<std::string> violated_checks;

    std::vector<TorqueRow> rows;
    double                 time                 = 0; ///< of the accepted state
    double                 last_torque          = 0; ///< of the accepted state
    unsigned int           accepted_steps       = 0; ///< sub-steps included
    unsigned int           newton_iterations    = 0;
    unsigned int           step                 = 0; ///< planned step at work
    double                 seconds_before_steps = 0;
    std::string            last_failure;
    /** Time of the shortest accepted step. */
    double smallest_step = CurveMeasures::undefined;
  };



  DebondingProblem::DebondingProblem(const Scene              &scene,
                                     std::shared_ptr<BodyPair> bodies)
    : scene(scene)
    , state(std::make_unique<Run>(scene))
  {
    state->given_bodies = std::move(bodies);
  }

  DebondingProblem::~DebondingProblem() = default;

  const std::vector<TorqueRow> &
  DebondingProblem::rows() const
  {
    return state->rows;
  }



  void
  DebondingProblem::run()
  {
    set_up();
    state->seconds_before_steps = state->wall_clock.wall_time();
    try
      {
        solve_first_row();
        if (scene.load_steps.adaptive)
          for (unsigned int phase = 0; phase < scene.load_steps.steps.size();
               ++phase)
            solve_phase_adaptively(phase);
        else if (state->path)
          for (unsigned int phase = 0; phase < scene.load_steps.steps.size();
               ++phase)
            solve_phase_along_path(phase);
        else
          for (unsigned int step = 1; step <= state->stepping.n_steps(); ++step)
            solve_planned_step(step);
      }
    catch (const std::exception &error)
      {
        finish(false, error.what());
        throw;
      }
    finish(true, reason_to_end());
  }



  std::string
  DebondingProblem::reason_to_end() const
  {
    if (state->path && state->path->has_ended())
      {
        std::ostringstream reason;
        reason << "the mean sliding distance has reached "
               << state->path->end_of_path()
               << " mm (Load steps / Path ends at slip) at time "
               << state->time;
        return reason.str();
      }
    return rows_are_accepted_steps() ? "the last time is reached" :
                                       "all planned steps are done";
  }



  namespace
  {
    std::string
    unknowns_of(const CoupledSystem &system)
    {
      std::ostringstream text;
      text << system.bone.mesh().n_dofs_as_published() +
                system.implant.mesh().n_dofs_as_published()
           << " degrees of freedom, "
           << system.bone.mesh().n_unknowns() +
                system.implant.mesh().n_unknowns()
           << " of them unknowns, " << system.n_unknowns()
           << " after condensation on the contact surfaces";
      return text.str();
    }



    void
    warn_of_locking(const BodyParameters &body,
                    const std::string    &name,
                    Console              &console)
    {
      if (body.material != Material::rigid && body.poisson_ratio > 0.45)
        console.warn("locking of " + name,
                     name +
                       " / Poisson ratio = " + to_text(body.poisson_ratio) +
                       ": trilinear cells lock as it approaches 0.5, so that "
                       "the body is too stiff: compare with finer Cells");
    }
  } // namespace



  void
  DebondingProblem::set_up()
  {
    state->directory =
      std::make_unique<ResultDirectory>(scene.output,
                                        scene.completed_parameters);
    state->reference = read_reference_curve(scene.output.reference_curve);
    state->torque_writer =
      std::make_unique<TorqueCurveWriter>(*state->directory);
    state->profiles = std::make_unique<ProfileOutput>(scene, *state->directory);
    {
      const dealii::TimerOutput::Scope t(state->timer, "set-up");
      state->system = std::make_unique<CoupledSystem>(scene,
                                                      state->timer,
                                                      state->given_bodies);
    }
    if (scene.load_steps.adaptive)
      state->adaptive_stepping =
        std::make_unique<AdaptiveStepping>(scene.load_steps, state->system->R);
    if (scene.load_steps.follow_path)
      state->path = std::make_unique<PathFollowing>(scene);
    state->system->start(state->stepping.time(0));
    if (scene.output.fields_every > 0)
      state->field_output =
        std::make_unique<FieldOutput>(*state->directory,
                                      state->system->bone,
                                      state->system->implant,
                                      state->system->interface,
                                      state->system->chuck);
    if (!scene.title.empty())
      state->console.headline(scene.title);
    state->console.headline(unknowns_of(*state->system));
    warn_of_locking(scene.bone, "Bone", state->console);
    warn_of_locking(scene.implant, "Implant", state->console);
    write_bonding();
  }



  void
  DebondingProblem::write_bonding()
  {
    const BondingPattern &bonding = state->system->interface.bonding();
    if (scene.interface.bonding.pattern == BondingPatternKind::homogeneous)
      return;
    write_file(state->directory->file("bonding.csv"), bonding.table());
    state->console.warn("picture", bonding.report().remark);
    const ContactInterface &interface = state->system->interface;
    const double            seen      = interface.mean_seen_bonding();
    if (std::abs(seen - bonding.report().mean) > 0.01 * bonding.report().mean)
      state->console.warn("bonding",
                          "the quadrature points of the bone, which is the "
                          "slave, see a mean phi_0 of " +
                            to_text(seen, 4) + " instead of " +
                            to_text(bonding.report().mean, 4) +
                            ": Slave = implant meets it exactly, more elements "
                            "of the bone more closely");
    state->console.headline("Initial bonding: " + bonding.description());
  }



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
    write_row(0, iterations);
    write_fields(0);
  }



  void
  DebondingProblem::solve_planned_step(const unsigned int step)
  {
    LoadStepping &stepping   = state->stepping;
    unsigned int  iterations = 0;
    state->step              = step;
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
    write_row(step, iterations);
    write_fields(step);
  }



  void
  DebondingProblem::solve_phase_adaptively(const unsigned int phase)
  {
    CoupledSystem    &system      = *state->system;
    AdaptiveStepping &stepping    = *state->adaptive_stepping;
    unsigned int      iterations  = 0;
    bool              extrapolate = false;
    stepping.begin_phase(phase,
                         system.chuck_forces(),
                         system.chuck.values(state->time));
    while (!stepping.phase_is_finished())
      {
        const double time = stepping.target_time();
        if (!try_middle(extrapolate, iterations) ||
            !try_step(time, extrapolate, iterations))
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
        extrapolate = true;
        write_row(state->step, iterations);
        write_fields(state->step);
        iterations = 0;
      }
  }



  void
  DebondingProblem::solve_phase_along_path(const unsigned int phase)
  {
    CoupledSystem &system     = *state->system;
    PathFollowing &path       = *state->path;
    unsigned int   iterations = 0;
    const auto     mean_slip  = [&]() {
      return system.interface.mean_slip(system.configuration).value;
    };
    path.begin_phase(phase, mean_slip());
    while (!path.phase_is_finished() && !path.has_ended())
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
        write_row(state->step, iterations);
        write_fields(state->step);
        iterations = 0;
      }
  }



  bool
  DebondingProblem::rows_are_accepted_steps() const
  {
    return scene.load_steps.adaptive || scene.load_steps.follow_path;
  }



  // A trial in the middle of the step, where the step control wants one.
  bool
  DebondingProblem::try_middle(const bool extrapolate, unsigned int &iterations)
  {
    AdaptiveStepping &stepping = *state->adaptive_stepping;
    if (!stepping.wants_middle())
      return true;
    if (!try_step(stepping.middle_time(), extrapolate, iterations))
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



  // A sliding point is pulled along the chord of its way, at an angle of half
  // the rotation to its direction at the end: 5 degrees cost a thousandth.
  bool
  DebondingProblem::turns_too_far(const double time)
  {
    const ChuckComponentParameters &rotation = scene.chuck.component[5];
    if (rotation.loaded ||
        scene.interface.friction.kind == FrictionLawKind::frictionless)
      return false;
    constexpr double largest_turn = 5. * M_PI / 180. * (1. + 1e-9);
    const Chuck     &chuck        = state->system->chuck;
    const bool       too_far      = std::abs(chuck.values(time)[5] -
                                  chuck.values(state->time)[5]) > largest_turn;
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
            << state->system->chuck.position()[5] * 180. / M_PI
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
    // a planned time, up to rounding
    options.frictionless =
      state->time <
      scene.interface.friction.starts_at -
        1e-9 * (scene.load_steps.times.back() - scene.load_steps.times.front());
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



  namespace
  {
    std::string
    describe_jump(const ContactInterface::Summary &summary)
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
              "Sliding threshold or Transition factor";
      return text.str();
    }
  } // namespace



  // Smaller steps help a viscous interface only. A step that failed has failed
  // already; this may be why.
  bool
  DebondingProblem::is_unique()
  {
    ContactInterface::Summary &summary = state->interface_summary;
    summary                            = state->system->interface.summarise();
    if (summary.steepest_softening < 1.)
      return true;
    if (state->last_failure.empty() && scene.interface.viscosity == 0.)
      {
        std::ostringstream message;
        message << "Step " << state->step << ", after time " << state->time
                << ": " << describe_jump(summary);
        throw RunError(message.str());
      }
    state->last_failure +=
      (state->last_failure.empty() ? "" : "; ") + describe_jump(summary);
    return false;
  }



  namespace
  {
    // Beyond that a point may find no partner, or the wrong one [mm].
    double
    deepest_penetration(const Scene &scene, const CoupledSystem &system)
    {
      double smallest =
        0.1 * std::min(scene.bone.thickness(), scene.implant.thickness());
      const auto   n    = system.implant.surface().n_elements();
      const double area = system.interface.implant_area();
      return std::min(smallest, std::sqrt(area / n));
    }
  } // namespace



  void
  DebondingProblem::accept(const double time)
  {
    CoupledSystem &system  = *state->system;
    state->reaction_defect = system.reaction_defect();
    if (state->step > 0)
      {
        ++state->accepted_steps;
        state->smallest_step =
          std::fmin(state->smallest_step, std::abs(time - state->time));
      }
    system.commit(state->path ? state->accepted_steps : time);
    state->energy.add(system.chuck_forces(),
                      system.chuck.position(),
                      system.bone.energy() + system.implant.energy(),
                      state->interface_summary.energy,
                      system.interface.dissipation());
    state->time = time;
    check_for_jump();
    check_accepted_state();
  }



  void
  DebondingProblem::note_violation(const std::string &check,
                                   const std::string &text)
  {
    state->console.warn(check, text);
    state->violated_checks.insert(check);
  }



  // Whether the state just accepted is on another branch of equilibrium.
  void
  DebondingProblem::check_for_jump()
  {
    // the explicit law does not spend what friction_work() says
    if (scene.interface.explicit_friction)
      return;
    CoupledSystem          &system    = *state->system;
    const ContactInterface &interface = system.interface;
    ReleasedEnergy::State   now;
    now.forces   = system.chuck_forces();
    now.position = system.chuck.machine_position();
    now.stored   = system.chuck.machine_energy() + system.bone.energy() +
                 system.implant.energy() + state->interface_summary.energy;
    now.spent             = interface.friction_work();
    now.bound             = interface.friction_work_bound();
    const double released = state->released.add(now);
    if (released > 0.)
      {
        std::ostringstream text;
        text << "step " << state->step << ": in one step the torque went from "
             << state->last_torque << " to " << now.forces[5] << " N mm, and "
             << released
             << " N mm of stored energy were released without equilibrium: the "
                "load cannot be followed there, the state jumped to another "
                "branch. Load steps / Path following = slip follows the path "
                "between";
        note_violation("jump", text.str());
      }
    state->last_torque = now.forces[5];
  }



  // What a user has to know about a state that has just been accepted. That it
  // solves the equations, and is the only solution, was asked before.
  void
  DebondingProblem::check_accepted_state()
  {
    const ContactInterface::Summary &summary = state->interface_summary;
    const std::string where = "step " + std::to_string(state->step) + ": ";
    if (summary.bonded_opened > 0)
      note_violation(
        "opening",
        where + "bonded points open (" + std::to_string(summary.bonded_opened) +
          "): the law has no strength in tension, so that pulling costs nothing" +
          (scene.interface.opening_breaks_bond ?
             "" :
             ", and points that close again are "
             "bonded as before"));
    const double too_deep = deepest_penetration(scene, *state->system);
    if (summary.max_penetration > too_deep)
      {
        std::ostringstream text;
        text << where << "the bodies penetrate each other by "
             << summary.max_penetration << " mm, more than " << too_deep
             << " mm, a tenth of the thinner one or a whole surface element: "
                "lengths are mm, is the push-in right?";
        note_violation("penetration", text.str());
      }
    if (state->system->interface.n_unprojected() > 0)
      note_violation("projection",
                     where + "for " +
                       std::to_string(
                         state->system->interface.n_unprojected()) +
                       " open points no closest point of the other surface was "
                       "found: they stay open");
    if (state->reaction_defect > 1e-6)
      {
        std::ostringstream text;
        text
          << where
          << "contact forces and the reaction of the implant's top differ by "
          << state->reaction_defect << " of the larger";
        note_violation("reaction", text.str());
      }
    check_energy_balance(where);
  }



  void
  DebondingProblem::check_energy_balance(const std::string &where)
  {
    const EnergyBalance &energy = state->energy;
    if (energy.dissipates_too_much())
      note_violation("dissipation",
                     where +
                       "more energy is dissipated than was put in: the steps "
                       "are too large for the energy balance to be trusted");
    if (energy.is_given_back(state->system->interface.step_dissipation()))
      note_violation("dissipation falls",
                     where + "sliding gives energy back: points slide along "
                             "their traction instead of against it");
    if (energy.is_out_of_balance())
      {
        std::ostringstream text;
        text << where << "of the chuck's work, " << energy.defect()
             << " of its largest value is neither stored nor dissipated; the "
                "size of the steps accounts for "
             << energy.defect_bound();
        note_violation("energy balance", text.str());
      }
  }



  void
  DebondingProblem::write_row(const unsigned int step,
                              const unsigned int iterations)
  {
    CoupledSystem        &system   = *state->system;
    const auto           &summary  = state->interface_summary;
    const Chuck::Vector6 &q        = system.chuck.position();
    const Chuck::Vector6  reaction = system.chuck_resultant();

    TorqueRow row;
    row.step                 = step;
    row.time                 = state->time;
    row.angle_deg            = q[5] * 180. / M_PI;
    row.torque_Nmm           = system.chuck_forces()[5];
    row.force_N              = 0. - reaction[2]; // no negative zero
    row.pressure_MPa         = row.force_N / system.interface.implant_area();
    row.phi_mean             = summary.phi_mean;
    row.share_stick          = summary.share_stick;
    row.share_slip           = summary.share_slip;
    row.share_open           = summary.share_open;
    row.newton_iterations    = iterations;
    row.energy_defect        = state->energy.defect();
    row.work_Nmm             = state->energy.work();
    row.energy_bulk_Nmm      = system.bone.energy() + system.implant.energy();
    row.energy_interface_Nmm = summary.energy;
    row.dissipation_Nmm      = system.interface.dissipation();
    row.adhesive_work_Nmm    = system.interface.adhesive_work();
    row.energy_defect_bound  = state->energy.defect_bound();
    row.reaction_defect      = state->reaction_defect;
    row.viscous_work_Nmm     = system.interface.viscous_work();
    row.warnings             = state->violated_checks.size();
    state->violated_checks.clear();
    row.machine_angle_deg   = system.chuck.machine_position()[5] * 180. / M_PI;
    row.released_energy_Nmm = state->released.total();
    for (unsigned int k = 0; k < 6; ++k)
      {
        row.chuck_reaction[k] = reaction[k];
        row.chuck_position[k] = q[k] * (k < 3 ? 1. : 180. / M_PI);
      }
    state->rows.push_back(row);

    const dealii::TimerOutput::Scope t(state->timer, "output");
    state->torque_writer->write(row);
    state->console.row(row,
                       rows_are_accepted_steps() ? 0 :
                                                   state->stepping.n_steps());
    state->profiles->write(row.angle_deg, system.interface);
  }



  void
  DebondingProblem::write_fields(const unsigned int step)
  {
    if (!state->field_output)
      return;
    const LoadStepping &stepping = state->stepping;
    const bool          phase_is_finished =
      state->adaptive_stepping ? state->adaptive_stepping->phase_is_finished() :
               state->path              ? state->path->phase_is_finished() ||
                      state->path->has_ended() :
                             false;
    const bool is_due =
      rows_are_accepted_steps() ?
        step % scene.output.fields_every == 0 || phase_is_finished ||
          step == 0 :
        stepping.step_in_phase(step) % scene.output.fields_every == 0 ||
          stepping.ends_phase(step);
    if (is_due)
      {
        const dealii::TimerOutput::Scope t(state->timer, "output");
        state->field_output->write(state->time);
      }
  }



  namespace
  {
    void
    add_bonding(const BondingPattern::Report &bonding, JsonObject &json)
    {
      json.add("phi_0_mean", bonding.mean);
      json.add("bonded_area_mm2", bonding.bonded_area);
      json.add("bonded_patches", bonding.patches);
      json.add("largest_bonded_patch_mm2", bonding.largest_patch);
    }
  } // namespace



  void
  DebondingProblem::finish(const bool converged, const std::string &reason)
  {
    const double seconds_stepping =
      state->wall_clock.wall_time() - state->seconds_before_steps;
    if (converged &&
        std::all_of(state->rows.begin(),
                    state->rows.end(),
                    [](const TorqueRow &row) { return row.share_open == 1.; }))
      state->console.warn("no contact", "the bodies are never in contact");
    state->console.warn("profile", state->profiles->finish());
    if (converged && state->path && state->path->has_ended() &&
        scene.load_steps.path_ends_at_slip == 0.)
      state->console.warn("path", "the last time is not reached: " + reason);
    const CoupledSystem &system = *state->system;
    CurveSettings        settings;
    settings.contact_area_mm2 =
      scene.implant.shape == BodyShape::coin ?
        M_PI * scene.implant.radius * scene.implant.radius :
      scene.implant.shape == BodyShape::cap ?
        2. * M_PI * scene.implant.cap_radius * scene.implant.rise() :
        system.interface.implant_area();
    settings.mean_phi_0             = scene.output.observed_bonding > 0 ?
                                        scene.output.observed_bonding :
                                        system.interface.bonding().report().mean;
    settings.full_sliding_angle_deg = scene.output.full_sliding_angle;
    settings.phase_times            = scene.load_steps.times;
    settings.reference              = state->reference;

    RunSummary summary;
    summary.measures = measure_torque_curve(state->rows, settings);
    if (converged)
      state->console.warn("reference",
                          warning_about_reference(summary.measures, settings));
    summary.steps             = state->accepted_steps;
    summary.smallest_step     = state->smallest_step;
    summary.newton_iterations = state->newton_iterations;
    summary.dofs              = system.bone.mesh().n_dofs_as_published() +
                   system.implant.mesh().n_dofs_as_published();
    summary.unknowns =
      system.bone.mesh().n_unknowns() + system.implant.mesh().n_unknowns();
    summary.condensed_unknowns = system.n_unknowns();
    summary.converged          = converged;
    summary.reason             = reason;
    summary.warnings           = state->console.warnings();
    for (const auto &[section, seconds] :
         state->timer.get_summary_data(dealii::TimerOutput::total_wall_time))
      summary.seconds.emplace_back(section, seconds);
    summary.seconds.emplace_back("before steps", state->seconds_before_steps);
    summary.seconds.emplace_back("stepping", seconds_stepping);
    if (state->given_bodies)
      summary.seconds.emplace_back("shared set-up",
                                   state->given_bodies->seconds_shared);
    summary.wall_seconds     = state->wall_clock.wall_time();
    summary.profile_measures = state->profiles->measures();
    summary.peak_memory_MB   = peak_memory_MB();

    JsonObject json;
    add_summary(summary, json);
    add_bonding(system.interface.bonding().report(), json);
    json.add("jumps", state->released.n_jumps());
    json.add("released_energy_Nm", 1e-3 * state->released.total());
    write_file(state->directory->file("summary.json"), json.text());
    if (converged)
      {
        std::ostringstream text;
        if (std::isfinite(summary.measures.theta_max_deg))
          text << "Largest torque " << summary.measures.T_max_Nmm << " N mm at "
               << summary.measures.theta_max_deg << " deg, at the end "
               << summary.measures.T_inf_Nmm << " N mm. ";
        else
          {
            const auto &reaction = state->rows.back().chuck_reaction;
            text << "Force of the chuck at the end: " << reaction[0] << ", "
                 << reaction[1] << ", " << reaction[2] << " N. ";
          }
        text << "Results are in " << state->directory->path();
        state->console.headline(text.str());
        if (!state->console.quiet())
          state->timer.print_summary();
      }
  }



  namespace
  {
    // Stiffness of the two half spaces' disk-shaped parts of the surface per
    // area, [MPa/mm]: pressed (rigid punch) and twisted (Reissner-Sagoci), the
    // implant as a bar of its height.
    double
    in_series(const double a, const double b, const double c)
    {
      return 1. / (1. / a + 1. / b + 1. / c);
    }

    double
    compliance_free(const BodyParameters &body, const double stiffness)
    {
      return body.material == Material::rigid ?
               std::numeric_limits<double>::infinity() :
               stiffness;
    }



    // Whether the law has one solution at every point, with the mean pressure
    // for that of a point.
    void
    print_uniqueness(const Scene &scene, const double p, std::ostream &out)
    {
      const InterfaceParameters &interface = scene.interface;
      const double               slope =
        steepest_fall(interface.friction, interface.bonding.initial_bonding);
      const double missing = slope * p - interface.tangential_penalty;
      if (slope == 0. || interface.explicit_friction)
        return;
      out << "  p / eps_t " << p / interface.tangential_penalty
          << " mm; the friction law has one solution below " << 1. / slope
          << " mm\n";
      if (missing >= 0. && interface.viscosity == 0.)
        out << "  so the run will be refused: Interface / Viscosity, a larger "
               "Tangential penalty stiffness, Sliding threshold or Transition "
               "factor helps\n";
      else if (missing >= 0.)
        out << "  so Viscosity makes it unique in steps shorter than "
            << interface.viscosity / missing << " of time\n";
    }



    void
    print_forecast(const Scene &scene, std::ostream &out)
    {
      const double          R       = scene.implant.radius;
      const BodyParameters &bone    = scene.bone;
      const BodyParameters &implant = scene.implant;
      const double G_b = bone.young_modulus / (2. * (1. + bone.poisson_ratio));
      const double G_i =
        implant.young_modulus / (2. * (1. + implant.poisson_ratio));
      const double k_n = in_series(
        scene.interface.normal_penalty,
        compliance_free(bone,
                        2. * bone.young_modulus /
                          ((1. - std::pow(bone.poisson_ratio, 2)) * M_PI * R)),
        compliance_free(implant, implant.young_modulus / implant.height));
      const double k_t =
        in_series(scene.interface.tangential_penalty,
                  compliance_free(bone, 32. * G_b / (3. * M_PI * R)),
                  compliance_free(implant, G_i / implant.height));

      const Chuck  chuck(scene.chuck, Eigen::Vector3d::Zero(), R);
      const auto   last = chuck.values(scene.load_steps.times.back());
      const double p =
        std::max(0.,
                 scene.chuck.component[2].loaded ? -last[2] / (M_PI * R * R) :
                                                   -last[2] * k_n);
      out
        << "Closed forms foretell (bodies as springs in series with the interface, "
           "to some 5 %):\n"
        << "  mean pressure at the end " << p << " MPa, force "
        << p * M_PI * R * R << " N\n"
        << "  torsional stiffness while everything sticks "
        << 0.5 * M_PI * std::pow(R, 4) * k_t << " N mm/rad\n";
      print_uniqueness(scene, p, out);
      RigidBodiesTorsion::Parameters parameters;
      parameters.radius             = R;
      parameters.push_in            = p / k_n;
      parameters.normal_penalty     = k_n;
      parameters.tangential_penalty = k_t;
      parameters.phi_0              = scene.interface.bonding.initial_bonding *
                         scene.interface.bonding.bonded_fraction;
      parameters.friction = scene.interface.friction;
      if (p <= 0. || scene.chuck.component[5].loaded || last[5] == 0.)
        return;
      if (!RigidBodiesTorsion::has_unique_solution(parameters))
        {
          out
            << "  no closed form of the torque: with the bodies in series the law "
               "softens too fast, and the torque may jump\n";
          return;
        }
      const RigidBodiesTorsion form(parameters);
      double                   T_max = 0.;
      for (unsigned int i = 1; i <= 1000; ++i)
        T_max = std::max(T_max, std::abs(form.torque(last[5] * i / 1000)));
      out << "  largest torque " << T_max << " N mm, at the end "
          << form.torque(last[5]) << " N mm\n";
    }
  } // namespace



  void
  DebondingProblem::check(std::ostream &out)
  {
    CoupledSystem system(scene, state->timer);
    system.start(state->stepping.time(0));
    out << unknowns_of(system) << '\n'
        << system.interface.n_points() << " slave quadrature points on the "
        << (system.interface.slave_side() == 1 ? "implant" : "bone") << '\n'
        << "initial bonding " << name_of(scene.interface.bonding.pattern)
        << ": " << system.interface.bonding().description() << '\n'
        << state->stepping.n_steps() << " planned steps from time "
        << scene.load_steps.times.front() << " to "
        << scene.load_steps.times.back() << '\n';
    if (scene.implant.shape == BodyShape::coin)
      print_forecast(scene, out);
  }
} // namespace Debond
