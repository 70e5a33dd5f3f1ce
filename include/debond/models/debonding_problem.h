#pragma once

#include <debond/output/result_files.h>
#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>

#include <iosfwd>
#include <memory>
#include <vector>

namespace Debond
{
  struct BodyPair;
  struct Checkpoint;

  /** The directory of a run, which @p resumes or begins anew. Throws InputError
   *  if it holds what must not be lost. Collective. */
  ResultDirectory
  open_directory(const Scene &scene, bool resumes);

  /**
   * Runs a Simulation as the program does: into a directory, with lines on the
   * console, fields, a summary, and checkpoints to go on from.
   */
  struct DebondingProblem
  {
    /** @p bodies: see CoupledSystem. Throws NotEnoughMemory. */
    explicit DebondingProblem(const Scene              &scene,
                              std::shared_ptr<BodyPair> bodies = nullptr);

    /** From the beginning, or from a checkpoint of a run of this scene: rows
     *  and files from there on are those of a run that was never interrupted,
     *  to the last bit. Throws InputError, with its place in the scene, if the
     *  checkpoint is not from this program; what Simulation throws;
     *  Interrupted, WriteError. */
    void
    run(const Checkpoint *checkpoint = nullptr);

    /** Builds the meshes, prints degrees of freedom and what closed forms
     *  predict, and runs nothing. */
    void
    check(std::ostream &out) const;

    const Scene               scene;
    std::shared_ptr<BodyPair> bodies;
    /** Those of the run, also of one that failed. */
    std::vector<TorqueRow> rows;
  };
} // namespace Debond
