#ifndef debond_models_debonding_run_h
#define debond_models_debonding_run_h

#include <debond/models/debonding_problem.h>
#include <debond/models/state_checks.h>
#include <debond/output/checkpoint.h>
#include <debond/output/console.h>
#include <debond/output/field_output.h>
#include <debond/output/profile_output.h>
#include <debond/system/adaptive_stepping.h>
#include <debond/system/coupled_system.h>
#include <debond/system/path_following.h>

#include <deal.II/base/timer.h>

#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  /** Everything that lives as long as a run. */
  struct DebondingProblem::Run
  {
    /** Keeps a reference to @p scene. */
    explicit Run(const Scene &scene)
      : console(scene.output.console, std::cout)
      , timer(std::cout,
              dealii::TimerOutput::never,
              dealii::TimerOutput::wall_times)
      , stepping(scene.load_steps)
      , checks(scene, console)
    {}

    Console                            console;
    dealii::TimerOutput                timer;
    dealii::Timer                      wall_clock;
    LoadStepping                       stepping;
    std::unique_ptr<AdaptiveStepping>  adaptive_stepping; ///< if wanted
    std::unique_ptr<PathFollowing>     path;              ///< if wanted
    std::unique_ptr<ResultDirectory>   directory;
    std::unique_ptr<CheckpointFiles>   checkpoints;
    std::string                        parameters;   ///< as in the directory
    std::shared_ptr<BodyPair>          given_bodies; ///< if there are any
    std::unique_ptr<CoupledSystem>     system;
    std::unique_ptr<TorqueCurveWriter> torque_writer;
    std::unique_ptr<FieldOutput>       field_output;
    std::unique_ptr<ProfileOutput>     profiles;
    ReferenceCurve                     reference;
    StateChecks                        checks;

    /** @name Where the run is */
    //@{
    std::vector<TorqueRow> rows;
    double                 time = 0; ///< of the accepted state
    unsigned int           step = 0; ///< planned step at work
    /** Of the next row, where rows are accepted steps; whether it has begun,
     *  and whether the last row of it can be continued. */
    unsigned int phase          = 0;
    bool         phase_is_begun = false, extrapolate = false;
    unsigned int accepted_steps    = 0; ///< sub-steps included
    unsigned int newton_iterations = 0;
    /** Time of the shortest accepted step. */
    double smallest_step = CurveMeasures::undefined;
    //@}

    /** @name Of the step at work */
    //@{
    PathFollowing::Step path_step;
    InterfaceSummary    interface_summary;
    std::string         last_failure;
    //@}

    double seconds_before_steps = 0;
    /** What was spent before a checkpoint. */
    std::map<std::string, double> earlier_seconds;

    /** Seconds spent by the names of the parts, with those before a checkpoint.
     *  "all" is the whole run. */
    std::map<std::string, double>
    seconds() const;

    /** See serialization.h. To be called when everything is set up as at the
     *  beginning of the run. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &*system &stepping &checks &console &*profiles;
      if (adaptive_stepping)
        archive &*adaptive_stepping;
      if (path)
        archive &*path;
      if (field_output)
        archive &*field_output;
      archive &rows &time &step &phase &phase_is_begun &extrapolate;
      archive &accepted_steps &newton_iterations       &smallest_step;
      std::map<std::string, double>                     so_far = seconds();
      archive                                          &so_far;
      if (Archive::is_loading::value)
        earlier_seconds = so_far;
    }
  };
} // namespace Debond
#endif
