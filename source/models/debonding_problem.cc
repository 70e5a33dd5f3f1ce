#include <debond/input/csv_table.h>
#include <debond/models/debonding_problem.h>
#include <debond/models/forecast.h>
#include <debond/models/resumed_run.h>
#include <debond/models/run_report.h>
#include <debond/models/simulation.h>
#include <debond/output/bone_measures.h>
#include <debond/output/checkpoint.h>
#include <debond/output/field_output.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/interruption.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>
#include <debond/support/serialization.h>
#include <debond/system/memory_estimate.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <regex>

namespace Debond
{
  namespace
  {
    /** Refuses to overwrite that of a run in the directory, or of the coarser
     * one that came before it. */
    void
    refuse_checkpoint(const ResultDirectory &results, const std::string &run)
    {
      const ResultDirectory directory(run);
      if (read_json(directory.file("summary.json"))["converged"] == true)
        return;                         // that of the end can be computed again
      std::vector<std::string> damaged; // of no use to anyone
      if (const auto checkpoint = CheckpointFiles(directory).newest(damaged))
        throw InputError(Text() << directory.path()
                                << " holds the checkpoint of a run that was "
                                   "interrupted after step "
                                << checkpoint->step << ": debond --resume "
                                << results.path()
                                << " goes on with it, --force begins anew");
    }



    /** At the end of an archive: another layout does not get there. */
    constexpr unsigned int end_of_state = 0x0deb03d;


    /** "N degrees of freedom, M of them unknowns, ...", the modulus of the bone
     *  if it varies, and its solver where there is a choice. */
    std::vector<std::string>
    lines_about(const Simulation &simulation)
    {
      const Scene         &scene   = simulation.scene;
      const CoupledSystem &system  = simulation.system();
      const BulkSpace     &bone    = system.bone.mesh();
      const BulkSpace     &implant = system.implant.mesh();
      Text                 text;
      text << bone.n_dofs_as_published() + implant.n_dofs_as_published()
           << " degrees of freedom, "
           << bone.n_unknowns() + implant.n_unknowns() << " of them unknowns, "
           << system.n_unknowns()
           << " after condensation on the contact surfaces";
      std::vector<std::string> lines{text};
      if (scene.bone.modulus)
        lines.push_back(scene.bone.modulus->in_words());
      if (scene.bone.element == ElementKind::spline ||
          scene.bulk_solver() == BulkSolver::multigrid)
        lines.push_back(scene.bulk_solver_in_words());
      return lines;
    }



    /** A simulation and what the program makes of it: files, lines on the
     *  console, checkpoints. */
    struct Run
    {
      const Scene                  &scene;
      std::string                   parameters; ///< as in the directory
      dealii::TimerOutput           timer;
      dealii::Timer                 wall_clock, since_checkpoint;
      double                        seconds_before_steps = 0;
      std::map<std::string, double> earlier_seconds; ///< before a checkpoint
      const ResultDirectory         directory;
      CheckpointFiles               checkpoints;
      RunReport                     report;
      Simulation                    simulation;
      FieldOutput                   fields;

      Run(const Scene              &scene,
          std::shared_ptr<BodyPair> bodies,
          const Checkpoint *const   checkpoint)
        : scene(scene)
        , parameters(scene.completed_parameters)
        , timer(std::cout,
                dealii::TimerOutput::never,
                dealii::TimerOutput::wall_times)
        , directory(open_directory(scene, checkpoint != nullptr))
        , checkpoints(directory)
        , report(scene,
                 directory,
                 [this](const TorqueRow &) {
                   return profile_points(simulation.system().interface);
                 })
        , simulation(scene, std::move(bodies), &timer)
        , fields(directory, simulation.system())
      {
        Ranks::meet(); // all have seen what was in the directory
        if (checkpoint != nullptr)
          restore(*checkpoint);
        else
          {
            checkpoints.remove();
            remove_file(directory.file("summary.json"));
          }
        // which would be taken for this run's if it were killed
        remove_file(directory.file("curve.csv"));
        simulation.signals.row.connect(
          [this](const TorqueRow &row) { write(row); });
        simulation.signals.warning.connect([this](const Warning &warning) {
          report.console.warn(warning.check, warning.text);
        });
      }

