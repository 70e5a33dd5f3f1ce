#ifndef debond_input_input_file_h
#define debond_input_input_file_h

#include <string>

namespace Debond
{
  /**
   * The bytes of a file that a user has named. Directories, files that cannot
   * be read, and those of more than @p largest_MB are refused: throws
   * InputError, whose message is @p where, which ends in ": ", and what is
   * wrong.
   */
  std::string
  read_input_bytes(const std::string &filename,
                   const std::string &where,
                   unsigned int       largest_MB);

  /** The same for a text, as plain_text() makes it of the bytes. */
  std::string
  read_input_text(const std::string &filename,
                  const std::string &where,
                  unsigned int       largest_MB);

  /** A text with lines that end in '\n' only, whatever system it is from, and
   *  without the mark that some editors begin a file with. Refuses what is no
   *  text, as read_input_bytes() does: shown in a message it would be
   *  unreadable, and the cause is nearly always a wrong file name. */
  std::string
  plain_text(const std::string &bytes, const std::string &where);
} // namespace Debond
#endif
