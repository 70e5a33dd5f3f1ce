#ifndef debond_campaigns_study_h
#define debond_campaigns_study_h

#include <debond/input/scene_file.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace Debond
{
  /**
   * A scene whose entries hold several values: runs every variant, several at a
   * time, into DIR/variant-001 and so on, and gathers them in DIR/study.csv.
   *
   * Variants are processes of their own, so that one that fails leaves the
   * others alone; class VariantQueue says what they have in common. A variant
   * whose directory holds the finished results of the same scene is not run
   * again, one that has left a checkpoint goes on from it.
   *
   * With `Study / Repetitions` every variant is run several times, one after
   * the other in its directory, which keeps the summary of each run as
   * repetition-1.json and so on; seconds in study.csv are medians over them.
   *
   * Reads all variants before anything runs, runs what is not there yet,
   * @p n_jobs at a time, and writes study.csv every few seconds and at the end,
   * then, if seeds are varied, the statistics of class Ensemble. @p force: runs
   * all, whatever their directories hold. Throws InputError, as Scene does, if
   * any of the variants is no valid scene, RunError at the end if any of them
   * failed, and Interrupted if a signal asks to stop.
   */
  void
  run_study(const std::vector<SceneEntry> &entries,
            const std::string             &name,
            unsigned int                   n_jobs,
            bool                           force,
            std::ostream                  &out);

  /** Says what would be run. */
  void
  check_study(const std::vector<SceneEntry> &entries,
              const std::string             &name,
              std::ostream                  &out);
} // namespace Debond
#endif
