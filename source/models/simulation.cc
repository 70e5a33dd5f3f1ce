#include <debond/models/memory_estimate.h>
#include <debond/models/simulation.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/support/timed_section.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Debond
{
  namespace
  {
    CoupledSystem
    build(const Scene              &scene,
          std::shared_ptr<BodyPair> bodies,
          dealii::TimerOutput      *timer)
    {
      require_memory(scene); // before anything large is built
      const TimedSection t(timer, "set-up");
      return CoupledSystem(scene, std::move(bodies), timer);
    }



    std::vector<Warning>
    warnings_of(const Scene &scene)
    {
      std::vector<Warning> warnings;
      for (const auto &[body, name] :
           {std::make_pair(&scene.bone, "Bone"),
            std::make_pair(&scene.implant, "Implant")})
        if (body->material != Material::rigid && body->poisson_ratio > 0.45)
          warnings.push_back(
            {std::string("locking of ") + name,
             std::string(name) +
               " / Poisson ratio = " + to_text(body->poisson_ratio) +
               ": trilinear cells lock as it approaches 0.5, so that the body "
               "is too stiff: compare with finer Cells"});
      if (scene.load_steps.adaptive && scene.interface.viscosity > 0.)
        warnings.push_back(
          {"viscosity",
           "Load steps / Tolerance does not cover the error in time of "
           "Interface / Viscosity, which is of first order in the step: "
           "compare with smaller Steps"});
      return warnings;
    }



    /** Of the initial bonding as the interface has it. */
    std::vector<Warning>
    warnings_of(const ContactInterface &interface)
    {
      std::vector<Warning> warnings;
      const auto          &report = interface.bonding().report();
      const double         seen   = interface.mean_seen_bonding();
      if (!report.remark.empty())
        warnings.push_back({"picture", report.remark});
      if (std::abs(seen - report.mean) > 0.01 * report.mean)
        warnings.push_back(
          {"bonding",
           "the quadrature points of the bone, which is the slave, see a mean "
           "phi_0 of " +
             to_text(seen, 4) + " instead of " + to_text(report.mean, 4) +
             ": Slave = implant meets it exactly, more elements of the bone "
             "more closely"});
      return warnings;
    }
  } // namespace



  Simulation::Simulation(const Scene              &scene,
                         std::shared_ptr<BodyPair> bodies,
                         dealii::TimerOutput      *timer)
    : scene(scene)
    , coupled_system(build(this->scene, std::move(bodies), timer))
    , solver(this->scene, coupled_system)
    , steps(choose_steps(scene))
    , step_control(
        std::visit([](auto &chosen) -> StepControl & { return chosen; }, steps))
    , state_checks(this->scene)
  {
    coupled_system.start(solver.time());
    for (const auto &found :
         {warnings_of(scene), warnings_of(coupled_system.interface)})
      all_warnings.insert(all_warnings.end(), found.begin(), found.end());
  }



  Simulation::Steps
  Simulation::choose_steps(const Scene &scene)
  {
    const LoadSteppingParameters &load_steps = scene.load_steps;
    const double                  R = scene.implant.characteristic_radius();
    if (load_steps.adaptive)
      return AdaptiveStepping(load_steps, R);
    if (!load_steps.follow_path)
      return PlannedSteps(load_steps);
    return PathFollowing(
      load_steps,
      load_steps.largest_slip_step > 0. ?
        load_steps.largest_slip_step :
        scene.interface.friction->characteristic_distance() / 20.,
      load_steps.path_ends_at_slip > 0. ? load_steps.path_ends_at_slip : R);
  }



  // From row to row. Whoever looks on may end the run between them.
  void
  Simulation::run()
  {
    if (all_rows.empty())
      advance();
    while (!is_finished())
      {
        signals.next_row();
        advance();
      }
    judge_whole_run();
  }



  void
  Simulation::advance()
  {
    if (all_rows.empty())
      solve_first_row();
    else
      solve_row();
    signals.row(all_rows.back());
  }



  void
  Simulation::judge_whole_run()
  {
    if (std::all_of(all_rows.begin(), all_rows.end(), [](const TorqueRow &row) {
          return row.share_open == 1.;
        }))
      warn({"no contact", "the bodies are never in contact"});
    const LoadSteppingParameters &load_steps = scene.load_steps;
    if (solver.time() != load_steps.times.back() &&
        load_steps.path_ends_at_slip == 0.)
      warn({"path",
            "the last time is not reached: " + step_control.reason_to_end()});
  }



  // Row 0: the state at the first time, solved like a step.
  void
  Simulation::solve_first_row()
  {
    const StepResult result = solver.solve_first();
    spent.newton_iterations += result.iterations;
    refuse_jump(result);
    if (!result.is_acceptable())
      throw RunError("The state at the first time, " +
                     std::to_string(solver.time()) +
                     ", could not be found: " + result.why);
    accept(result);
    add_row(result.interface, result.iterations);
  }



  // A row ends with an accepted step. The control of steps says which step to
  // try; the solver looks for the state at its end. If there is none within
  // reach the step is made smaller, down to the smallest that the scene allows.
  // If there is one the control may still refuse it, because the curve would be
  // drawn too coarsely or the path be left; nothing of it is kept then. A
  // planned step that had to be divided takes several accepted steps.
  void
  Simulation::solve_row()
  {
    if (step_control.is_between_phases())
      step_control.begin_phase(state());
    unsigned int iterations = 0;
    while (true)
      {
        const Step       step   = step_control.next();
        const StepResult result = solver.solve(step);
        iterations += result.iterations;
        spent.newton_iterations += result.iterations;
        refuse_jump(result);
        if (!result.is_acceptable())
          {
            if (!step_control.reject(step))
              give_up(step, result);
          }
        else if (!step_control.take(step, state(), result.iterations))
          coupled_system.rollback();
        else
          {
            accept(result);
            if (step_control.row_is_complete())
              return add_row(result.interface, iterations);
          }
      }
  }



  StepState
  Simulation::state() const
  {
    const double time = coupled_system.time();
    return {time,
            coupled_system.chuck_forces(),
            coupled_system.chuck.values(time),
            coupled_system.mean_slip()};
  }



  // Where the law falls more steeply than the interface is stiff, the equations
  // have more than one solution, and which one Newton's method finds means
  // nothing.
  void
  Simulation::refuse_jump(const StepResult &result) const
  {
    if (!result.hopeless)
      return;
    std::ostringstream message;
    message << "Step " << all_rows.size() << ", after time " << solver.time()
            << ": " << result.why;
    throw RunError(message.str());
  }



  void
  Simulation::give_up(const Step &step, const StepResult &result) const
  {
    const Chuck       &chuck = coupled_system.chuck;
    std::ostringstream message;
    message << "Step " << all_rows.size();
    if (scene.load_steps.rows_are_planned())
      message << " of " << scene.load_steps.n_steps();
    message << " failed at time "
            << (step.by_slip() ? coupled_system.time() : step.whole_time)
            << ", angle "
            << chuck.position()[ChuckComponent::rotation_z] * 180. / M_PI
            << " deg, with the smallest allowed part of a step: " << result.why;
    if (!scene.load_steps.follow_path && !chuck.unknowns().empty())
      message << ". A prescribed load may be more than the interface can "
                 "carry; prescribing the displacement or angle instead, or "
                 "Load steps / Path following = slip, follows the fall";
    throw RunError(message.str());
  }



  // What is asked of the trial state comes first: commit() turns it into
  // history, and the checks judge what has become of energies and forces.
  void
  Simulation::accept(const StepResult &result)
  {
    const unsigned int row             = all_rows.size();
    const double       from            = solver.time();
    const double       to              = coupled_system.time();
    const double       reaction_defect = coupled_system.reaction_defect();
    if (row > 0)
      {
        ++spent.steps;
        spent.shortest_step =
          std::fmin(spent.shortest_step, std::abs(to - from));
        if (scene.has_friction() && scene.has_friction_after(from))
          state_checks.add_path(row, coupled_system.chuck, from, to);
      }
    solver.commit();
    state_checks.add(row, coupled_system, result.interface, reaction_defect);
    for (const Warning &warning : state_checks.take_warnings())
      warn(warning);
  }



  void
  Simulation::warn(const Warning &warning)
  {
    if (std::any_of(all_warnings.begin(),
                    all_warnings.end(),
                    [&](const Warning &other) {
                      return other.check == warning.check;
                    }))
      return;
    all_warnings.push_back(warning);
    signals.warning(warning);
  }



  void
  Simulation::add_row(const InterfaceSummary &summary,
                      const unsigned int      iterations)
  {
    const Chuck            &chuck     = coupled_system.chuck;
    const ContactInterface &interface = coupled_system.interface;
    const Chuck::Vector6   &q         = chuck.position();
    const Chuck::Vector6    reaction  = coupled_system.chuck_resultant();

    TorqueRow row;
    row.step       = all_rows.size();
    row.time       = solver.time();
    row.angle_deg  = q[ChuckComponent::rotation_z] * 180. / M_PI;
    row.torque_Nmm = coupled_system.chuck_forces()[ChuckComponent::rotation_z];
    row.force_N =
      0. - reaction[ChuckComponent::translation_z]; // no negative zero
    row.pressure_MPa         = row.force_N / interface.implant_area();
    row.phi_mean             = summary.phi_mean;
    row.share_stick          = summary.share_stick;
    row.share_slip           = summary.share_slip;
    row.share_open           = summary.share_open;
    row.newton_iterations    = iterations;
    row.energy_defect        = state_checks.energy().defect();
    row.work_Nmm             = state_checks.energy().work();
    row.energy_bulk_Nmm      = coupled_system.bulk_energy();
    row.energy_interface_Nmm = summary.energy;
    row.dissipation_Nmm      = interface.work().dissipation;
    row.adhesive_work_Nmm    = interface.work().adhesive;
    row.energy_defect_bound  = state_checks.energy().defect_bound();
    row.reaction_defect      = state_checks.reaction_defect();
    row.viscous_work_Nmm     = interface.work().viscous;
    row.warnings             = state_checks.take_violations();
    row.machine_angle_deg =
      chuck.machine_position()[ChuckComponent::rotation_z] * 180. / M_PI;
    row.released_energy_Nmm = state_checks.released().total();
    for (unsigned int k = 0; k < 6; ++k)
      {
        row.chuck_reaction[k] = reaction[k];
        row.chuck_position[k] = q[k] * (is_rotation(k) ? 180. / M_PI : 1.);
      }
    all_rows.push_back(row);
  }
} // namespace Debond
