#ifndef debond_campaigns_variant_h
#define debond_campaigns_variant_h

#include <debond/output/result_files.h>
#include <debond/scene/scene.h>

#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  /** Columns of study.csv and their values, of one variant. */
  using StudyRow = std::vector<std::pair<std::string, std::string>>;

  /** The value of a column, empty if there is none of this name. */
  std::string
  member(const StudyRow &members, const std::string &name);
  /** Gives a column that is there another value. */
  void
  set_member(StudyRow          &members,
             const std::string &name,
             const std::string &value);

  /** A variant of a study, and what its directory holds. */
  struct Variant
  {
    Scene                    scene;
    std::vector<std::string> values;            ///< of the varied entries
    unsigned int             n_repetitions = 1; ///< runs that are wanted
    DirectoryContent         content       = DirectoryContent::no_results;
    StudyRow                 summary;          ///< its summary.json
    bool                     compared = false; ///< with the reference variant
    bool                     done     = false;
    std::string              failure;     ///< why it failed, if it did
    std::vector<StudyRow>    repetitions; ///< summaries of all its runs

    /** Reads what its directory holds. */
    void
    look_up();
    /** To be called when a run has ended: @p why_failed, empty if it did not.
     */
    void
    end_run(const std::string &why_failed);
    /** Whether all is well, but runs are missing. */
    bool
    wants_another_run() const;
    /** Removes the summaries of earlier runs. */
    void
    forget_repetitions();
    /** Puts its distance from the results of @p other into its summary; not a
     *  number as long as either is not done. */
    void
    compare_with(const Variant &other);

  private:
    void
    keep_repetition() const;
  };
} // namespace Debond
#endif
