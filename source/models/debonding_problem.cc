#include <debond/models/debonding_run.h>
#include <debond/models/forecast.h>
#include <debond/models/memory_estimate.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <cmath>
#include <sstream>

namespace Debond
{
  DebondingProblem::DebondingProblem(const Scene              &scene,
                                     std::shared_ptr<BodyPair> bodies)
    : scene(scene)
    , state(std::make_unique<Run>(this->scene))
  {
    require_memory(scene);
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
    run(nullptr);
  }



  void
  DebondingProblem::resume(const Checkpoint &checkpoint)
  {
    run(&checkpoint);
  }



  void
  DebondingProblem::run(const Checkpoint *const checkpoint)
  {
    try
      {
        set_up(checkpoint);
      }
    catch (const InputError &error)
      {
        throw scene.with_place(error);
      }
    state->seconds_before_steps = state->wall_clock.wall_time();
    try
      {
        solve_rows();
        state->torque_writer->finish();
      }
    catch (const InputError &error)
      {
        // an expression that turns infinite
        const InputError placed = scene.with_place(error);
        finish_after(placed);
        throw placed;
      }
    catch (const std::exception &error)
      {
        finish_after(error);
        throw;
      }
    finish(true, reason_to_end());
  }



  void
  DebondingProblem::solve_rows()
  {
    if (state->rows.empty())
      solve_first_row();
    while (!is_finished())
      {
        stop_if_interrupted();
        solve_next_row();
        if (checkpoint_is_due() && !is_finished())
          save_checkpoint();
      }
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
  DebondingProblem::set_up(const Checkpoint *const checkpoint)
  {
    open_directory(checkpoint != nullptr);
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
    if (!scene.title.empty())
      state->console.headline(scene.title);
    state->console.headline(unknowns_of(*state->system));
    warn_of_locking(scene.bone, "Bone", state->console);
    warn_of_locking(scene.implant, "Implant", state->console);
    if (scene.load_steps.adaptive && scene.interface.viscosity > 0.)
      state->console.warn("viscosity",
                          "Load steps / Tolerance does not cover the error in "
                          "time of Interface / Viscosity, which is of first "
                          "order in the step: compare with smaller Steps");
    write_bonding();
    open_results(checkpoint);
  }



  void
  DebondingProblem::open_directory(const bool resumes)
  {
    state->parameters = scene.completed_parameters;
    state->directory =
      resumes ? std::make_unique<ResultDirectory>(scene.output.directory) :
                std::make_unique<ResultDirectory>(scene.output,
                                                  scene.completed_parameters);
    state->checkpoints = std::make_unique<CheckpointFiles>(*state->directory);
    if (!resumes && !scene.output.overwrite_other_results)
      keep_checkpoint();
    state->reference = read_reference_curve(scene.output.reference_curve);
    state->profiles = std::make_unique<ProfileOutput>(scene, *state->directory);
  }



  // A run that begins anew leaves nothing of an earlier one that would be taken
  // for its own.
  void
  DebondingProblem::open_results(const Checkpoint *const checkpoint)
  {
    if (scene.output.fields_every > 0)
      state->field_output =
        std::make_unique<FieldOutput>(*state->directory,
                                      state->system->bone,
                                      state->system->implant,
                                      state->system->interface,
                                      state->system->chuck);
    if (checkpoint != nullptr)
      {
        restore(*checkpoint);
        if (state->field_output)
          state->console.warn("fields",
                              state->field_output->forget_later_files());
      }
    else
      {
        state->checkpoints->remove();
        remove_file(state->directory->file("summary.json"));
      }
    state->torque_writer =
      std::make_unique<TorqueCurveWriter>(*state->directory, state->rows);
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



  void
  DebondingProblem::check(std::ostream &out)
  {
    CoupledSystem system(scene, state->timer);
    system.start(state->stepping.time(0));
    out << unknowns_of(system) << '\n'
        << system.interface.n_points() << " slave quadrature points on the "
        << name_of(system.interface.slave_side()) << '\n'
        << "memory: some " << std::ceil(estimated_memory_MB(scene)) << " MB\n"
        << "initial bonding " << name_of(scene.interface.bonding.pattern)
        << ": " << system.interface.bonding().description() << '\n'
        << state->stepping.n_steps() << " planned steps from time "
        << scene.load_steps.times.front() << " to "
        << scene.load_steps.times.back() << '\n';
    if (scene.implant.shape == BodyShape::coin)
      print_forecast(scene, out);
  }
} // namespace Debond
