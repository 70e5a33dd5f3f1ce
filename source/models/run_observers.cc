#include <debond/models/run_observers.h>
#include <debond/support/interruption.h>

#include <cmath>
#include <iostream>
#include <sstream>

namespace Debond
{
  std::string
  unknowns_of(const CoupledSystem &system)
  {
    const BodyMesh &bone = system.bone.mesh(), &implant = system.implant.mesh();
    std::ostringstream text;
    text << bone.n_dofs_as_published() + implant.n_dofs_as_published()
         << " degrees of freedom, " << bone.n_unknowns() + implant.n_unknowns()
         << " of them unknowns, " << system.n_unknowns()
         << " after condensation on the contact surfaces";
    return text.str();
  }



  void
  ConsoleObserver::started(const Simulation &simulation)
  {
    const Scene &scene = simulation.scene();
    if (!scene.title.empty())
      console.headline(scene.title);
    console.headline(unknowns_of(simulation.system()));
    if (scene.interface.bonding.pattern != BondingPatternKind::homogeneous)
      console.headline("Initial bonding: " +
                       simulation.system().interface.bonding().description());
    for (const Warning &warning : simulation.warnings())
      warned(warning);
    if (simulation.rows().empty())
      return;
    const TorqueRow   &last = simulation.rows().back();
    std::ostringstream text;
    text << "Going on after step " << last.step << ", time " << last.time
         << ", angle " << last.angle_deg << " deg";
    console.headline(text.str());
    console.go_on_after(last.step);
  }



  void
  ConsoleObserver::row(const Simulation &simulation, const TorqueRow &row)
  {
    console.row(row, simulation.control().n_planned_rows());
  }



  void
  ConsoleObserver::warned(const Warning &warning)
  {
    console.warn(warning.check, warning.text);
  }



  RunTimer::RunTimer()
    : sections(std::cout,
               dealii::TimerOutput::never,
               dealii::TimerOutput::wall_times)
  {}



  void
  RunTimer::started(const Simulation &)
  {
    seconds_before_steps = wall_clock.wall_time();
  }



  std::map<std::string, double>
  RunTimer::seconds() const
  {
    std::map<std::string, double> sums = earlier_seconds;
    for (const auto &[section, seconds] :
         sections.get_summary_data(dealii::TimerOutput::total_wall_time))
      sums[section] += seconds;
    const double all = wall_clock.wall_time();
    sums["all"] += all;
    sums["before steps"] += seconds_before_steps;
    sums["stepping"] += all - seconds_before_steps;
    return sums;
  }



  CurveObserver::CurveObserver(const ResultDirectory &directory,
                               ProfileOutput         &profiles,
                               dealii::TimerOutput   &timer)
    : directory(directory)
    , profiles(profiles)
    , timer(timer)
  {}



  void
  CurveObserver::started(const Simulation &simulation)
  {
    if (simulation.scene().interface.bonding.pattern !=
        BondingPatternKind::homogeneous)
      write_file(directory.file("bonding.csv"),
                 simulation.system().interface.bonding().table());
    torque_curve.emplace(directory, simulation.rows());
  }



  void
  CurveObserver::row(const Simulation &simulation, const TorqueRow &row)
  {
    const TimedSection t(&timer, "output");
    torque_curve->write(row);
    profiles.write(row.angle_deg, [&] {
      return profile_points(simulation.system().interface);
    });
  }



  void
  CurveObserver::finished(const Simulation &)
  {
    torque_curve->finish();
  }



  FieldObserver::FieldObserver(FieldOutput &fields, dealii::TimerOutput &timer)
    : fields(fields)
    , timer(timer)
  {}



  void
  FieldObserver::row(const Simulation &simulation, const TorqueRow &row)
  {
    const TimedSection t(&timer, "output");
    const StepControl &control = simulation.control();
    if (control.row_in_phase(row.step) %
            simulation.scene().output.fields_every ==
          0 ||
        control.phase_is_finished() || control.is_finished())
      fields.write(row.time);
  }



  CheckpointObserver::CheckpointObserver(const ResultDirectory &directory,
                                         std::function<void(unsigned int)> save)
    : directory(directory)
    , save(std::move(save))
  {}



  void
  CheckpointObserver::row(const Simulation &simulation, const TorqueRow &row)
  {
    const OutputParameters &output = simulation.scene().output;
    if (output.resumable && output.checkpoint_every > 0 && row.step > 0 &&
        row.step % output.checkpoint_every == 0 && !simulation.is_finished())
      save(row.step);
  }



  void
  CheckpointObserver::next_row(const Simulation &simulation)
  {
    const int signal = interrupting_signal();
    if (signal == 0)
      return;
    const unsigned int step = simulation.rows().back().step;
    std::string        text = "interrupted by " + signal_name(signal) +
                       " after step " + std::to_string(step);
    if (simulation.scene().output.resumable)
      {
        save(step);
        text +=
          "; debond --resume '" + directory.path() + "' goes on from there";
      }
    throw Interrupted(signal, text);
  }
} // namespace Debond
