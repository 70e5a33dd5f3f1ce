#pragma once

#include <debond/output/checkpoint.h>
#include <debond/scene/scene.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Debond
{
  /** A run that was interrupted, or is extended to later times. */
  struct ResumedRun
  {
    Scene scene; ///< writes into the directory where the checkpoint is
    /** Without a state: the coarser run is not finished. */
    std::optional<Checkpoint> checkpoint;
    /** What a user has to know about the checkpoint. */
    std::vector<std::string> remarks;
    /** Keeps others out until the run has opened it. */
    std::shared_ptr<const ResultDirectory> directory;
  };

  /**
   * Looks for the newest checkpoint in @p directory. The scene is that of
   * @p scene_file with @p overrides, or, without a file, the one that is stored
   * with the checkpoint with these overrides. Nothing if the run there is
   * finished, and the scene does not extend it: by further `Load steps / Times`
   * and Steps, and by what the chuck does after the last time of before.
   *
   * Throws InputError if there is no run to go on with, or if the scene differs
   * from that of the checkpoint in more than Title and Output / Directory,
   * Console and Checkpoint every; the message lists the entries.
   */
  std::optional<ResumedRun>
  find_interrupted_run(const std::string              &directory,
                       const std::string              &scene_file,
                       const std::vector<std::string> &overrides);

  /** Whether @p scene goes on where the one with @p earlier completed
   * parameters ends: it has its times and steps, then further ones, and up to
   * there the same values of the chuck. */
  bool
  extends(const Scene &scene, const std::string &earlier);

  /** The checkpoint from which a run of @p scene into its directory can go on;
   *  none if there is none, or one of another scene or program. Throws
   * InputError if it cannot be read. */
  std::optional<Checkpoint>
  find_checkpoint(const Scene &scene);
} // namespace Debond
