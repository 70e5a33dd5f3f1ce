#ifndef debond_parameter_loop_h
#define debond_parameter_loop_h

#include <debond/scene_file.h>

#include <string>
#include <vector>

namespace Debond
{
  /** One combination of the values that a study gives to its entries. */
  struct StudyVariant
  {
    /** All entries of the scene, each with one value. */
    std::vector<SceneEntry> entries;
    /** The values of the varied entries, in the order of varied_entries(). */
    std::vector<std::string> values;
  };

  /** Whether the value of any entry holds `{{`. */
  bool
  is_study(const std::vector<SceneEntry> &entries);

  /** The entries that hold several values, in the order of the scene. */
  std::vector<SceneEntry>
  varied_entries(const std::vector<SceneEntry> &entries);

  /**
   * All variants of a study, in the language of deal.II's
   * MultipleParameterLoop:
   *
   *   {{a|b|c}}         every value with every combination of the others; the
   *                     entry that comes first in the scene varies fastest
   *   {{a||b||c}}       run i takes value i: as many values as variants
   *
   * and, beyond it, to vary entries together in every combination with others,
   *
   *   {{name: a|b|c}}   all entries with this name take the values of the same
   *                     position.
   *
   * Text around the braces belongs to every value. If an entry is there several
   * times the last one counts. Throws InputError with place and entry if braces
   * do not match or numbers of values disagree.
   */
  std::vector<StudyVariant>
  study_variants(const std::vector<SceneEntry> &entries);
} // namespace Debond
#endif
