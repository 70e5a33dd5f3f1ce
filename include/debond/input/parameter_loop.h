#ifndef debond_input_parameter_loop_h
#define debond_input_parameter_loop_h

#include <debond/input/scene_file.h>

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
    std::vector<std::size_t> varied; ///< their places in `entries`
  };

  /** The entries that hold several values, `{{` and what follows, in the order
   * of the scene. A scene without any is no study. */
  std::vector<SceneEntry>
  varied_entries(const std::vector<SceneEntry> &entries);

  /**
   * All variants of a study. The notation resembles that of deal.II's
   * MultipleParameterLoop, which writes {a|b} and {{a|b}} for the first two:
   *
   *   {{a|b|c}}         every value with every combination of the others; the
   *                     entry that comes first in the scene varies fastest
   *   {{a||b||c}}       variant i takes value i: as many values as variants,
   *                     whose number such entries set if there are no others
   *   {{name: a|b|c}}   all entries with this name take the values of the same
   *                     position, in every combination with the others
   *
   * In all of them the item 1..200 stands for the whole numbers from 1 to 200.
   * Text around the braces belongs to every value. Each entry may be there once
   * only. With @p factors_at_once > 0 only those combinations remain in which
   * at most that many factors, which are entries or named groups of entries,
   * differ from their first value; {{a||b||c}} is then refused. Throws
   * InputError with place and entry if braces do not match, numbers of values
   * disagree, a range is empty or there are more than 100000 variants.
   */
  std::vector<StudyVariant>
  study_variants(const std::vector<SceneEntry> &entries,
                 unsigned int                   factors_at_once = 0);
} // namespace Debond
#endif
