#ifndef debond_models_debonding_problem_h
#define debond_models_debonding_problem_h

#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>
#include <debond/support/input_error.h>

#include <iosfwd>
#include <memory>
#include <vector>

namespace Debond
{
  struct BodyPair;
  struct Checkpoint;

  /**
   * Runs a Simulation as the program does: into a directory, with lines on the
   * console, fields, a summary, and checkpoints to go on from.
   */
  class DebondingProblem
  {
  public:
    /** @p bodies: see CoupledSystem. */
    explicit DebondingProblem(const Scene              &scene,
                              std::shared_ptr<BodyPair> bodies = nullptr);
    ~DebondingProblem();

    void
    run()
    {
      run(nullptr);
    }

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

    void
    run(const Checkpoint *checkpoint);

    const Scene               scene;
    std::shared_ptr<BodyPair> bodies;
    std::unique_ptr<Run>      current; ///< while and after it runs
  };
} // namespace Debond
#endif
