#pragma once

#include <string>
#include <vector>

namespace Debond
{
  /** One `set NAME = VALUE` of a scene, and where it stands. */
  struct SceneEntry
  {
    std::vector<std::string> subsections; ///< outermost first
    std::string              name;
    std::string              value;
    std::string              place; ///< "scene.prm:12", or "--set"

    /** "Interface / Bonding / Pattern". */
    std::string
    full_name() const;

    /** Throws an EntryError: what is wrong with the value, and where it is. */
    [[noreturn]] void
    refuse(const std::string &why) const;
  };

  /**
   * Reads the text of a scene: `subsection NAME`, `set NAME = VALUE`, `end`,
   * `include FILE` (relative to the working directory), comments from `#` to
   * the end of the line, lines continued by a final backslash. This is the
   * language of dealii::ParameterHandler, which forgets in which line an entry
   * stood.
   *
   * An entry may be set once; only a file that includes another one may set
   * entries again that the included file has set before. Then the later value
   * alone is in the result.
   *
   * Throws InputError with file and line if the text breaks these rules; @p
   * name stands for the file in messages.
   */
  std::vector<SceneEntry>
  read_scene_text(const std::string &text, const std::string &name);

  /** Reads a file as read_scene_text() does. Also refuses files that cannot be
   *  read or that are no text. */
  std::vector<SceneEntry>
  read_scene_file(const std::string &filename);

  /** @p entries with overrides "Subsection/Entry=value" in their order. */
  std::vector<SceneEntry>
  with_overrides(std::vector<SceneEntry>         entries,
                 const std::vector<std::string> &overrides);

  /** The text of a scene that sets these entries, above each its documentation
   *  if there is one. */
  std::string
  scene_text(const std::vector<SceneEntry>  &entries,
             const std::vector<std::string> &documentation = {});

  /** Takes "Subsection/Entry=value" apart; its place is "--set". Throws
   *  InputError if there is no `=` or no name. */
  SceneEntry
  read_override(const std::string &text);
} // namespace Debond
