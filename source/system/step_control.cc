#include <debond/system/step_control.h>

#include <cmath>

namespace Debond
{
  void
  StepControl::begin_phase(const StepState & /*accepted*/)
  {
    time    = parameters.times[phase];
    end     = parameters.times[phase + 1];
    planned = (end - time) / parameters.steps[phase];
    ++phase;
    has_previous = false; // it is not the continuation of the last one
  }



  void
  PlannedSteps::begin_phase(const StepState &accepted)
  {
    StepControl::begin_phase(accepted);
    current = 0;
  }



  Step
  PlannedSteps::next()
  {
    // `done' and `size' are shares of the planned step, `size' a power of two:
    // what was halved so ends exactly where the whole was to end.
    if (row_is_complete())
      {
        ++current;
        done = 0.;
      }
    const double from = parameters.planned_time(phase - 1, current - 1);
    const double to   = parameters.planned_time(phase - 1, current);
    Step         step;
    step.extrapolate = has_previous;
    step.time = done + size == 1. ? to : from + (to - from) * (done + size);
    step.whole_time = step.time;
    return step;
  }



  bool
  PlannedSteps::take(const Step &step, const StepState &, const unsigned int)
  {
    time         = step.time;
    has_previous = true;
    done += size;
    // twice as large if the step then still ends on its grid
    if (size < 1. && std::fmod(done, 2. * size) == 0.)
      size *= 2.;
    return true;
  }



  bool
  PlannedSteps::reject(const Step &, const bool)
  {
    // another attempt at half the size, unless that is less than the scene
    // allows
    size *= 0.5;
    return size >= parameters.smallest_step_fraction;
  }
} // namespace Debond