      /** From the beginning or the checkpoint to the last row. */
      void
      run()
      {
        const BondingPattern &bonding = simulation.system().interface.bonding();
        Console              &console = report.console;
        report.begin(simulation.rows());
        for (const std::string &line : lines_about(simulation))
          console.headline(line);
        for (const Warning &warning : simulation.warnings())
          console.warn(warning.check, warning.text);
        if (scene.interface.bonding.pattern != BondingPatternKind::homogeneous)
          {
            write_file(directory.file("bonding.csv"), bonding.table());
            console.headline("Initial bonding: " + bonding.description());
          }
        const std::string faces =
          simulation.system().interface.faces_at_start().in_words(
            scene.interface.joint()->pulls());
        if (!faces.empty())
          console.headline(faces);
        if (!simulation.rows().empty())
          {
            const TorqueRow &last = simulation.rows().back();
            console.headline(Text() << "Going on after step " << last.step
                                    << ", time " << last.time << ", angle "
                                    << last.angle_deg << " deg");
            stop_if_interrupted();
          }
        seconds_before_steps = wall_clock.wall_time();
        simulation.run();
        const std::string difference =
          difference_from_forecast(scene, simulation.rows());
        if (!difference.empty())
          report.console.warn("forecast", difference);
      }

      void
      write(const TorqueRow &row)
      {
        const OutputParameters &output = scene.output;
        const bool are_planned         = scene.load_steps.rows_are_planned();
        {
          const TimedSection t(&timer, "output");
          report.add(row, are_planned ? scene.load_steps.n_steps() : 0);
          const unsigned int number =
            are_planned ? scene.load_steps.step_in_phase(row.step) : row.step;
          const unsigned int every =
            output.fields_every != output.usual_fields ? output.fields_every :
            are_planned                                ? 50 :
                                                         5;
          if (every > 0 && (number % every == 0 ||
                            simulation.control().is_between_phases() ||
                            simulation.is_finished()))
            fields.write(row.time);
        }
        if (is_time_for_checkpoint(row) ||
            (simulation.is_finished() && keeps_last_state()))
          save();
        if (!simulation.is_finished())
          stop_if_interrupted();
      }

      bool
      keeps_last_state() const
      {
        return scene.output.resumable && scene.output.extendable;
      }

      // Ranks have clocks of their own: if one says so, all do.
      bool
      is_time_for_checkpoint(const TorqueRow &row)
      {
        const OutputParameters &output = scene.output;
        if (!output.resumable || row.step == 0 || simulation.is_finished())
          return false;
        const bool is_late = output.checkpoint_minutes > 0. &&
                             Ranks::largest(since_checkpoint.wall_time()) >=
                               60. * output.checkpoint_minutes;
        return is_late || (output.checkpoint_every > 0 &&
                           row.step % output.checkpoint_every == 0);
      }

      void
      stop_if_interrupted()
      {
        const int signal = interrupting_signal_of_any();
        if (signal == 0)
          return;
        std::string text = "interrupted by " + signal_name(signal) +
                           " after step " +
                           std::to_string(simulation.rows().back().step);
        if (scene.output.resumable)
          {
            save();
            text +=
              "; debond --resume '" + directory.path() + "' goes on from there";
          }
        throw Interrupted(signal, text);
      }

      void
      save()
      {
        const TimedSection            t(&timer, "checkpoints");
        std::string                   state;
        unsigned int                  end = end_of_state;
        SavingArchive(state) & *this &end;
        fields.put_on_disk();
        checkpoints.write({simulation.rows().back().step, parameters, state});
        since_checkpoint.restart();
      }

      void
      restore(const Checkpoint &checkpoint)
      {
        unsigned int end = 0;
        try
          {
            LoadingArchive(checkpoint.state) & *this &end;
          }
        catch (const std::length_error &)
          {} // of the archive
        if (end != end_of_state || simulation.rows().empty())
          throw InputError("the checkpoint in '" + directory.path() +
                           "' does not fit this build of the program: only the "
                           "same program can go on with the run");
        if (extends(scene, checkpoint.parameters))
          directory.write_parameters(parameters);
        else
          parameters = checkpoint.parameters;
      }

