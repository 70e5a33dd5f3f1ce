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



  void
  LoadStepping::begin(const unsigned int step)
  {
    current = step;
    done    = 0.;
  }



  double
  LoadStepping::target_time() const
  {
    if (done + size == 1.)
      return time(current);
    return time(current - 1) +
           (time(current) - time(current - 1)) * (done + size);
  }



  void
  LoadStepping::accept()
  {
    done += size;
    // twice as large if the step then still ends on its grid
    if (size < 1. && std::fmod(done, 2. * size) == 0.)
      size *= 2.;
  }



  bool
  LoadStepping::reject()
  {
    size *= 0.5;
    return size >= parameters.smallest_step_fraction;
  }
} // namespace Debond
