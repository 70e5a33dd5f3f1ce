#ifndef debond_models_debonding_problem_h
#define debond_models_debonding_problem_h

#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>
#include <debond/support/run_error.h>

#include <exception>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  struct BodyPair;
  struct Checkpoint;

  /**
   * The model `finite elements`: from a scene to torque curve, summary and
   * fields. run() reads like a table of contents.
   */
  class DebondingProblem
  {
  public:
    /** @p bodies: see CoupledSystem. */
    explicit DebondingProblem(const Scene              &scene,
                              std::shared_ptr<BodyPair> bodies = nullptr);
    ~DebondingProblem();

    void
    run();

    /** The same from a checkpoint of a run of this scene: rows and files from
     *  there on are those of a run that was never interrupted, to the last bit.
     *  Throws InputError if the checkpoint is not from this program. */
    void
    resume(const Checkpoint &checkpoint);

    /** Builds the meshes, prints degrees of freedom and what closed forms
     *  foretell, and runs nothing. */
    void
    check(std::ostream &out);

    const std::vector<TorqueRow> &
    rows() const;

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

    /** From the beginning, or from a checkpoint. */
    void
    run(const Checkpoint *checkpoint);
    void
    set_up(const Checkpoint *checkpoint);
    void
    write_bonding();
    void
    open_directory(bool resumes);
    void
    open_results(const Checkpoint *checkpoint);
    void
    solve_rows();

    /** @name Steps */
    //@{
    void
    solve_first_row();
    bool
    is_finished() const;
    void
    solve_next_row();
    void
    solve_planned_step();
    void
    solve_adaptive_step();
    void
    solve_step_along_path();
    /** Whether the next row is the first one of its phase. */
    bool
    begin_phase_if_due();
    void
    end_phase_if(bool is_finished);
    bool
    try_middle(unsigned int &iterations);
    /** Tries a step, with an extrapolated start if wanted and again without if
     *  that fails. */
    bool
    try_step(double time, bool extrapolate, unsigned int &iterations);
    /** Whether the chuck would turn too far in a step to @p time for the
     *  direction of slip. */
    bool
    turns_too_far(double time);
    bool
    next_step_has_friction() const;
    /** Tries one sub-step; returns the Newton iterations spent, and whether it
     *  was accepted in @p accepted. */
    unsigned int
    try_sub_step(double time,
                 bool   extrapolate,
                 bool  &accepted,
                 Start  start = Start::as_before);
    void
    start_trial(double time, bool extrapolate);
    /** Whether the law had only one solution at every point in the sub-step
     *  that has just been solved. */
    bool
    is_unique();
    void
    accept(double time);
    [[noreturn]] void
    give_up(unsigned int step, double time) const;
    std::string
    reason_to_end() const;
    /** Else a row is a planned step. */
    bool
    rows_are_accepted_steps() const;
    //@}

    /** @name Results */
    //@{
    /** Writes the accepted state, with the iterations that it took since the
     *  last row. */
    void
    write_row(unsigned int iterations);
    bool
    fields_are_due() const;
    void
    finish(bool converged, const std::string &reason);
    void
    finish_after(const std::exception &error);
    //@}

    /** @name Checkpoints */
    //@{
    void
    save_checkpoint();
    /** Throws InputError if a run that begins anew would destroy one. */
    void
    keep_checkpoint() const;
    void
    restore(const Checkpoint &checkpoint);
    /** Throws Interrupted, after a checkpoint, if a signal asks for it. */
    void
    stop_if_interrupted();
    bool
    checkpoint_is_due() const;
    //@}

    const Scene          scene;
    std::unique_ptr<Run> state;
  };
} // namespace Debond
#endif
