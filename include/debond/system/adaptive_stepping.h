#ifndef debond_system_adaptive_stepping_h
#define debond_system_adaptive_stepping_h

#include <debond/system/load_stepping.h>

#include <Eigen/Core>

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
  class AdaptiveStepping
  {
  public:
    using Forces = Eigen::Matrix<double, 6, 1>;

    /** @p radius makes forces of moments, to compare them with [mm]. */
    AdaptiveStepping(const LoadSteppingParameters &parameters, double radius);

    /** Goes to the beginning of a phase, where the chuck exerts @p forces and
     *  the scene prescribes @p drive, displacements and angles or loads. */
    void
    begin_phase(unsigned int phase, const Forces &forces, const Forces &drive);
    bool
    phase_is_finished() const
    {
      return time == end;
    }

    /** End of the step that is to be tried next. */
    double
    target_time() const;
    /** Whether a trial in the middle of the step, at middle_time(), has to be
     *  made before its end can be judged. */
    bool
    wants_middle() const
    {
      return !has_previous && !has_middle;
    }
    double
    middle_time() const;
    void
    note_middle(const Forces &forces);

    /** The error of the curves in the step relative to the tolerance, given
     *  forces and drive at its end. */
    double
    error(const Forces &forces, const Forces &drive);
    /** Takes the step; @p error is the above. */
    void
    accept(const Forces &forces, double error);
    /** Makes the step smaller because of its @p error; false if it cannot be
     *  smaller and has to be taken as it is. */
    bool
    shrink(double error);
    /** Halves the step because it could not be solved; false if it cannot be
     *  smaller. */
    bool
    reject();

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &time &end &size &largest &current &previous &middle;
      archive &previous_time &previous_error &has_previous &has_middle;
      archive &greatest &first_drive &has_first_drive      &is_driven;
    }

  private:
    double
    smallest() const;
    double
    relative_to_tolerance(const Forces &difference, const Forces &forces) const;
    void
    set_size(double new_size);
    void
    note_drive(const Forces &drive);

    const LoadSteppingParameters parameters;
    const double                 radius;
    double                       time = 0, end = 0, size = 0, largest = 0;
    Forces current        = Forces::Zero(); ///< at the beginning of the step
    Forces previous       = Forces::Zero(); ///< one step before
    Forces middle         = Forces::Zero();
    double previous_time  = 0;
    double previous_error = 0; ///< of the step before
    bool   has_previous = false, has_middle = false;
    Forces greatest        = Forces::Zero(); ///< so far
    Forces first_drive     = Forces::Zero();
    bool   has_first_drive = false;
    std::array<bool, 6> is_driven{}; ///< whether the drive has changed so far
  };
} // namespace Debond
#endif
