#ifndef debond_campaigns_variant_h
#define debond_campaigns_variant_h

#include <debond/output/result_files.h>
#include <debond/scene/scene.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace Debond
{
  /** What tells the variants of a study apart: the @p values of all varied
   *  @p entries, a row for each variant, as "Bone / Size = 8; ...". Where these
   *  are many, or no variant changes all of them, only those that differ from
   *  the values of the first variant. */
  std::vector<std::string>
  names_of_variants(const std::vector<std::string>              &entries,
                    const std::vector<std::vector<std::string>> &values);

  /** A variant of a study, and what its directory holds. */
  struct Variant
  {
    std::string name; ///< "variant-001: ENTRY = VALUE; ...", see VariantNames
    Scene       scene;
    std::vector<std::string> values;            ///< of the varied entries
    unsigned int             n_repetitions = 1; ///< runs that are wanted
    /** What results its directory holds, by the text of parameters.prm. */
    bool                   has_this_scene = false, has_other_scene = false;
    nlohmann::ordered_json summary  = nlohmann::ordered_json::object();
    bool                   compared = false; ///< with the reference variant
    bool                   done     = false;
    /** Which program has computed it, if that was another one. */
    std::string other_program;
    /** Its distances are from references with another content. */
    bool                                has_other_references = false;
    std::string                         failure; ///< why it failed, if it did
    std::vector<nlohmann::ordered_json> repetitions; ///< summaries of its runs

    /** Reads what its directory holds. */
    void
    look_up();
    /** To be called when a run has ended: @p why_failed, empty if it did not.
     *  Returns whether all is well, but another run is wanted. */
    bool
    end_run(const std::string &why_failed);
    /** Removes the summaries of earlier runs. */
    void
    forget_repetitions();
    /** Puts its distance from the results of @p other into its summary; not a
     *  number as long as either is not done. */
    void
    compare_with(const Variant &other);
  };
} // namespace Debond
#endif
