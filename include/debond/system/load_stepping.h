#ifndef debond_system_load_stepping_h
#define debond_system_load_stepping_h

#include <debond/system/load_step_parameters.h>

namespace Debond
{
  /**
   * The planned steps of a scene and the sub-steps a planned step is cut into.
   * Steps are counted, not accumulated: planned times are hit exactly, and a
   * sub-step is a power of two of its planned step.
   */
  class LoadStepping
  {
  public:
    explicit LoadStepping(const LoadSteppingParameters &parameters);

    /** Number of planned steps; row 0, the first time, is not one of them. */
    unsigned int
    n_steps() const
    {
      return total_steps;
    }
    /** End of planned step @p step; step 0 is the first time. */
    double
    time(unsigned int step) const;
    /** True for the first planned step of a phase. */
    bool
    begins_phase(unsigned int step) const;
    /** Number of a planned step within its phase, from 1; 0 for step 0. */
    unsigned int
    step_in_phase(unsigned int step) const;
    /** True for the last planned step of a phase. */
    bool
    ends_phase(unsigned int step) const;
    /** Index of the phase (0, 1, ...) that a planned step > 0 belongs to. */
    unsigned int
    phase(unsigned int step) const;

    /** @name Sub-steps */
    //@{
    /** Goes to the start of a planned step; the size of sub-steps of the one
     *  before is kept. */
    void
    begin(unsigned int step);
    bool
    finished() const
    {
      return done == 1.;
    }
    /** End of the sub-step that is to be tried next. */
    double
    target_time() const;
    /** The sub-step as a fraction of the planned step. */
    double
    fraction() const
    {
      return size;
    }
    bool
    is_whole_step() const
    {
      return done == 0. && size == 1.;
    }
    /** The sub-step succeeded: the next one may be twice as large. */
    void
    accept();
    /** The sub-step failed: the next one is half as large. False if that is
     *  below the smallest step. */
    bool
    reject();
    //@}

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &current &done &size;
    }

  private:
    const LoadSteppingParameters parameters;
    unsigned int                 total_steps = 0;
    unsigned int                 current     = 0;
    double done = 0, size = 1; ///< exact: sums of powers of two
  };
} // namespace Debond
#endif
