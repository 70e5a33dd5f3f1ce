#include <debond/system/step_control.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  void
  AdaptiveStepping::begin_phase(const StepState &accepted)
  {
    StepControl::begin_phase(accepted);
    if (phase == 1)
      first_drive = accepted.drive;
    current  = accepted.forces;
    greatest = greatest.cwiseMax(current.cwiseAbs());
    set_size(planned);
  }



  double
  AdaptiveStepping::smallest() const
  {
    return parameters.smallest_step_fraction * planned;
  }



  void
  AdaptiveStepping::set_size(const double new_size)
  {
    size       = std::clamp(new_size, smallest(), planned);
    has_middle = false;
  }



  double
  AdaptiveStepping::target_time() const
  {
    // no tiny step before the end: two equal ones instead
    const double left = end - time;
    if (left <= size * (1. + 1e-9))
      return end;
    return left < 2. * size ? time + 0.5 * left : time + size;
  }



  Step
  AdaptiveStepping::next()
  {
    Step step;
    step.extrapolate = has_previous;
    step.whole_time = step.time = target_time();
    if (!has_previous && !has_middle)
      step.time = 0.5 * (time + step.whole_time);
    return step;
  }



  double
  AdaptiveStepping::error(const StepState &state) const
  {
    // How far the curve is from the straight line through the step before, or,
    // in the first step, from the chord of this one.
    const Forces &forces     = state.forces;
    Forces        difference = middle - 0.5 * (current + forces);
    if (has_previous)
      difference =
        forces - current -
        (target_time() - time) / (time - previous_time) * (current - previous);
    // moments are forces at the distance of the radius
    Forces unit;
    unit << 1., 1., 1., radius, radius, radius;
    const Forces largest = greatest.cwiseMax(forces.cwiseAbs());
    const double of_all  = largest.cwiseQuotient(unit).maxCoeff();
    // A component next to nothing, for instance by symmetry, has no curve.
    // Small reactions to patterns beside the axis have a kink wherever a few
    // points begin to slide: in proportion to themselves they would take three
    // times as many steps as the torque.
    double deviation = 0;
    for (unsigned int k = 0; k < 6; ++k)
      {
        const double floor = (drive_change[k] > 0. ? 1e-3 : 0.1) * of_all;
        const double scale = std::max(largest[k], floor * unit[k]);
        if (scale > 0.)
          deviation =
            std::max(deviation,
                     std::abs(difference[k]) / scale / parameters.tolerance);
      }
    if (!has_previous) // twice: the curve need not be a parabola
      return 2. * deviation;
    // A parabola that begins to bend with this step would leave its chord by a
    // quarter of that. Where the curve was straight before it may have a kink
    // anywhere in this step, and leave its chord by nearly all of it.
    const double bent = 0.25 * deviation;
    return bent > 10. * previous_error ? deviation : bent;
  }



  bool
  AdaptiveStepping::take(const Step      &step,
                         const StepState &state,
                         const unsigned int)
  {
    if (step.time != step.whole_time)
      {
        middle     = state.forces;
        has_middle = true;
        return false;
      }
    drive_change =
      drive_change.cwiseMax((state.drive - first_drive).cwiseAbs());
    const double error_now = error(state);
    const double taken     = step.time - time;
    if (error_now > 1. && taken > smallest() * (1. + 1e-9))
      {
        set_size(taken * std::clamp(std::sqrt(0.8 / error_now), 0.1, 0.7));
        return false;
      }
    previous       = current;
    previous_time  = time;
    previous_error = error_now;
    has_previous   = true;
    current        = state.forces;
    time           = step.time;
    greatest       = greatest.cwiseMax(state.forces.cwiseAbs());
    // the error goes with the square of the step; towards 0.8 of the tolerance
    set_size(taken *
             std::clamp(std::sqrt(0.8 / std::max(error_now, 1e-12)), 0.5, 2.));
    return true;
  }



  bool
  AdaptiveStepping::reject(const Step &step)
  {
    const double tried = step.whole_time - time;
    if (tried <= smallest() * (1. + 1e-9))
      return false;
    set_size(0.5 * tried);
    return true;
  }
} // namespace Debond
