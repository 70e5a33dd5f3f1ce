#ifndef debond_system_step_control_h
#define debond_system_step_control_h

#include <debond/bulk/chuck.h>

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
   * Which steps lead from row to row. The one who solves asks for the next()
   * step and tells what became of it: it could not be solved, reject(), or it
   * was, take(). The last step of a row completes it.
   */
  class StepControl
  {
  public:
    virtual ~StepControl() = default;

    /** Whether the next row is the first one of a phase, so that begin_phase()
     *  is to be called. */
    virtual bool
    phase_is_due() const
    {
      return false;
    }
    virtual void
    begin_phase(const StepState & /*accepted*/)
    {}

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

    /** @name After a step was taken */
    //@{
    virtual bool
    row_is_complete() const
    {
      return true;
    }
    virtual bool
    phase_is_finished() const = 0;
    virtual bool
    is_finished() const = 0;
    /** Why there is no further step, for people. */
    virtual std::string
    reason_to_end() const = 0;
    //@}

    /** Number of rows after the first, if it is known beforehand; else 0, and
     *  each accepted step is a row. */
    virtual unsigned int
    n_planned_rows() const
    {
      return 0;
    }
    /** Number of a row within its phase if it is planned, else from the
     *  beginning: every so many rows fields are written. */
    virtual unsigned int
    row_in_phase(const unsigned int row) const
    {
      return row;
    }
  };
} // namespace Debond
#endif
