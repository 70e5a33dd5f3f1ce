#ifndef debond_system_path_following_h
#define debond_system_path_following_h

#include <debond/system/step_control.h>

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
  class PathFollowing : public StepControl
  {
  public:
    /** The path ends at a mean sliding distance of @p end_slip [mm]; no step is
     *  larger than @p largest_slip [mm]. */
    PathFollowing(const LoadSteppingParameters &parameters,
                  double                        largest_slip,
                  double                        end_slip);

    void
    begin_phase(const StepState &accepted) override;
    Step
    next() override;
    bool
    take(const Step      &step,
         const StepState &state,
         unsigned int     iterations) override;
    bool
    reject(const Step &step) override;

    /** Whether the mean sliding distance has reached the end of the path. */
    bool
    has_ended() const
    {
      return mean_slip >= end_slip;
    }
    bool
    is_finished() const override
    {
      return StepControl::is_finished() || has_ended();
    }
    std::string
    reason_to_end() const override;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int version)
    {
      StepControl::serialize(archive, version);
      archive &mean_slip &slip_size           &time_size;
      archive &last_time_step &last_slip_step &goes_to_end;
    }

  private:
    bool
    prefers_slip(const Step &step) const;
    bool
    reject_time(const Step &step);

    const double largest_slip, end_slip; ///< [mm]
    double       mean_slip = 0;
    double       slip_size = 0, time_size = 0; ///< of the next step
    double       last_time_step = 0, last_slip_step = 0;
    /** The last slip step would have left the phase. */
    bool goes_to_end = false;
    /** What has failed since the last accepted step; the other control is tried
     *  next. */
    bool slip_failed = false, time_failed = false;
  };
} // namespace Debond
#endif
