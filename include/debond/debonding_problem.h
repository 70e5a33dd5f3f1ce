#ifndef debond_debonding_problem_h
#define debond_debonding_problem_h

#include <debond/scene.h>
#include <debond/torque_curve.h>

#include <iosfwd>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace Debond
{
  /** A run that could not be finished; the message says where and why. */
  class RunError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * The program: from a scene to torque curve, summary and fields. run() reads
   * like a table of contents.
   */
  class DebondingProblem
  {
  public:
    explicit DebondingProblem(const Scene &scene);
    ~DebondingProblem();

    /** Runs the scene and writes everything into its directory. Throws RunError
     *  if a step cannot be solved; what was written before stays, and
     *  summary.json then says `converged: false` and why. */
    void
    run();

    /** Builds the meshes, prints degrees of freedom and what closed forms
     *  foretell, and runs nothing. */
    void
    check(std::ostream &out);

    /** The accepted rows so far. */
    const std::vector<TorqueRow> &
    rows() const;

  private:
    struct Run;

    void
    set_up();
    void
    solve_first_row();
    void
    solve_planned_step(unsigned int step);
    /** Tries one sub-step; returns the Newton iterations spent, and whether it
     *  was accepted in @p accepted. */
    unsigned int
    try_sub_step(double time, bool extrapolate, bool &accepted);
    void
    accept(double time);
    void
    check_accepted_state();
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