      // With those before a checkpoint, by the names of the parts; "all" is the
      // whole run.
      std::map<std::string, double>
      seconds() const
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

      /** The last motion goes into @p facts, all of them into motion.csv. */
      void
      write_motions(nlohmann::ordered_json &facts) const
      {
        const std::vector<RelativeMotion> motions = simulation.motions();
        if (motions.empty())
          return;
        const RelativeMotion &last = motions.back();
        facts.update({{"motion_mean_um", last.mean_um},
                      {"motion_95_um", last.percentile_95_um},
                      {"motion_share_above_28_um", last.share_above_28_um},
                      {"motion_share_above_150_um", last.share_above_150_um}});
        if (scene.output.motion_between.empty())
          return;
        std::string table = "from,to,mean_um,percentile_95_um,"
                            "share_above_28_um,share_above_150_um\n";
        for (const RelativeMotion &motion : motions)
          table += csv_line(std::vector<double>{motion.from,
                                                motion.to,
                                                motion.mean_um,
                                                motion.percentile_95_um,
                                                motion.share_above_28_um,
                                                motion.share_above_150_um});
        write_file(directory.file("motion.csv"), table);
      }

      /** Writes summary.json. */
      void
      finish(const bool converged, const std::string &reason)
      {
        const CoupledSystem &system     = simulation.system();
        const BulkSpace     &bone       = system.bone.mesh(),
                        &implant        = system.implant.mesh();
        const auto            &bonding  = system.interface.bonding().report();
        const auto            &released = simulation.checks().released();
        const auto            &effort   = simulation.effort();
        const auto             seconds  = this->seconds();
        nlohmann::ordered_json facts{
          {"steps", effort.steps},
          {"smallest_step", effort.smallest_step},
          {"newton_iterations", effort.newton_iterations},
          {"dofs", bone.n_dofs_as_published() + implant.n_dofs_as_published()},
          {"unknowns", bone.n_unknowns() + implant.n_unknowns()},
          {"condensed_unknowns", system.n_unknowns()},
          {"converged", converged},
          {"reason", reason},
          {"wall_seconds", seconds.at("all")}};
        facts.update(fields.measures());
        write_motions(facts);
        facts.update(
          bone_measures(simulation.scene, system.interface, simulation.rows()));
        if (const auto *const effort_of_multigrid = system.multigrid_effort())
          facts.update(
            {{"processes", Ranks::number()},
             {"multigrid_systems", effort_of_multigrid->systems},
             {"multigrid_cycles", effort_of_multigrid->cycles},
             {"multigrid_most_cycles", effort_of_multigrid->most_cycles}});
        // {"dense solve", 1.5} becomes "seconds_dense_solve": 1.5
        for (const auto &[part, sum] : seconds)
          if (part != "all")
            facts["seconds_" +
                  std::regex_replace(part, std::regex("\\W"), "_")] = sum;
        if (const double shared = system.bodies()->seconds_shared; shared > 0.)
          facts["seconds_shared_set_up"] = shared;
        facts.update({{"phi_0_mean", bonding.mean},
                      {"bonded_area_mm2", bonding.bonded_area},
                      {"bonded_patches", bonding.patches},
                      {"largest_bonded_patch_mm2", bonding.largest_patch},
                      {"change_at_large_strains",
                       simulation.checks().change_at_large_strains()},
                      {"jumps", released.n_jumps},
                      {"released_energy_Nmm", released.total}});
        report.finish(simulation.rows(), simulation.curve_settings(), facts);
        if (!converged)
          return;
        // a run may be extended
        keeps_last_state() ? checkpoints.remove_older() : checkpoints.remove();
        if (scene.output.timings)
          timer.print_summary();
      }

