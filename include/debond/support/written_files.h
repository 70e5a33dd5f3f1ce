#pragma once

#include <memory>
#include <optional>
#include <string>

namespace Debond
{
  /** What is in a file; nothing if there is no such file. Throws InputError if
   *  it cannot be read. */
  std::optional<std::string>
  read_whole_file(const std::string &filename);

  /** on_disk: a loss of power does not undo it either. */
  enum class Durability
  {
    in_system,
    on_disk
  };

  /** Writes a whole file or leaves what was there before: the text goes to a
   *  temporary file that then takes the place of @p filename. Throws
   *  WriteError. Of several ranks the first one does it, as with everything
   *  else here that changes files; the others do nothing. */
  void
  write_file(const std::string &filename,
             const std::string &text,
             Durability         durability = Durability::in_system);
  /** The same on each rank, of files that are its own. */
  void
  write_own_file(const std::string &filename,
                 const std::string &text,
                 Durability         durability = Durability::in_system);

  /** Removes a file if there is one, and what a write_file() that was killed
   * may have left of it. Throws WriteError. */
  void
  remove_file(const std::string &filename);

  /** Waits until a file that has been written is on the disk. Throws
   *  WriteError. */
  void
  put_on_disk(const std::string &filename);

  /** Appends all of @p text to a file, which is then with the system, or
   *  nothing: throws WriteError. */
  void
  append_to_file(const std::string &filename, const std::string &text);

  /** Keeps other processes out of a directory of results as long as it lives.
   *  Children of the process inherit it, programs that it starts do not; it
   *  ends with the last of them, however they end. */
  using DirectoryLock = std::shared_ptr<const int>;

  /** The lock of this process on @p directory: one that it has already, or a
   *  new one. None where there is no such directory or the file system knows
   *  no locks. Throws InputError if another process has it. */
  DirectoryLock
  lock_directory(const std::string &directory);
} // namespace Debond
