#ifndef debond_system_load_stepping_h
#define debond_system_load_stepping_h

#include <debond/system/load_step_parameters.h>

namespace Debond
{
  /**
   * The planned times of a scene. Steps are counted, not accumulated: planned
   * times are hit exactly.
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

  private:
    const LoadSteppingParameters parameters;
    unsigned int                 total_steps = 0;
  };
} // namespace Debond
#endif