      /** See serialization.h. To be called when everything is set up as at the
       *  beginning of the run. */
      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &simulation &report  &fields;
        std::map<std::string, double> so_far = seconds();
        archive                      &so_far;
        if (Archive::is_loading::value)
          earlier_seconds = so_far;
      }
    };
  } // namespace



  // A run that begins anew leaves nothing of an earlier one that would be taken
  // for its own, but does not destroy a checkpoint either. Only the first rank
  // finds that the directory is locked or cannot be written.
  ResultDirectory
  open_directory(const Scene &scene, const bool resumes)
  {
    std::optional<ResultDirectory> directory;
    Ranks::in_agreement([&] {
      if (resumes)
        {
          directory.emplace(scene.output.directory);
          return;
        }
      directory.emplace(scene.output, scene.completed_parameters);
      if (scene.output.overwrite_other_results)
        return;
      refuse_checkpoint(*directory, directory->path());
      if (std::filesystem::exists(directory->file("coarser")) &&
          read_json(directory->file("summary.json"))["converged"] != true)
        refuse_checkpoint(*directory, directory->file("coarser"));
    });
    return *directory;
  }



  DebondingProblem::DebondingProblem(const Scene              &scene,
                                     std::shared_ptr<BodyPair> bodies)
    : scene(scene)
    , bodies(std::move(bodies))
  {
    scene.check_ranks();
    require_memory(scene,
                   scene.output.fields_every > 0,
                   this->bodies != nullptr);
  }



  // What cannot be set up leaves no results; what fails later leaves all rows
  // before, and a summary that says why.
  void
  DebondingProblem::run(const Checkpoint *const checkpoint)
  {
    // Eigen adds up numbers on the stack from an address on that is divisible
    // by 64. The system puts the stack elsewhere each time, and sums would
    // round in other ways: from here on all is where it was.
    alignas(64) volatile char stack_begins = 0;
    static_cast<void>(stack_begins);
    std::optional<Run> run;
    try
      {
        run.emplace(scene, bodies, checkpoint);
        run->run();
      }
    catch (const ForeignCheckpoint &)
      {
        throw;
      }
    catch (const std::exception &error)
      {
        const auto *const mistake = dynamic_cast<const InputError *>(&error);
        const std::string why =
          mistake ? scene.with_place(*mistake).what() : error.what();
        if (run)
          {
            rows = run->simulation.rows();
            // What the error says must not be lost, whatever becomes of the
            // summary.
            try
              {
                run->finish(false, why);
              }
            catch (const WriteError &another)
              {
                run->report.console.warn("summary", another.what());
              }
          }
        if (mistake)
          throw InputError(why);
        throw;
      }
    rows = run->simulation.rows();
    run->finish(true, run->simulation.control().reason_to_end());
  }



  void
  DebondingProblem::check(std::ostream &out) const
  {
    Text                       text;
    const Simulation           simulation(scene);
    const ContactInterface    &interface = simulation.system().interface;
    const std::vector<double> &times     = scene.load_steps.times;
    for (const std::string &line : lines_about(simulation))
      text << line << '\n';
    const std::string faces =
      interface.faces_at_start().in_words(interface.get_law().pulls());
    text << interface.get_points().size() << " slave quadrature points on the "
         << name_of(interface.slave_side()) << '\n'
         << "memory: some "
         << std::ceil(1e3 * MemoryEstimate(scene,
                                           scene.bulk_solver(),
                                           scene.output.fields_every > 0)
                              .total)
         << " MB" << (Ranks::number() > 1 ? " in each process\n" : "\n")
         << "initial bonding " << name_of(scene.interface.bonding.pattern)
         << ": " << interface.bonding().description() << '\n'
         << faces << (faces.empty() ? "" : "\n")
         << (scene.load_steps.adaptive ? "adaptive steps, no larger than " : "")
         << scene.load_steps.n_steps() << " planned steps"
         << (scene.load_steps.adaptive ? "," : "") << " from time "
         << times.front() << " to " << times.back() << '\n';
    for (const Warning &warning : simulation.warnings())
      text << "warning: " << warning.text << '\n';
    out << std::string(text);
    print_forecast(scene, out);
  }
} // namespace Debond
