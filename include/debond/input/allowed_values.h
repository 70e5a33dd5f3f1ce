#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace Debond
{
  /** What an entry of a scene accepts, together with the words that tell a user
   *  so. */
  struct AllowedValues
  {
    /** Whether the trimmed text of a value is allowed. */
    std::function<bool(const std::string &)> test;
    /** Ends the sentence "expected ...". */
    std::string description;
    /** What may be wrong with a text that is not allowed; may be empty. */
    std::function<std::string(const std::string &)> hint;
    /** What one may choose from, if the entry is a choice. */
    std::vector<std::string> names = {};
    /** A word, such as `auto' or `none', and the text of the value that it
     *  stands for. Both may be empty. */
    std::string word = "", word_value = "";
    /** Whether a scene that reads the entry need not set it. */
    bool has_default = true;


    /** "expected ..." with a hint, or nothing if @p text is allowed. */
    std::string
    refusal(const std::string &text) const;

    /** The same values and this number. */
    AllowedValues
    or_number(double number) const;
    /** The same values and this word. */
    AllowedValues
    or_word(const std::string &word) const;
    /** The same values and this word, which stands for the value @p text of a
     *  member: an empty name, or a number that is none of the others. */
    AllowedValues
    or_word_for(const std::string &word, const std::string &text) const;

    /** The same values of an entry that a scene has to set where it reads it.
     */
    AllowedValues
    without_default() const;

    /** The text of an entry for the text of a member's value, and back. */
    std::string
    in_words(const std::string &value) const;
    std::string
    without_words(const std::string &text) const;
  };

  /** The kinds of values that occur in a scene. The unit is part of the words
   *  and may be empty. */
  namespace Allowed
  {
    /** Any finite number. */
    AllowedValues
    number(const std::string &unit);

    /** A number > @p bound. */
    AllowedValues
    number_above(double bound, const std::string &unit);

    /** A number >= @p bound. */
    AllowedValues
    number_from(double bound, const std::string &unit);

    /** A number in [@p lower, @p upper]. */
    AllowedValues
    number_between(double lower, double upper, const std::string &unit);

    /** A whole number in [@p lower, @p upper]. */
    AllowedValues
    whole_number(unsigned int lower, unsigned int upper);

    /** Numbers that @p each allows, separated by commas, at least @p min_count
     *  and at most @p max_count of them (0: no limit). */
    AllowedValues
    list(const AllowedValues &each,
         unsigned int         min_count,
         unsigned int         max_count);

    /** One of the choices "a | b | c", for a bool "false | true". */
    AllowedValues
    choice(const std::string &choices);

    /** Any text; @p what says what it is. */
    AllowedValues
    text(const std::string &what, bool may_be_empty = true);

    /** The name of a directory to write into, without what was meant for a
     *  shell or another system: no quotes, no backslash, no ~ or $ at the
     *  beginning; and not the root of all directories. */
    AllowedValues
    directory();
  } // namespace Allowed

  /** Reads a whole text as one decimal number, surrounding blanks ignored, that
   *  is finite and not so small that digits are lost; nothing if it is none. */
  std::optional<double>
  read_number(const std::string &text);

  /** Splits a text at @p separator into trimmed items. */
  std::vector<std::string>
  split(const std::string &text, const std::string &separator);

  /** Splits a list at its commas into trimmed items; an empty text has none. */
  std::vector<std::string>
  split_list(const std::string &text);

  bool
  is_among(const std::vector<std::string> &names, const std::string &name);

  /** Remark on a character of @p text that is not ASCII, or nothing. Word
   *  processors and web pages put such characters where they can hardly be told
   *  from plain ones, or not be seen at all. */
  std::string
  remark_on_special_character(const std::string &text);
} // namespace Debond
