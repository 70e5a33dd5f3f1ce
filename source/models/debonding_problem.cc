#include <debond/models/debonding_problem.h>
#include <debond/models/forecast.h>
#include <debond/models/memory_estimate.h>
#include <debond/models/simulation_summary.h>
#include <debond/output/checkpoint.h>
#include <debond/output/console.h>
#include <debond/output/field_output.h>
#include <debond/output/profile_output.h>
#include <debond/support/input_error.h>
#include <debond/support/interruption.h>
#include <debond/support/runtime.h>
#include <debond/support/serialization.h>
#include <debond/support/timed_section.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>

namespace Debond
{
  namespace
  {
    /** A run that begins anew leaves nothing of an earlier one that would be
     *  taken for its own, but does not destroy a checkpoint either. */
    ResultDirectory
    open_directory(const Scene &scene, const bool resumes)
    {
      if (resumes)
        return ResultDirectory(scene.output.directory);
      const ResultDirectory directory(scene.output, scene.completed_parameters);
      CheckpointFiles       files(directory);
      if (!scene.output.overwrite_other_results)
        try
          {
            std::vector<std::string> damaged; // of no use to anyone
            if (const auto checkpoint = files.newest(damaged))
              throw InputError(
                directory.path() +
                " holds the checkpoint of a run that was interrupted after "
                "step " +
                std::to_string(checkpoint->step) + ": debond --resume " +
                directory.path() + " goes on with it, --force begins anew");
          }
        catch (const OtherProgram &error)
          {
            throw InputError(std::string(error.what()) +
                             "; --force begins anew");
          }
      return directory;
    }



    /** At the end of an archive: another layout does not get there. */
    constexpr unsigned int end_of_state = 0x0deb03d;

    constexpr unsigned int archive_flags = boost::archive::no_header;
  } // namespace



  /** A simulation and what the program makes of it: files, lines on the
   *  console, checkpoints. */
  struct DebondingProblem::Run
  {
    Run(const Scene              &scene,
        std::shared_ptr<BodyPair> bodies,
        const Checkpoint         *checkpoint);

    /** From the beginning or the checkpoint to the last row. */
    void
    run();
    /** Writes summary.json. */
    void
    finish(bool converged, const std::string &reason);
    /** What the error says must not be lost, whatever becomes of the summary.
     */
    void
    finish_after(const std::exception &error);

