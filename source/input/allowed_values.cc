#include <debond/input/allowed_values.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>

namespace Debond
{
  using dealii::Utilities::trim;



  std::string
  AllowedValues::refusal(const std::string &text) const
  {
    const std::string trimmed = trim(text);
    if (test(trimmed))
      return "";
    std::string remark = remark_on_special_character(text);
    if (remark.empty() && hint)
      remark = hint(trimmed);
    return "expected " + description + (remark.empty() ? "" : "; " + remark);
  }



  namespace
  {
    /** What @p values allow, and texts that @p is_other accepts; @p words name
     *  these. */
    AllowedValues
    with_others(const AllowedValues                            &values,
                const std::string                              &words,
                const std::function<bool(const std::string &)> &is_other)
    {
      AllowedValues result = values;
      result.test = [test = values.test, is_other](const std::string &text) {
        return is_other(text) || test(text);
      };
      result.description = words + ", or " + values.description;
      return result;
    }



    constexpr double infinity = std::numeric_limits<double>::infinity();



    bool
    consists_of(const std::string &text, const std::string &letters)
    {
      return text.find_first_not_of(letters) == std::string::npos;
    }



    /** What may be wrong with something that is no number; nothing of one. */
    std::string
    why_no_number(const std::string &text)
    {
      if (read_number(text))
        return "";
      const std::vector<std::string> items = split_list(text);
      if (items.empty())
        return "a value is missing";
      if (items.size() == 2 && read_number(items[0]) &&
          consists_of(items[1], "0123456789"))
        return "decimals are written with a point, and nothing stands between "
               "thousands";
      const std::string beginning =
        text.substr(0, text.find_first_not_of("0123456789+-."));
      if (read_number(beginning) && !consists_of(text, "0123456789+-.eE"))
        return "give the number alone, without unit or formula";
      return "'" + shortened(text) + "' cannot be read as a number";
    }



    /** One number in [@p lower, @p upper], in words @p range. */
    AllowedValues
    number_in(const double       lower,
              const double       upper,
              const std::string &range,
              const std::string &unit)
    {
      return {[=](const std::string &text) {
                const auto x = read_number(text);
                return x && *x >= lower && *x <= upper;
              },
              "a number" + range + (unit.empty() ? "" : " [" + unit + "]"),
              why_no_number};
    }
  } // namespace



  AllowedValues
  AllowedValues::or_number(const double number) const
  {
    return with_others(*this,
                       exact_text(number),
                       [number](const std::string &text) {
                         return read_number(text) == number;
                       });
  }



  AllowedValues
  AllowedValues::or_word(const std::string &word) const
  {
    return with_others(*this, word, [word](const std::string &text) {
      return text == word;
    });
  }



  AllowedValues
  AllowedValues::or_word_for(const std::string &word,
                             const std::string &text) const
  {
    AllowedValues result = or_word(word);
    result.word          = word;
    result.word_value    = text;
    return result;
  }



  AllowedValues
  AllowedValues::without_default() const
  {
    AllowedValues result = *this;
    result.has_default   = false;
    return result;
  }



  std::string
  AllowedValues::in_words(const std::string &value) const
  {
    return value == word_value && !word.empty() ? word : value;
  }



  std::string
  AllowedValues::without_words(const std::string &text) const
  {
    return text == word && !word.empty() ? word_value : text;
  }



  std::optional<double>
  read_number(const std::string &text)
  {
    const std::string trimmed = trim(text);
    // from_chars also takes "nan" and "infinity", but no plus
    if (trimmed.empty() ||
        trimmed.find_first_not_of("0123456789+-.eE") != std::string::npos)
      return std::nullopt;
    const bool        has_plus = trimmed[0] == '+' && trimmed[1] != '-';
    const char *const end      = trimmed.data() + trimmed.size();
    double            result   = 0.;
    const auto [behind, error] =
      std::from_chars(trimmed.data() + has_plus, end, result);
    // infinite, or so small that it has lost digits, maybe all of them
    const bool is_zero =
      trimmed.find_first_of("123456789") >= trimmed.find_first_of("eE");
    if (behind != end || error != std::errc() ||
        !(std::isnormal(result) || (result == 0. && is_zero)))
      return std::nullopt;
    return result;
  }



