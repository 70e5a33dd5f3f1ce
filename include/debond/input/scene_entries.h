#ifndef debond_input_scene_entries_h
#define debond_input_scene_entries_h

#include <debond/input/scene_file.h>

#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Debond
{
  /** What is declared of an entry. */
  struct DeclaredEntry
  {
    std::vector<std::string> subsections;
    std::string              name;
    std::string              documentation;
    std::string              allowed; ///< ends the sentence "expected ..."

    /** "Interface / Bonding / Pattern". */
    std::string
    full_name() const;
  };

  /** All entries declared in @p prm, in the order of their declaration. */
  std::vector<DeclaredEntry>
  declared_entries(const dealii::ParameterHandler &prm);

  /**
   * Gives the entries of a scene to @p prm one by one. Throws InputError that
   * names place, entry, value and what is allowed if an entry is unknown or its
   * value not allowed. A value may appear several times: the last one counts.
   */
  void
  apply_entries(const std::vector<SceneEntry> &entries,
                dealii::ParameterHandler      &prm);

  /** Writes all entries with their documentation, what they allow and their
   *  current values; the result can be read as a scene. */
  void
  print_entries(const dealii::ParameterHandler &prm, std::ostream &out);
} // namespace Debond
#endif
