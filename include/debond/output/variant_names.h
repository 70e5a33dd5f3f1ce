#ifndef debond_output_variant_names_h
#define debond_output_variant_names_h

#include <string>
#include <vector>

namespace Debond
{
  /** What tells the variants of a study apart in words: the values of all
   *  varied entries. Where these are many, or no variant changes all of them,
   *  only those that differ from the values of the first variant. */
  class VariantNames
  {
  public:
    /** @p values: of the @p entries, a row for each variant. */
    VariantNames(const std::vector<std::string>              &entries,
                 const std::vector<std::vector<std::string>> &values);

    /** Of variant @p i, which counts from 0:
     *  "Interface / Sliding threshold = 0.02; Bone / Size = 8". */
    std::string
    full(std::size_t i) const;

    /** The same for pages and legends: "Sliding threshold = 0.02, Size = 8". */
    std::string
    brief(std::size_t i) const;

    /** Whether only what differs is named. */
    bool
    only_changes() const
    {
      return names_changes;
    }

  private:
    bool
    is_changed(std::size_t i, std::size_t entry) const;
    std::string
    name(std::size_t                     i,
         const std::vector<std::string> &names,
         const std::string              &separator) const;

    std::vector<std::string>              entries, short_entries;
    std::vector<std::vector<std::string>> values;
    bool                                  names_changes = false;
  };
} // namespace Debond
#endif
