#include <debond/support/number_text.h>
#include <debond/system/step_control.h>

#include <algorithm>

namespace Debond
{
  void
  PathFollowing::begin_phase(const StepState &accepted)
  {
    StepControl::begin_phase(accepted);
    path_length = accepted.path_length;
    slip_size   = largest_slip;
    time_size   = planned;
    goes_to_end = slip_failed = time_failed = false;
  }



  Step
  PathFollowing::next()
  {
    Step step;
    step.extrapolate = has_previous;
    // where damage ends the steps become as small as what is left
    const double left = std::min(0.5 * path_left, largest_slip);
    if (has_previous && last_slip_step > 0. && !goes_to_end &&
        left > 1e-2 * parameters.smallest_step_fraction * largest_slip)
      {
        // no further than a straight line can be trusted, or a planned step
        // Slip and time of the predictor go on along the line through the last
        // two states; the ratio says how far, in parts of the last step.
        step.ratio = std::min(std::min(slip_size, left) / last_slip_step, 2.);
        if (last_time_step > 0.)
          step.ratio = std::min(step.ratio, planned / last_time_step);
        step.slip = step.ratio * last_slip_step;
        step.time = time + step.ratio * last_time_step;
        // where time falls, and where much slides until the end
        if (time_failed || (!slip_failed && step.time < end &&
                            (last_time_step <= 0. || step.slip >= 0.25 * left)))
          return step;
      }
    step.slip  = 0.;
    step.time  = end - time < time_size * (1. + 1e-9) ? end : time + time_size;
    step.ratio = last_time_step > 0. ? (step.time - time) / last_time_step : 0.;
    step.whole_time = step.time;
    return step;
  }



  bool
  PathFollowing::take(const Step        &step,
                      const StepState   &state,
                      const unsigned int iterations)
  {
    // A step by slip that goes beyond the last time, and one by time that
    // slides more than a step may, are not taken: both are made anew, smaller.
    const double slipped = state.path_length - path_length;
    if (step.by_slip() && state.time > end)
      {
        slip_size = 0.5 * step.slip;
        // else the end is beyond a limit point
        goes_to_end =
          !time_failed ||
          slip_size < parameters.smallest_step_fraction * largest_slip;
        return false;
      }
    if (!step.by_slip() && slipped > largest_slip * (1. + 1e-6) &&
        reject_time(step))
      return false;
    has_previous = true;
    goes_to_end = slip_failed = time_failed = false;
    last_time_step                          = state.time - time;
    last_slip_step                          = slipped;
    time                                    = state.time;
    path_length                             = state.path_length;
    path_left                               = state.path_left;
    is_detached                             = state.is_detached;
    if (!step.by_slip())
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
  PathFollowing::reject(const Step &step, const bool)
  {
    if (!step.by_slip())
      return reject_time(step);
    // the time is prescribed in the next attempt, see next()
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
    time_failed = has_previous && last_slip_step > 0.;
    time_size   = 0.5 * (step.time - time);
    return time_size >= 0.5 * parameters.smallest_step_fraction * planned;
  }



  std::string
  PathFollowing::reason_to_end() const
  {
    if (is_detached)
      return Text()
             << "the bond is gone, and nothing is left that a load could act "
                "against, at time "
             << time;
    if (path_length >= end_slip)
      return Text() << "the mean of sliding distance and opening has reached "
                    << end_slip
                    << " mm (Expert / Load steps / Path ends at slip) at time "
                    << time;
    return StepControl::reason_to_end();
  }
} // namespace Debond
