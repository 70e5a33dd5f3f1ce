#pragma once

#include <optional>
#include <stdexcept>
#include <string>

namespace Debond
{
  /** Anything wrong with what the user gave: the message is complete and is
   *  printed as it is. */
  struct InputError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** What a user has written as it is shown in messages: the end of a very long
   *  text is left out. */
  inline std::string
  shortened(const std::string &text)
  {
    constexpr std::size_t longest = 300;
    return text.size() <= longest ? text : text.substr(0, longest) + "...";
  }

  /**
   * A mistake in one entry of a scene. Whoever finds it knows the entry and
   * what is wrong; what the scene says and where is added by
   * Scene::with_place(). The message is
   *
   *   PLACE: ENTRY = 'VALUE': WHY
   */
  struct EntryError : InputError
  {
    /** @p entry: the full name, "Bone / Size"; empty for the scene as a whole.
     *  @p why: what is wrong, or what is expected. @p place: "scene.prm:12". */
    EntryError(const std::string         &entry,
               const std::string         &why,
               std::optional<std::string> value = {},
               const std::string         &place = "")
      : InputError((place.empty() ? "" : place + ": ") + shortened(entry) +
                   (value ? " = '" + shortened(*value) + "'" : "") +
                   (entry.empty() ? "" : ": ") + why)
      , entry(entry)
      , why(why)
      , value(std::move(value))
      , place(place)
    {}

    const std::string                entry, why;
    const std::optional<std::string> value;
    const std::string                place;
  };

  /** A checkpoint that a run cannot go on from: another program, or another
   *  way to solve for the bone, has left it. */
  struct ForeignCheckpoint : InputError
  {
    using InputError::InputError;
  };

  /** A run that could not be finished; the message says where and why. */
  struct RunError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** A file of results that could not be written: a full disk, a directory that
   *  is not ours to write to. The message names the file and says what the
   *  system says. */
  struct WriteError : RunError
  {
    using RunError::RunError;
  };

  /** A run or a study that a signal has ended; the message says how to go on.
   */
  struct Interrupted : std::runtime_error
  {
    Interrupted(const int signal, const std::string &message)
      : std::runtime_error(message)
      , signal(signal)
    {}

    const int signal;
  };
} // namespace Debond
