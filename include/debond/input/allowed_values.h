#ifndef debond_input_allowed_values_h
#define debond_input_allowed_values_h

#include <deal.II/base/patterns.h>

#include <functional>
#include <string>
#include <vector>

namespace Debond
{
  /**
   * What an entry of a scene accepts, together with the words that tell a user
   * so. deal.II's own patterns know no open intervals, accept `nan`, and
   * describe themselves in a notation made for programs.
   */
  class AllowedValues : public dealii::Patterns::PatternBase
  {
  public:
    /** @p test decides on the trimmed text of a value; @p description ends the
     *  sentence "expected ...". */
    AllowedValues(std::function<bool(const std::string &)> test,
                  std::string                              description);

    bool
    match(const std::string &text) const override;

    std::string
    description(const OutputStyle style = Machine) const override;

    std::unique_ptr<dealii::Patterns::PatternBase>
    clone() const override;

  private:
    std::function<bool(const std::string &)> test;
    std::string                              words;
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
    number_above(const double bound, const std::string &unit);

    /** A number >= @p bound. */
    AllowedValues
    number_from(const double bound, const std::string &unit);

    /** A number in [@p lower, @p upper]. */
    AllowedValues
    number_between(const double       lower,
                   const double       upper,
                   const std::string &unit);

    /** A number in (@p lower, @p upper]. */
    AllowedValues
    number_between_excluding_lower(const double       lower,
                                   const double       upper,
                                   const std::string &unit);

    /** A whole number in [@p lower, @p upper]. */
    AllowedValues
    whole_number(const unsigned int lower, const unsigned int upper);

    /** Numbers separated by commas, at least @p min_count and at most
     *  @p max_count of them (0: no limit); each > 0 if @p positive. */
    AllowedValues
    numbers(const unsigned int min_count,
            const unsigned int max_count,
            const bool         positive,
            const std::string &unit);

    /** Whole numbers >= 1 separated by commas; counts as for numbers(). */
    AllowedValues
    whole_numbers(const unsigned int min_count, const unsigned int max_count);

    /** One of @p choices; @p later names the choices that scenes may use some
     *  day and that this version refuses. Both "a | b | c". */
    AllowedValues
    choice(const std::string &choices, const std::string &later = "");

    /** `true` or `false`. */
    AllowedValues
    yes_or_no();

    /** Text that is not empty; @p what says what it is. */
    AllowedValues
    text(const std::string &what);

    /** Any text, also none; @p what says what it is. */
    AllowedValues
    optional_text(const std::string &what);

    /** The name of a directory to write into, without what was meant for a
     *  shell or another system: no quotes, no backslash, no ~ or $ at the
     *  beginning; and not the root of all directories. */
    AllowedValues
    directory();

    /** Only @p value, because this version does not have what other values
     *  would ask for. */
    AllowedValues
    only(const std::string &value);
  } // namespace Allowed

  /** Reads a whole text as one decimal number, surrounding blanks ignored, that
   *  is finite and not so small that digits are lost. Returns false, and leaves
   * @p value alone, if it is none. */
  bool
  read_number(const std::string &text, double &value);

  /** Splits a list at its commas into trimmed items; an empty text has none. */
  std::vector<std::string>
  split_list(const std::string &text);

  /** The numbers of a list that Allowed::numbers() has admitted. */
  std::vector<double>
  to_numbers(const std::string &text);

  /** The same for Allowed::whole_numbers(). */
  std::vector<unsigned int>
  to_whole_numbers(const std::string &text);
} // namespace Debond
#endif
