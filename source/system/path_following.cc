#include <debond/system/path_following.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    double
    largest_slip_step(const Scene &scene)
    {
      return scene.load_steps.largest_slip_step > 0. ?
               scene.load_steps.largest_slip_step :
               scene.interface.friction->characteristic_distance() / 20.;
    }
  } // namespace



  PathFollowing::PathFollowing(const Scene &scene)
    : parameters(scene.load_steps)
    , largest_slip(largest_slip_step(scene))
    , end_slip(parameters.path_ends_at_slip > 0. ?
                 parameters.path_ends_at_slip :
                 scene.implant.characteristic_radius())
  {}



  void
  PathFollowing::begin_phase(const unsigned int phase, const double slip)
  {
    time        = parameters.times[phase];
    end         = parameters.times[phase + 1];
    planned     = (end - time) / parameters.steps[phase];
    mean_slip   = slip;
    slip_size   = largest_slip;
    time_size   = planned;
    has_last    = false;
    goes_to_end = slip_failed = time_failed = false;
  }



  PathFollowing::Step
  PathFollowing::next() const
  {
    Step step;
    step.extrapolate = has_last;
    if (has_last && last_slip_step > 0. && !goes_to_end)
      {
        // no further than a straight line can be trusted, or a planned step
        step.ratio = std::min(slip_size / last_slip_step, 2.);
        if (last_time_step > 0.)
          step.ratio = std::min(step.ratio, planned / last_time_step);
        step.slip    = step.ratio * last_slip_step;
        step.time    = time + step.ratio * last_time_step;
        step.by_slip = time_failed || prefers_slip(step);
        if (step.by_slip)
          return step;
      }
    step.time  = end - time < time_size * (1. + 1e-9) ? end : time + time_size;
    step.ratio = last_time_step > 0. ? (step.time - time) / last_time_step : 0.;
    return step;
  }



  // Where time falls, and where much slides on the way to the end.
  bool
  PathFollowing::prefers_slip(const Step &step) const
  {
    return !slip_failed && step.time < end &&
           (last_time_step <= 0. || step.slip >= 0.25 * largest_slip);
  }



  bool
  PathFollowing::accept(const Step        &step,
                        const double       new_time,
                        const double       new_mean_slip,
                        const unsigned int iterations)
  {
    const double slipped = new_mean_slip - mean_slip;
    if (step.by_slip && new_time > end)
      {
        slip_size = 0.5 * step.slip;
        // else the end is beyond a limit point
        goes_to_end =
          !time_failed ||
          slip_size < parameters.smallest_step_fraction * largest_slip;
        return false;
      }
    if (!step.by_slip && slipped > largest_slip * (1. + 1e-6) &&
        reject_time(step))
      return false;
    has_last    = true;
    goes_to_end = slip_failed = time_failed = false;
    last_time_step                          = new_time - time;
    last_slip_step                          = slipped;
    time                                    = new_time;
    mean_slip                               = new_mean_slip;
    if (!step.by_slip)
      time_size = std::min(planned, 2. * time_size);
    else
      {
        time_size = planned;
        if (iterations <= 5)
          slip_size = std::min(largest_slip, 1.5 * slip_size);
      }
    return true;
  }



  bool
  PathFollowing::reject(const Step &step)
  {
    if (!step.by_slip)
      return reject_time(step);
    slip_failed = true;
    time_failed = false;
    slip_size   = 0.5 * step.slip;
    return slip_size >= parameters.smallest_step_fraction * largest_slip;
  }



  // A state that is not found, or far away: there may be a limit point, where
  // only the sliding distance goes on.
  bool
  PathFollowing::reject_time(const Step &step)
  {
    goes_to_end = false;
    time_failed = has_last && last_slip_step > 0.;
    time_size   = 0.5 * (step.time - time);
    return time_size >= 0.5 * parameters.smallest_step_fraction * planned;
  }
} // namespace Debond