  std::vector<std::string>
  split(const std::string &text, const std::string &separator)
  {
    std::vector<std::string> items;
    boost::iter_split(items, text, boost::first_finder(separator));
    for (std::string &item : items)
      item = trim(item);
    return items;
  }



  std::vector<std::string>
  split_list(const std::string &text)
  {
    return trim(text).empty() ? std::vector<std::string>() : split(text, ",");
  }



  bool
  is_among(const std::vector<std::string> &names, const std::string &name)
  {
    return std::count(names.begin(), names.end(), name) > 0;
  }



  std::string
  remark_on_special_character(const std::string &text)
  {
    const auto special = std::find_if(text.begin(), text.end(), [](char c) {
      return static_cast<unsigned char>(c) > 127;
    });
    if (special == text.end())
      return "";
    const std::string before = shortened({text.begin(), special});
    return "there is a special character " +
           (before.empty() ? "at its beginning" :
                             "in it behind '" + before + "'") +
           ", perhaps a typographic minus, quote or blank";
  }



  namespace Allowed
  {
    AllowedValues
    number(const std::string &unit)
    {
      return number_in(-infinity, infinity, "", unit);
    }



    AllowedValues
    number_above(const double bound, const std::string &unit)
    {
      const double least = std::nextafter(bound, infinity);
      return number_in(least, infinity, " > " + exact_text(bound), unit);
    }



    AllowedValues
    number_from(const double bound, const std::string &unit)
    {
      return number_in(bound, infinity, " >= " + exact_text(bound), unit);
    }



    AllowedValues
    number_between(const double       lower,
                   const double       upper,
                   const std::string &unit)
    {
      const std::string range =
        " from " + exact_text(lower) + " to " + exact_text(upper);
      return number_in(lower, upper, range, unit);
    }



    AllowedValues
    whole_number(const unsigned int lower, const unsigned int upper)
    {
      return {[=](const std::string &text) {
                return consists_of(text, "+0123456789") &&
                       number_in(lower, upper, "", "").test(text);
              },
              "a whole number from " + std::to_string(lower) + " to " +
                std::to_string(upper),
              why_no_number};
    }



    AllowedValues
    list(const AllowedValues &each,
         const unsigned int   min_count,
         const unsigned int   max_count)
    {
      const unsigned int most = max_count == 0 ? unsigned(-1) : max_count;
      const auto         test = [=](const std::string &text) {
        const auto items = split_list(text);
        return items.size() >= min_count && items.size() <= most &&
               std::all_of(items.begin(), items.end(), each.test);
      };
      const auto hint = [=](const std::string &text) -> std::string {
        const auto items = split_list(text);
        for (const std::string &item : items)
          if (!read_number(item))
            return text.find(';') != std::string::npos ||
                       (!item.empty() &&
                        consists_of(item, "0123456789+-.eE \t")) ?
                     "values are separated by commas" :
                     why_no_number(item);
          else if (!each.test(item))
            return "'" + item + "' is not";
        return "here are " + std::to_string(items.size()) +
               (items.size() > most ? " (decimals are written with a point)" :
                                      "");
      };
      const std::string how_many =
        std::to_string(min_count) +
        (max_count == 0         ? " or more" :
         max_count == min_count ? "" :
                                  " to " + std::to_string(max_count));
      return {test,
              how_many + " values separated by commas, each " +
                each.description,
              hint};
    }



    AllowedValues
    choice(const std::string &choices)
    {
      const std::vector<std::string> names = split(choices, "|");
      return {[names](const std::string &text) {
                return is_among(names, text);
              },
              choices,
              nullptr,
              names};
    }



    AllowedValues
    text(const std::string &what, const bool may_be_empty)
    {
      return {[=](const std::string &text) {
                return may_be_empty || !text.empty();
              },
              what,
              nullptr};
    }



    AllowedValues
    directory()
    {
      const auto test = [](const std::string &text) {
        return !text.empty() && text[0] != '~' && text[0] != '$' &&
               text.find_first_of("\"'`\\") == std::string::npos &&
               text.find("\xE2\x80") == std::string::npos && // typographic ones
               std::filesystem::path(text).lexically_normal() != "/";
      };
      return {test, "the name of a directory", [](const std::string &) {
                return "it is taken as it is: without quotes and backslashes, "
                       "without ~ or $ at its beginning, and not /";
              }};
    }
  } // namespace Allowed
} // namespace Debond
