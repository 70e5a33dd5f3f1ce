#pragma once

#include <functional>
#include <string>

namespace Debond
{
  /** Throws an InputError that says what is wrong with a file, in the words of
   *  @p why, and which file it is. */
  using FileRefusal = std::function<void(const std::string &why)>;

  /** The bytes of a file that a user has named. Directories, files that cannot
   *  be read, and those of more than @p largest_MB are refused. */
  std::string
  read_input_bytes(const std::string &filename,
                   const FileRefusal &refuse,
                   unsigned int       largest_MB);

  /** A line `# NAME: N bytes, CRC-64 X`, a comment of a scene, that tells one
   *  content of a file from another: whatever is made of a file belongs to its
   *  content, not to its name or its time. Empty if there is no such file, or
   *  none with an end. */
  std::string
  identity_of(const std::string &filename);

  /** A text with lines that end in '\n' only, whatever system it is from, and
   *  without the mark that some editors begin a file with. Refuses what is no
   *  text: shown in a message it would be unreadable, and the cause is nearly
   *  always a wrong file name. */
  std::string
  plain_text(const std::string &bytes, const FileRefusal &refuse);

  /** A text in UTF-8 that is in UTF-8 or in Latin-1, as German editors and
   *  spreadsheets of Windows write it. */
  std::string
  utf8(const std::string &text);
} // namespace Debond
