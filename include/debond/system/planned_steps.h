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
    explicit PlannedSteps(const LoadSteppingParameters &parameters);

    Step
    next() override;
    bool
    take(const Step &, const StepState &, unsigned int) override;
    bool
    reject(const Step &) override;
    bool
    row_is_complete() const override
    {
      return done == 1.;
    }
    bool
    phase_is_finished() const override
    {
      return plan.ends_phase(current);
    }
    bool
    is_finished() const override
    {
      return current == plan.n_steps() && row_is_complete();
    }
    std::string
    reason_to_end() const override
    {
      return "all planned steps are done";
    }
    unsigned int
    n_planned_rows() const override
    {
      return plan.n_steps();
    }
    unsigned int
    row_in_phase(const unsigned int row) const override
    {
      return plan.step_in_phase(row);
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &current &done &size;
    }

  private:
    const LoadStepping plan;
    const double       smallest; ///< fraction of a planned step
    unsigned int       current = 0;
    double             done = 1, size = 1; ///< exact: sums of powers of two
  };
} // namespace Debond
#endif
