#ifndef debond_system_path_following_h
#define debond_system_path_following_h

#include <debond/scene/scene.h>

namespace Debond
{
  /**
   * The steps along a path of equilibrium that may snap back. Where points
   * slide, a step prescribes the mean sliding distance, which only grows, and
   * the time is found; where little slides, it prescribes the time. A step that
   * cannot be solved, or whose state is too far away, is tried again with the
   * other control, and then smaller. No step goes further in time than a
   * planned one.
   */
  class PathFollowing
  {
  public:
    explicit PathFollowing(const Scene &scene);

    /** Goes to the beginning of a phase. */
    void
    begin_phase(unsigned int phase, double mean_slip);
    bool
    phase_is_finished() const
    {
      return time == end;
    }

    /** Whether the mean sliding distance has reached the end of the path. */
    bool
    has_ended() const
    {
      return mean_slip >= end_slip;
    }
    double
    end_of_path() const
    {
      return end_slip;
    } ///< [mm]

    /** The step that is to be tried next. */
    struct Step
    {
      bool   by_slip     = false;
      bool   extrapolate = false;
      double time        = 0; ///< wanted, or a guess if by_slip
      double slip        = 0; ///< growth of the mean slip, if by_slip [mm]
      /** Size relative to the step before: for the extrapolated start. */
      double ratio = 0;
    };
    Step
    next() const;

    /** Judges a step that was solved: false if it went too far, and a smaller
     *  one has to be tried. */
    bool
    accept(const Step  &step,
           double       new_time,
           double       new_mean_slip,
           unsigned int iterations);
    /** Makes the step smaller because it could not be solved; false if it
     *  cannot be smaller. */
    bool
    reject(const Step &step);

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &time &end &planned &mean_slip &slip_size &time_size;
      archive &last_time_step &last_slip_step &has_last &goes_to_end;
    }

  private:
    bool
    prefers_slip(const Step &step) const;
    bool
    reject_time(const Step &step);

    const LoadSteppingParameters parameters;
    const double                 largest_slip, end_slip; ///< [mm]
    double                       time = 0, end = 0, planned = 0, mean_slip = 0;
    double slip_size = 0, time_size = 0; ///< of the next step
    double last_time_step = 0, last_slip_step = 0;
    bool   has_last = false;
    /** The last slip step would have left the phase. */
    bool goes_to_end = false;
    /** What has failed since the last accepted step; the other control is tried
     *  next. */
    bool slip_failed = false, time_failed = false;
  };
} // namespace Debond
#endif
