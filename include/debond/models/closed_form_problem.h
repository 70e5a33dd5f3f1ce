#ifndef debond_models_closed_form_problem_h
#define debond_models_closed_form_problem_h

#include <debond/models/closed_forms.h>
#include <debond/models/foundation.h>
#include <debond/models/problem.h>
#include <debond/output/console.h>
#include <debond/output/profile_output.h>

#include <deal.II/base/timer.h>

#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  /**
   * Runs a scene with one of the closed forms instead of finite elements: the
   * same loads, the same result files. Closed forms know one loading, a coin
   * that is pressed down and then turned, ever further, under constant
   * pressure; scenes that ask for more are refused.
   */
  class ClosedFormProblem : public Problem
  {
  public:
    /** Throws InputError, beginning with the name of the entry, if the closed
     *  form does not apply to the scene. */
    explicit ClosedFormProblem(const Scene &scene);
    ~ClosedFormProblem() override;

    void
    run() override;
    void
    check(std::ostream &out) override;
    const std::vector<TorqueRow> &
    rows() const override
    {
      return torque_rows;
    }
    /** The linear solution that the stiffness is from, if it was needed. */
    const FoundationStiffness &
    linear_solution() const
    {
      return bulk;
    }

  private:
    struct Load
    {
      double time  = 0;
      double push  = 0; ///< depth [mm] or force [N], positive downwards
      double angle = 0; ///< [rad]
    };

    Load
    load_at(double time) const;
    void
    find_loads();
    void
    check_loads() const;
    void
    refine_loads();
    void
    find_stiffness();
    double
    pressure(const Load &load) const;
    void
    make_model();
    /** Of the disk [rad]. */
    double
    angle_of_disk(const Load &load) const;
    /** By jumps, up to this load [N mm]. */
    double
    released_energy(const Load &load) const;
    TorqueRow
    row(unsigned int step);
    void
    warn_of_jumps(Console &console) const;
    void
    write_summary(const ResultDirectory &directory,
                  const ProfileOutput   &profiles,
                  Console               &console,
                  double                 seconds_before_steps) const;

    const dealii::Timer           clock;
    const Scene                   scene;
    std::vector<Load>             loads; ///< one per row
    FoundationStiffness           bulk;
    double                        normal_stiffness = 0, lambda = 0; // [MPa/mm]
    std::unique_ptr<TorsionModel> model;
    std::unique_ptr<CompliantMachineTorsion> machine; ///< if it is compliant
    std::vector<TorqueRow>                   torque_rows;
  };
} // namespace Debond
#endif
