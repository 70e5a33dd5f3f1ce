#ifndef debond_system_step_control_h
#define debond_system_step_control_h

#include <debond/bulk/chuck.h>
#include <debond/system/load_step_parameters.h>

#include <string>

namespace Debond
{
  /** A step that is to be tried. */
  struct Step
  {
    /** Where it ends; a guess if the mean sliding distance is prescribed. */
    double time = 0;
    /** The end of what it is a part of: of a trial in the middle of a step the
     *  step's, else its own. */
    double whole_time = 0;
    /** Growth of the mean sliding distance that is prescribed instead of the
     *  time [mm]; 0: the time is. */
    double slip = 0;
    /** May start on the straight line through the last two states, of which it
     *  is the continuation. */
    bool extrapolate = false;
    /** Size relative to the step before, where the line is drawn over a path
     *  instead of the time. */
    double ratio = 0;

    bool
    by_slip() const
    {
      return slip > 0.;
    }
  };

  /** What the control of steps knows of a state of the system. */
  struct StepState
  {
    double         time = 0;
    Chuck::Vector6 forces; ///< that the chuck exerts, generalised [N, N mm]
    /** What the scene prescribes, displacements and angles or loads. */
    Chuck::Vector6 drive;
    double         mean_slip = 0; ///< [mm]; known along a path only
  };

  /**
   * Which steps lead from row to row. Who solves asks for the next() step and
   * tells what became of it: it was solved, take(), or could not be, reject().
   * At the end of a phase, and at the beginning, begin_phase() comes first.
   */
  class StepControl
  {
  public:
    explicit StepControl(const LoadSteppingParameters &parameters)
      : parameters(parameters)
    {}
    virtual ~StepControl() = default;

    virtual Step
    next() = 0;
    /** Judges a step that was solved in so many iterations, with the state at
     *  its end: false if it is not to be accepted, because it went too far or
     *  was a trial only. */
    virtual bool
    take(const Step &step, const StepState &state, unsigned int iterations) = 0;
    /** Makes the step smaller because it could not be solved; false if it
     *  cannot be smaller. */
    virtual bool
    reject(const Step &step) = 0;

    /** Whether the step that was taken is the last one of its row. */
    virtual bool
    row_is_complete() const
    {
      return true;
    }
    bool
    is_between_phases() const
    {
      return phase == 0 || time == end;
    }
    virtual bool
    is_finished() const
    {
      return phase == parameters.steps.size() && time == end;
    }
    /** Why there is no further step, for people. */
    virtual std::string
    reason_to_end() const
    {
      return "the last time is reached";
    }

    /** Goes to the beginning of the next phase, with the accepted state. */
    virtual void
    begin_phase(const StepState & /*accepted*/)
    {
      time    = parameters.times[phase];
      end     = parameters.times[phase + 1];
      planned = (end - time) / parameters.steps[phase];
      ++phase;
      // a new phase is not the continuation of the last one
      has_previous = false;
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &phase &time &end &planned &has_previous;
    }

  protected:
    const LoadSteppingParameters parameters;
    unsigned int                 phase = 0; ///< from 1; 0: none has begun
    double time = 0, end = 0;    ///< of the accepted state, of the phase
    double planned      = 0;     ///< size of a planned step
    bool   has_previous = false; ///< a step of this phase has been taken
  };
} // namespace Debond
#endif
