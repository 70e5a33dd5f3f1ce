#pragma once

#include <debond/scene/scene.h>

#include <iosfwd>
#include <memory>

namespace Debond
{
  struct BodyPair;
  struct Checkpoint;

  /**
   * Runs a scene with finite elements. If it has an `Accuracy`, a coarser run
   * in the folder `coarser` of its directory comes first, from which errors are
   * estimated; then the scene itself; and, as long as the estimate is more than
   * what is asked for, the same with more of the cells that were chosen for it.
   *
   * @p checkpoint: of the scene, from which it goes on; without a state it is
   * the coarser run that goes on. Throws as DebondingProblem::run().
   */
  void
  run_to_accuracy(Scene                     scene,
                  std::shared_ptr<BodyPair> bodies     = nullptr,
                  const Checkpoint         *checkpoint = nullptr);

  /** Prints what has been chosen for an accuracy; nothing without one. */
  void
  print_choices(const Scene &scene, std::ostream &out);
} // namespace Debond
