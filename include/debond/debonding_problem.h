#ifndef debond_debonding_problem_h
#define debond_debonding_problem_h

#include <debond/problem.h>

#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  /**
   * The model `finite elements`: from a scene to torque curve, summary and
   * fields. run() reads like a table of contents.
   */
  class DebondingProblem : public Problem
  {
  public:
    /** @p bodies: see CoupledSystem. */
    explicit DebondingProblem(const Scene              &scene,
                              std::shared_ptr<BodyPair> bodies = nullptr);
    ~DebondingProblem() override;

    void
    run() override;

    /** Builds the meshes, prints degrees of freedom and what closed forms
     *  foretell, and runs nothing. */
    void
    check(std::ostream &out) override;

    const std::vector<TorqueRow> &
    rows() const override;

  private:
    struct Run;

    /** Where Newton's method looks for the next state: near the last one; with
     *  full corrections, which may jump; or from where the springs of the
     *  machine are relaxed, beyond every state in which they pull. */
    enum class Start
    {
      as_before,
      jump,
      beyond
    };

    void
    set_up();
    void
    solve_first_row();
    void
    solve_planned_step(unsigned int step);
    void
    solve_phase_adaptively(unsigned int phase);
    void
    solve_phase_along_path(unsigned int phase);
    bool
    try_middle(bool extrapolate, unsigned int &iterations);
    /** Tries a step, with an extrapolated start if wanted and again without if
     *  that fails. */
    bool
    try_step(double time, bool extrapolate, unsigned int &iterations);
    /** Whether the chuck would turn too far in a step to @p time for the
     *  direction of slip. */
    bool
    turns_too_far(double time);
    std::string
    reason_to_end() const;
    /** Else a row is a planned step. */
    bool
    rows_are_accepted_steps() const;
    [[noreturn]] void
    give_up(unsigned int step, double time) const;
    /** Tries one sub-step; returns the Newton iterations spent, and whether it
     *  was accepted in @p accepted. */
    unsigned int
    try_sub_step(double time,
                 bool   extrapolate,
                 bool  &accepted,
                 Start  start = Start::as_before);
    void
    accept(double time);
    void
    start_trial(double time, bool extrapolate);
    void
    check_accepted_state();
    void
    check_energy_balance(const std::string &where);
    /** Says so once, and in the row that is written next. */
    void
    note_violation(const std::string &check, const std::string &text);
    /** Whether the law had only one solution at every point in the sub-step
     *  that has just been solved. */
    bool
    is_unique();
    void
    check_for_jump();
    void
    write_bonding();
    void
    write_row(unsigned int step, unsigned int iterations);
    void
    write_fields(unsigned int step);
    void
    finish(bool converged, const std::string &reason);

    const Scene          scene;
    std::unique_ptr<Run> state;
  };
} // namespace Debond
#endif
