#include <debond/system/planned_steps.h>

#include <cmath>

namespace Debond
{
  PlannedSteps::PlannedSteps(const LoadSteppingParameters &parameters)
    : plan(parameters)
    , smallest(parameters.smallest_step_fraction)
  {}



  Step
  PlannedSteps::next()
  {
    if (row_is_complete())
      {
        ++current;
        done = 0.;
      }
    Step step;
    // a new phase is not the continuation of the last one
    step.extrapolate  = done > 0. || !plan.begins_phase(current);
    const double from = plan.time(current - 1), to = plan.time(current);
    step.time = done + size == 1. ? to : from + (to - from) * (done + size);
    step.whole_time = step.time;
    return step;
  }



  bool
  PlannedSteps::take(const Step &, const StepState &, unsigned int)
  {
    done += size;
    // twice as large if the step then still ends on its grid
    if (size < 1. && std::fmod(done, 2. * size) == 0.)
      size *= 2.;
    return true;
  }



  bool
  PlannedSteps::reject(const Step &)
  {
    size *= 0.5;
    return size >= smallest;
  }
} // namespace Debond
