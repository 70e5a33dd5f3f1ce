#ifndef debond_models_run_observers_h
#define debond_models_run_observers_h

#include <debond/models/simulation.h>
#include <debond/output/checkpoint.h>
#include <debond/output/console.h>
#include <debond/output/field_output.h>
#include <debond/output/profile_output.h>

#include <deal.II/base/timer.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

// What looks on while the program runs a scene. Each observer has a member
// serialize() if it has to go on from a checkpoint where it was.

namespace Debond
{
  /** "N degrees of freedom, M of them unknowns, ..." */
  std::string
  unknowns_of(const CoupledSystem &system);



  /** Says on the console how the run goes, and what it warns of. */
  class ConsoleObserver : public SimulationObserver
  {
  public:
    explicit ConsoleObserver(Console &console)
      : console(console)
    {}

    void
    started(const Simulation &simulation) override;
    void
    row(const Simulation &simulation, const TorqueRow &row) override;
    void
    warned(const Warning &warning) override;

  private:
    Console &console;
  };



  /** Measures where the time goes, with what was spent before a checkpoint. */
  class RunTimer : public SimulationObserver
  {
  public:
    RunTimer();

    void
    started(const Simulation &simulation) override;

    /** Seconds by the names of the parts; "all" is the whole run. */
    std::map<std::string, double>
    seconds() const;

    dealii::TimerOutput sections;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      std::map<std::string, double> so_far = seconds();
      archive                      &so_far;
      if (Archive::is_loading::value)
        earlier_seconds = so_far;
    }

  private:
    dealii::Timer                 wall_clock;
    double                        seconds_before_steps = 0;
    std::map<std::string, double> earlier_seconds;
  };



  /** Writes torque.csv, bonding.csv and profiles. */
  class CurveObserver : public SimulationObserver
  {
  public:
    CurveObserver(const ResultDirectory &directory,
                  ProfileOutput         &profiles,
                  dealii::TimerOutput   &timer);

    void
    started(const Simulation &simulation) override;
    void
    row(const Simulation &simulation, const TorqueRow &row) override;
    void
    finished(const Simulation &simulation) override;

  private:
    const ResultDirectory           &directory;
    ProfileOutput                   &profiles;
    dealii::TimerOutput             &timer;
    std::optional<TorqueCurveWriter> torque_curve;
  };



  /** Writes fields every so many rows and at the ends of phases. */
  class FieldObserver : public SimulationObserver
  {
  public:
    FieldObserver(FieldOutput &fields, dealii::TimerOutput &timer);

    void
    row(const Simulation &simulation, const TorqueRow &row) override;

  private:
    FieldOutput         &fields;
    dealii::TimerOutput &timer;
  };



  /** Leaves checkpoints, and ends the run if a signal asks for it. */
  class CheckpointObserver : public SimulationObserver
  {
  public:
    /** @p save writes the checkpoint after the given step. */
    CheckpointObserver(const ResultDirectory            &directory,
                       std::function<void(unsigned int)> save);

    void
    row(const Simulation &simulation, const TorqueRow &row) override;
    /** Throws Interrupted. */
    void
    next_row(const Simulation &simulation) override;

  private:
    const ResultDirectory                  &directory;
    const std::function<void(unsigned int)> save;
  };
} // namespace Debond
#endif
