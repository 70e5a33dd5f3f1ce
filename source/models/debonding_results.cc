#include <debond/models/debonding_run.h>
#include <debond/support/runtime.h>

#include <algorithm>
#include <cmath>
#include <sstream>

// What class DebondingProblem writes.

namespace Debond
{
  void
  DebondingProblem::write_row(const unsigned int iterations)
  {
    CoupledSystem        &system   = *state->system;
    const auto           &summary  = state->interface_summary;
    const Chuck::Vector6 &q        = system.chuck.position();
    const Chuck::Vector6  reaction = system.chuck_resultant();

    TorqueRow row;
    row.step       = state->step;
    row.time       = state->time;
    row.angle_deg  = q[ChuckComponent::rotation_z] * 180. / M_PI;
    row.torque_Nmm = system.chuck_forces()[ChuckComponent::rotation_z];
    row.force_N =
      0. - reaction[ChuckComponent::translation_z]; // no negative zero
    row.pressure_MPa         = row.force_N / system.interface.implant_area();
    row.phi_mean             = summary.phi_mean;
    row.share_stick          = summary.share_stick;
    row.share_slip           = summary.share_slip;
    row.share_open           = summary.share_open;
    row.newton_iterations    = iterations;
    row.energy_defect        = state->checks.energy().defect();
    row.work_Nmm             = state->checks.energy().work();
    row.energy_bulk_Nmm      = system.bulk_energy();
    row.energy_interface_Nmm = summary.energy;
    row.dissipation_Nmm      = system.interface.work().dissipation;
    row.adhesive_work_Nmm    = system.interface.work().adhesive;
    row.energy_defect_bound  = state->checks.energy().defect_bound();
    row.reaction_defect      = state->checks.reaction_defect();
    row.viscous_work_Nmm     = system.interface.work().viscous;
    row.warnings             = state->checks.take_violations();
    row.machine_angle_deg =
      system.chuck.machine_position()[ChuckComponent::rotation_z] * 180. / M_PI;
    row.released_energy_Nmm = state->checks.released().total();
    for (unsigned int k = 0; k < 6; ++k)
      {
        row.chuck_reaction[k] = reaction[k];
        row.chuck_position[k] = q[k] * (is_rotation(k) ? 180. / M_PI : 1.);
      }
    state->rows.push_back(row);

    const dealii::TimerOutput::Scope t(state->timer, "output");
    state->torque_writer->write(row);
    state->console.row(row,
                       rows_are_accepted_steps() ? 0 :
                                                   state->stepping.n_steps());
    state->profiles->write(row.angle_deg, system.interface);
    if (state->field_output && fields_are_due())
      state->field_output->write(state->time);
  }



  bool
  DebondingProblem::fields_are_due() const
  {
    const unsigned int every = scene.output.fields_every;
    if (!rows_are_accepted_steps())
      return state->stepping.step_in_phase(state->step) % every == 0 ||
             state->stepping.ends_phase(state->step);
    const bool phase_is_finished =
      state->path ?
        state->path->phase_is_finished() || state->path->has_ended() :
        state->adaptive_stepping->phase_is_finished();
    return state->step % every == 0 || phase_is_finished;
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



  std::map<std::string, double>
  DebondingProblem::Run::seconds() const
  {
    std::map<std::string, double> sums = earlier_seconds;
    for (const auto &[section, seconds] :
         timer.get_summary_data(dealii::TimerOutput::total_wall_time))
      sums[section] += seconds;
    const double all = wall_clock.wall_time();
    sums["all"] += all;
    sums["before steps"] += seconds_before_steps;
    sums["stepping"] += all - seconds_before_steps;
    return sums;
  }



  // What the error says must not be lost, whatever becomes of the summary.
  void
  DebondingProblem::finish_after(const std::exception &error)
  {
    try
      {
        finish(false, error.what());
      }
    catch (const WriteError &another)
      {
        state->console.warn("summary", another.what());
      }
  }



  void
  DebondingProblem::finish(const bool converged, const std::string &reason)
  {
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
    const auto seconds         = state->seconds();
    for (const auto &section :
         state->timer.get_summary_data(dealii::TimerOutput::total_wall_time))
      summary.seconds.emplace_back(section.first, seconds.at(section.first));
    for (const std::string section : {"before steps", "stepping"})
      summary.seconds.emplace_back(section, seconds.at(section));
    if (state->given_bodies)
      summary.seconds.emplace_back("shared set-up",
                                   state->given_bodies->seconds_shared);
    summary.wall_seconds     = seconds.at("all");
    summary.profile_measures = state->profiles->measures();
    summary.peak_memory_MB   = peak_memory_MB();

    JsonObject json;
    add_summary(summary, json);
    add_bonding(system.interface.bonding().report(), json);
    json.add("jumps", state->checks.released().n_jumps());
    json.add("released_energy_Nm", 1e-3 * state->checks.released().total());
    write_file(state->directory->file("summary.json"), json.text());
    if (converged)
      {
        state->checkpoints->remove(); // there is nothing to go on with
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
} // namespace Debond
