#ifndef debond_models_problem_h
#define debond_models_problem_h

#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>
#include <debond/support/run_error.h>

#include <iosfwd>
#include <memory>
#include <vector>

namespace Debond
{
  struct BodyPair;

  /** A scene and the model that it asks for: from the scene to the files in its
   *  directory. */
  class Problem
  {
  public:
    /** The problem of the scene's `Model`. */
    static std::unique_ptr<Problem>
    create(const Scene &scene);
    /** The same with bodies that are built already, see CoupledSystem. Models
     *  other than finite elements make no use of them. */
    static std::unique_ptr<Problem>
    create(const Scene &scene, std::shared_ptr<BodyPair> bodies);

    virtual ~Problem() = default;

    /** Runs the scene and writes everything into its directory. Throws RunError
     *  if it cannot be finished; what was written before stays, and
     *  summary.json then says `converged: false` and why. Throws Interrupted if
     *  a signal asks to stop. */
    virtual void
    run() = 0;

    /** Prints what a run would do, and runs nothing. */
    virtual void
    check(std::ostream &out) = 0;

    /** The accepted rows so far. */
    virtual const std::vector<TorqueRow> &
    rows() const = 0;
  };
} // namespace Debond
#endif
