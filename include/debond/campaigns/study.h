#ifndef debond_campaigns_study_h
#define debond_campaigns_study_h

#include <debond/campaigns/variant.h>
#include <debond/support/input_error.h>

#include <deal.II/base/timer.h>

#include <iosfwd>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  /** Columns of study.csv and their values, of one variant. */
  using StudyRow = std::vector<std::pair<std::string, std::string>>;

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
   */
  class Study
  {
  public:
    /** Reads all variants. Throws InputError, as Scene does, if any of them is
     *  no valid scene. */
    Study(const std::vector<SceneEntry> &entries, const std::string &name);

    /** Runs what is not there yet, @p n_jobs at a time, and writes study.csv
     *  every few seconds and at the end, then, if seeds are varied, the
     *  statistics of class Ensemble. @p force: runs all, whatever their
     *  directories hold. Throws RunError at the end if any of them failed, and
     *  Interrupted if a signal asks to stop. */
    void
    run(unsigned int n_jobs, bool force, std::ostream &out);

    /** The directory of study.csv. */
    const std::string &
    result_directory() const
    {
      return directory;
    }

    /** Says what would be run. */
    void
    check(std::ostream &out);

  private:
    std::string
    describe(unsigned int variant) const;
    /** Returns what keeps others out of the directory of the study. */
    DirectoryLock
    prepare(bool force);
    void
    report(unsigned int variant, std::ostream &out) const;
    StudyRow
    table_row(unsigned int variant) const;
    /** Ends a study that a signal asks to stop: throws Interrupted. */
    [[noreturn]] void
    stop();
    void
    write_table();
    void
    write_table_if_due();
    void
    write_ensemble(std::ostream &out) const;

    std::vector<std::string> varied; ///< full names of the varied entries
    std::vector<Variant>     variants;
    std::string              directory;
    unsigned int             reference = 0; ///< number of a variant, 0: none
    dealii::Timer            since_table;
    double                   time_between_tables = 2; ///< [s]
  };
} // namespace Debond
#endif
