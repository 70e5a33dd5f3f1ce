#ifndef debond_system_adaptive_stepping_h
#define debond_system_adaptive_stepping_h

#include <debond/system/load_stepping.h>
#include <debond/system/step_control.h>

#include <array>

namespace Debond
{
  /**
   * Steps of a size that keeps the curves of the six chuck forces, drawn as
   * straight lines between the ends of the steps, within a tolerance. The
   * states at these ends are nearly exact whatever the step; what a large step
   * loses is the shape of the curve in between.
   *
   * The tolerance is relative to the largest value of each curve; where the
   * machine holds still, for instance against the lateral forces of a bond on
   * one side, it is relative to a tenth of the largest of all forces if that is
   * more.
   *
   * The error of a step is estimated from the distance of its end from the
   * straight line through the step before, in the first step of a phase from a
   * trial in its middle.
   */
  class AdaptiveStepping : public StepControl
  {
  public:
    using Forces = Chuck::Vector6;

    /** @p radius makes forces of moments, to compare them with [mm]. */
    AdaptiveStepping(const LoadSteppingParameters &parameters,
                     const double                  radius)
      : StepControl(parameters)
      , radius(radius)
    {}

    void
    begin_phase(const StepState &accepted) override;

    /** First of all a trial in the middle, in the first step of a phase. */
    Step
    next() override;
    /** Where the curves bend too much between the states before and @p state,
     *  the step has to be smaller, if it can. */
    bool
    take(const Step &, const StepState &state, unsigned int) override;
    /** Halves the step. */
    bool
    reject(const Step &) override;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int version)
    {
      StepControl::serialize(archive, version);
      archive &size &current &previous &middle &previous_time &previous_error;
      archive &has_middle &greatest &first_drive &has_first_drive &is_driven;
    }

  private:
    double
    smallest() const;
    double
    target_time() const;
    double
    error(const StepState &state) const;
    double
    relative_to_tolerance(const Forces &difference, const Forces &forces) const;
    void
    set_size(double new_size);
    void
    note_drive(const Forces &drive);

    const double radius;
    double       size     = 0;
    Forces       current  = Forces::Zero(); ///< at the beginning of the step
    Forces       previous = Forces::Zero(); ///< one step before
    Forces       middle   = Forces::Zero();
    double       previous_time   = 0;
    double       previous_error  = 0; ///< of the step before
    bool         has_middle      = false;
    Forces       greatest        = Forces::Zero(); ///< so far
    Forces       first_drive     = Forces::Zero();
    bool         has_first_drive = false;
    std::array<bool, 6> is_driven{}; ///< whether the drive has changed so far
  };
} // namespace Debond
#endif
