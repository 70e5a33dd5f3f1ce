#include <debond/bulk/chuck.h>
#include <debond/system/adaptive_stepping.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Debond
{
  AdaptiveStepping::AdaptiveStepping(const LoadSteppingParameters &parameters,
                                     const double                  radius)
    : parameters(parameters)
    , radius(radius)
  {}



  void
  AdaptiveStepping::begin_phase(const unsigned int phase,
                                const Forces      &forces,
                                const Forces      &drive)
  {
    note_drive(drive);
    time         = parameters.times[phase];
    end          = parameters.times[phase + 1];
    largest      = (end - time) / parameters.steps[phase];
    current      = forces;
    greatest     = greatest.cwiseMax(forces.cwiseAbs());
    has_previous = false; // a new phase is not the continuation of the last one
    set_size(largest);
  }



  void
  AdaptiveStepping::note_drive(const Forces &drive)
  {
    if (!has_first_drive)
      first_drive = drive;
    has_first_drive = true;
    for (unsigned int k = 0; k < 6; ++k)
      is_driven[k] = is_driven[k] || drive[k] != first_drive[k];
  }



  double
  AdaptiveStepping::smallest() const
  {
    return parameters.smallest_step_fraction * largest;
  }



  void
  AdaptiveStepping::set_size(const double new_size)
  {
    size       = std::clamp(new_size, smallest(), largest);
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



  double
  AdaptiveStepping::middle_time() const
  {
    return 0.5 * (time + target_time());
  }



  void
  AdaptiveStepping::note_middle(const Forces &forces)
  {
    middle     = forces;
    has_middle = true;
  }



  double
  AdaptiveStepping::relative_to_tolerance(const Forces &difference,
                                          const Forces &forces) const
  {
    Forces largest_so_far = greatest.cwiseMax(forces.cwiseAbs());
    Forces in_newton      = largest_so_far;
    in_newton.tail<3>() /= radius;
    // A component next to nothing, for instance by symmetry, has no curve.
    // Small reactions to patterns beside the axis have a kink wherever a few
    // points begin to slide: in proportion to themselves they would take three
    // times as many steps as the torque.
    double error = 0;
    for (unsigned int k = 0; k < 6; ++k)
      {
        const double floor = (is_driven[k] ? 1e-3 : 0.1) * in_newton.maxCoeff();
        const double scale =
          std::max(largest_so_far[k], floor * (is_rotation(k) ? radius : 1.));
        if (scale > 0.)
          error = std::max(error, std::abs(difference[k]) / scale);
      }
    return error / parameters.tolerance;
  }



  double
  AdaptiveStepping::error(const Forces &forces, const Forces &drive)
  {
    note_drive(drive);
    if (!has_previous) // twice: the curve need not be a parabola
      return 2. *
             relative_to_tolerance(middle - 0.5 * (current + forces), forces);
    // from the straight line through the step before
    const Forces line = current + (target_time() - time) /
                                    (time - previous_time) *
                                    (current - previous);
    const double deviation = relative_to_tolerance(forces - line, forces);
    // A parabola that begins to bend with this step would leave its chord by a
    // quarter of that. Where the curve was straight before it may have a kink
    // anywhere in this step, and leave its chord by nearly all of it.
    const double bent = 0.25 * deviation;
    return bent > 10. * previous_error ? deviation : bent;
  }



  void
  AdaptiveStepping::accept(const Forces &forces, const double error)
  {
    const double step = target_time() - time;
    previous          = current;
    previous_time     = time;
    has_previous      = true;
    current           = forces;
    time              = target_time();
    greatest          = greatest.cwiseMax(forces.cwiseAbs());
    // the error goes with the square of the step; towards 0.8 of the tolerance
    previous_error = error;
    set_size(step *
             std::clamp(std::sqrt(0.8 / std::max(error, 1e-12)), 0.5, 2.));
  }



  bool
  AdaptiveStepping::shrink(const double error)
  {
    const double step = target_time() - time;
    if (step <= smallest() * (1. + 1e-9))
      return false;
    set_size(step * std::clamp(std::sqrt(0.8 / error), 0.1, 0.7));
    return true;
  }



  bool
  AdaptiveStepping::reject()
  {
    const double step = target_time() - time;
    if (step <= smallest() * (1. + 1e-9))
      return false;
    set_size(0.5 * step);
    return true;
  }
} // namespace Debond
