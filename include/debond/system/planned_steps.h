#ifndef debond_system_planned_steps_h
#define debond_system_planned_steps_h

#include <debond/system/load_stepping.h>
#include <debond/system/step_control.h>

namespace Debond
{
  /**
   * The planned steps of a scene, each a row, and the sub-steps that they are
   * cut into. A sub-step is a power of two of its planned step, so that its end
   * is exact. One that fails is halved; after one that succeeds the next may be
   * twice as large. Their size is kept from one planned step to the next.
   */
  class PlannedSteps : public StepControl
  {
  public:
    explicit PlannedSteps(const LoadSteppingParameters &parameters)
      : StepControl(parameters)
      , plan(parameters)
    {}

    Step
    next() override;
    bool
    take(const Step &step, const StepState &, unsigned int) override;
    bool
    reject(const Step &) override;
    bool
    row_is_complete() const override
    {
      return done == 1.;
    }
    std::string
    reason_to_end() const override
    {
      return "all planned steps are done";
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int version)
    {
      StepControl::serialize(archive, version);
      archive &current &done &size;
    }

  private:
    const LoadStepping plan;
    unsigned int       current = 0;
    double             done = 1, size = 1; ///< exact: sums of powers of two
  };
} // namespace Debond
#endif