    /** See serialization.h. To be called when everything is set up as at the
     *  beginning of the run. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &simulation &console &profiles &fields;
      std::map<std::string, double>           so_far = seconds();
      archive                                &so_far;
      if (Archive::is_loading::value)
        earlier_seconds = so_far;
    }

    const Scene                  &scene;
    std::string                   parameters; ///< as in the directory
    dealii::TimerOutput           timer;
    dealii::Timer                 wall_clock;
    double                        seconds_before_steps = 0;
    std::map<std::string, double> earlier_seconds; ///< before a checkpoint
    const ResultDirectory         directory;
    CheckpointFiles               checkpoints;
    const ReferenceCurve          reference;
    ProfileOutput                 profiles;
    Console                       console;
    Simulation                    simulation;
    FieldOutput                   fields;
    std::optional<GrowingFile>    torque_curve;

  private:
    void
    restore(const Checkpoint &checkpoint);
    void
    begin();
    void
    write(const TorqueRow &row);
    void
    save();
    void
    stop_if_interrupted();
    std::map<std::string, double>
    seconds() const;
    RunSummary
    summarise(const CurveSettings &settings) const;
    void
    say_result(const CurveMeasures &measures);
  };



  DebondingProblem::Run::Run(const Scene              &scene,
                             std::shared_ptr<BodyPair> bodies,
                             const Checkpoint *const   checkpoint)
    : scene(scene)
    , parameters(scene.completed_parameters)
    , timer(std::cout,
            dealii::TimerOutput::never,
            dealii::TimerOutput::wall_times)
    , directory(open_directory(scene, checkpoint != nullptr))
    , checkpoints(directory)
    , reference(read_reference_curve(scene.output.reference_curve))
    , profiles(scene, directory)
    , console(scene.output.console, std::cout)
    , simulation(scene, std::move(bodies), &timer)
    , fields(directory,
             simulation.system().bone,
             simulation.system().implant,
             simulation.system().interface,
             simulation.system().chuck)
  {
    if (checkpoint != nullptr)
      restore(*checkpoint);
    else
      {
        checkpoints.remove();
        remove_file(directory.file("summary.json"));
      }
    simulation.signals.next_row.connect([this] { stop_if_interrupted(); });
    simulation.signals.row.connect(
      [this](const TorqueRow &row) { write(row); });
    simulation.signals.warning.connect([this](const Warning &warning) {
      console.warn(warning.check, warning.text);
    });
  }



  // What there is before the first row.
  void
  DebondingProblem::Run::begin()
  {
    const BondingPattern &bonding = simulation.system().interface.bonding();
    if (!scene.title.empty())
      console.headline(scene.title);
    console.headline(unknowns_of(simulation.system()));
    for (const Warning &warning : simulation.warnings())
      console.warn(warning.check, warning.text);
    if (scene.interface.bonding.pattern != BondingPatternKind::homogeneous)
      {
        write_file(directory.file("bonding.csv"), bonding.table());
        console.headline("Initial bonding: " + bonding.description());
      }
    torque_curve.emplace(directory.file("torque.csv"),
                         torque_table(simulation.rows()));
    if (!simulation.rows().empty())
      {
        const TorqueRow   &last = simulation.rows().back();
        std::ostringstream text;
        text << "Going on after step " << last.step << ", time " << last.time
             << ", angle " << last.angle_deg << " deg";
        console.headline(text.str());
        console.first_step = last.step;
        stop_if_interrupted();
      }
    seconds_before_steps = wall_clock.wall_time();
  }



  void
  DebondingProblem::Run::run()
  {
    begin();
    simulation.run();
    torque_curve->finish();
  }



  void
  DebondingProblem::Run::write(const TorqueRow &row)
  {
    const OutputParameters &output      = scene.output;
    const bool              are_planned = scene.load_steps.rows_are_planned();
    {
      const TimedSection t(&timer, "output");
      torque_curve->append(torque_line(row));
      console.row(row, are_planned ? scene.load_steps.n_steps() : 0);
      profiles.write(row.angle_deg, [&] {
        return profile_points(simulation.system().interface);
      });
      const unsigned int number =
        are_planned ? scene.load_steps.step_in_phase(row.step) : row.step;
      if (output.fields_every > 0 &&
          (number % output.fields_every == 0 ||
           simulation.control().is_between_phases() ||
           simulation.is_finished()))
        fields.write(row.time);
    }
    if (output.resumable && output.checkpoint_every > 0 && row.step > 0 &&
        row.step % output.checkpoint_every == 0 && !simulation.is_finished())
      save();
  }



  void
  DebondingProblem::Run::stop_if_interrupted()
  {
    const int signal = interrupting_signal();
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
  DebondingProblem::Run::save()
  {
    const TimedSection t(&timer, "checkpoints");
    std::ostringstream bytes(std::ios::binary);
    {
      boost::archive::binary_oarchive archive(bytes, archive_flags);
      archive << *this << end_of_state;
    }
    fields.put_on_disk();
    checkpoints.write({simulation.rows().back().step, parameters, bytes.str()});
  }



  void
  DebondingProblem::Run::restore(const Checkpoint &checkpoint)
  {
    unsigned int end = 0;
    try
      {
        std::istringstream bytes(checkpoint.state, std::ios::binary);
        boost::archive::binary_iarchive archive(bytes, archive_flags);
        archive >> *this >> end;
      }
    catch (const std::exception &)
      {} // of the archive, or of sizes that are none
    if (end != end_of_state || simulation.rows().empty())
      throw InputError("the checkpoint in '" + directory.path() +
                       "' does not fit this build of the program: only the "
                       "same program can go on with the run");
    parameters = checkpoint.parameters;
    if (scene.output.fields_every > 0)
      console.warn("fields", fields.forget_later_files());
  }



  // With those before a checkpoint, by the names of the parts; "all" is the
  // whole run.
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



  RunSummary
  DebondingProblem::Run::summarise(const CurveSettings &settings) const
  {
    RunSummary summary       = summary_of(simulation, settings);
    summary.profile_measures = profiles.measures();
    const auto seconds       = this->seconds();
    for (const auto &section :
         timer.get_summary_data(dealii::TimerOutput::total_wall_time))
      summary.seconds.emplace_back(section.first, seconds.at(section.first));
    for (const std::string section : {"before steps", "stepping"})
      summary.seconds.emplace_back(section, seconds.at(section));
    const double shared = simulation.system().bodies()->seconds_shared;
    if (shared > 0.)
      summary.seconds.emplace_back("shared set-up", shared);
    summary.wall_seconds   = seconds.at("all");
    summary.peak_memory_MB = peak_memory_MB();
    return summary;
  }



  void
  DebondingProblem::Run::finish(const bool converged, const std::string &reason)
  {
    console.warn("profile", profiles.finish());
    const CurveSettings settings = curve_settings(simulation, reference);
    RunSummary          summary  = summarise(settings);
    if (converged)
      console.warn("reference",
                   warning_about_reference(summary.measures, settings));
    summary.converged = converged;
    summary.reason    = reason;
    summary.warnings  = console.warnings;

    nlohmann::ordered_json json = summary;
    add_facts(simulation, json);
    write_json(directory.file("summary.json"), json);
    if (!converged)
      return;
    checkpoints.remove(); // there is nothing to go on with
    say_result(summary.measures);
  }



  void
  DebondingProblem::Run::finish_after(const std::exception &error)
  {
    try
      {
        finish(false, error.what());
      }
    catch (const WriteError &another)
      {
        console.warn("summary", another.what());
      }
  }



  void
  DebondingProblem::Run::say_result(const CurveMeasures &measures)
  {
    std::ostringstream text;
    if (std::isfinite(measures.theta_max_deg))
      text << "Largest torque " << measures.T_max_Nmm << " N mm at "
           << measures.theta_max_deg << " deg, at the end "
           << measures.T_inf_Nmm << " N mm. ";
    else
      {
        const auto &reaction = simulation.rows().back().chuck_reaction;
        text << "Force of the chuck at the end: " << reaction[0] << ", "
             << reaction[1] << ", " << reaction[2] << " N. ";
      }
    text << "Results are in " << directory.path();
    console.headline(text.str());
    if (!console.quiet)
      timer.print_summary();
  }



  DebondingProblem::DebondingProblem(const Scene              &scene,
                                     std::shared_ptr<BodyPair> bodies)
    : scene(scene)
    , bodies(std::move(bodies))
  {
    require_memory(scene);
  }

  DebondingProblem::~DebondingProblem() = default;

  const std::vector<TorqueRow> &
  DebondingProblem::rows() const
  {
    static const std::vector<TorqueRow> none;
    return current ? current->simulation.rows() : none;
  }



  void
  DebondingProblem::resume(const Checkpoint &checkpoint)
  {
    run(&checkpoint);
  }



  // What cannot be set up leaves no results; what fails later leaves all rows
  // before, and a summary that says why.
  void
  DebondingProblem::run(const Checkpoint *const checkpoint)
  {
    try
      {
        current = std::make_unique<Run>(scene, bodies, checkpoint);
      }
    catch (const InputError &error)
      {
        throw scene.with_place(error);
      }
    try
      {
        current->run();
      }
    catch (const InputError &error)
      {
        // an expression that turns infinite
        const InputError placed = scene.with_place(error);
        current->finish_after(placed);
        throw placed;
      }
    catch (const std::exception &error)
      {
        current->finish_after(error);
        throw;
      }
    current->finish(true, current->simulation.control().reason_to_end());
  }



  void
  DebondingProblem::check(std::ostream &out)
  {
    const Simulation           simulation(scene);
    const CoupledSystem       &system    = simulation.system();
    const ContactInterface    &interface = system.interface;
    const std::vector<double> &times     = scene.load_steps.times;
    out << unknowns_of(system) << '\n'
        << interface.n_points() << " slave quadrature points on the "
        << name_of(interface.slave_side()) << '\n'
        << "memory: some " << std::ceil(estimated_memory_MB(scene)) << " MB\n"
        << "initial bonding " << name_of(scene.interface.bonding.pattern)
        << ": " << interface.bonding().description() << '\n'
        << scene.load_steps.n_steps() << " planned steps from time "
        << times.front() << " to " << times.back() << '\n';
    if (scene.implant.shape == BodyShape::coin)
      print_forecast(scene, out);
  }
} // namespace Debond
