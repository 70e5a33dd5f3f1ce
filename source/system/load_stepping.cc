#include <debond/system/load_stepping.h>

#include <cmath>
#include <numeric>

namespace Debond
{
  LoadStepping::LoadStepping(const LoadSteppingParameters &parameters)
    : parameters(parameters)
    , total_steps(
        std::accumulate(parameters.steps.begin(), parameters.steps.end(), 0u))
  {}



  unsigned int
  LoadStepping::phase(const unsigned int step) const
  {
    unsigned int phase = 0;
    for (unsigned int end = parameters.steps[0];
         step > end && phase + 1 < parameters.steps.size();
         end += parameters.steps[phase])
      ++phase;
    return phase;
  }



  double
  LoadStepping::time(const unsigned int step) const
  {
    if (step == 0)
      return parameters.times[0];
    const unsigned int p = phase(step);
    if (ends_phase(step))
      return parameters.times[p + 1];
    return parameters.times[p] +
           (parameters.times[p + 1] - parameters.times[p]) *
             step_in_phase(step) / parameters.steps[p];
  }



  unsigned int
  LoadStepping::step_in_phase(const unsigned int step) const
  {
    if (step == 0)
      return 0;
    return step - std::accumulate(parameters.steps.begin(),
                                  parameters.steps.begin() + phase(step),
                                  0u);
  }



  bool
  LoadStepping::ends_phase(const unsigned int step) const
  {
    return step > 0 && step_in_phase(step) == parameters.steps[phase(step)];
  }



  bool
  LoadStepping::begins_phase(const unsigned int step) const
  {
    return step <= 1 || phase(step) != phase(step - 1);
  }
} // namespace Debond
