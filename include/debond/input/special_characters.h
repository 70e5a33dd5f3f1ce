#ifndef debond_input_special_characters_h
#define debond_input_special_characters_h

#include <string>

namespace Debond
{
  /**
   * Remark on the first character of @p text that is not ASCII: "; there is a
   * special character in it: U+2212, a typographic minus". Word processors and
   * web pages put such characters where they can hardly be told from plain
   * ones, or not be seen at all. Empty if all characters are ASCII. @p text is
   * UTF-8; a byte that belongs to no such character is named by its number.
   * @p in_expression: say what is written instead, if that is known.
   */
  std::string
  remark_on_special_character(const std::string &text,
                              bool               in_expression = false);

  /** Whether quotes of any kind are in @p text: ", ', ` and the typographic
   *  ones. */
  bool
  has_quotes(const std::string &text);
} // namespace Debond
#endif
