#include <debond/input/allowed_values.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <utility>

namespace Debond
{
  AllowedValues::AllowedValues(Test                     test,
                               std::string              description,
                               std::vector<std::string> names)
    : test(std::move(test))
    , words(std::move(description))
    , choices(std::move(names))
  {}



  std::string
  AllowedValues::refusal(const std::string &text) const
  {
    const std::optional<std::string> hint = test(dealii::Utilities::trim(text));
    if (!hint)
      return "";
    const std::string special = remark_on_special_character(text);
    const std::string remark  = special.empty() ? *hint : special;
    return "expected " + words + (remark.empty() ? "" : "; " + remark);
  }



  AllowedValues
  AllowedValues::or_number(const double number) const
  {
    const auto or_this =
      [test = test,
       number](const std::string &text) -> std::optional<std::string> {
      double value = 0;
      if (read_number(text, value) && value == number)
        return std::nullopt;
      return test(text);
    };
    return {or_this, exact_text(number) + ", or " + words};
  }



  bool
  AllowedValues::match(const std::string &text) const
  {
    return refusal(text).empty();
  }



  std::string
  AllowedValues::description(const OutputStyle) const
  {
    return words;
  }



  std::unique_ptr<dealii::Patterns::PatternBase>
  AllowedValues::clone() const
  {
    return std::make_unique<AllowedValues>(*this);
  }



  bool
  read_number(const std::string &text, double &value)
  {
    const std::string trimmed = dealii::Utilities::trim(text);
    // strtod also takes hexadecimal numbers, "nan" and "infinity".
    if (trimmed.empty() ||
        trimmed.find_first_not_of("0123456789+-.eE") != std::string::npos)
      return false;
    char *end           = nullptr;
    errno               = 0;
    const double result = std::strtod(trimmed.c_str(), &end);
    // infinite, or so small that it has lost digits
    if (*end != '\0' || errno == ERANGE)
      return false;
    value = result;
    return true;
  }



  std::vector<std::string>
  split_list(const std::string &text)
  {
    std::vector<std::string> items;
    if (dealii::Utilities::trim(text).empty())
      return items;
    std::string::size_type begin = 0;
    while (true)
      {
        const std::string::size_type comma = text.find(',', begin);
        items.push_back(
          dealii::Utilities::trim(text.substr(begin, comma - begin)));
        if (comma == std::string::npos)
          return items;
        begin = comma + 1;
      }
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



  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();



    bool
    consists_of(const std::string &text, const std::string &letters)
    {
      return text.find_first_not_of(letters) == std::string::npos;
    }



    /** What may be wrong with something that is no number. */
    std::string
    why_no_number(const std::string &text)
    {
      const std::vector<std::string> items  = split_list(text);
      double                         number = 0;
      if (items.empty())
        return "a value is missing";
      if (items.size() == 2 && read_number(items[0], number) &&
          consists_of(items[1], "0123456789"))
        return "decimals are written with a point, and nothing stands between "
               "thousands";
      const std::string beginning =
        text.substr(0, text.find_first_not_of("0123456789+-."));
      if (read_number(beginning, number) &&
          !consists_of(text, "0123456789+-.eE"))
        return "give the number alone, without unit or formula";
      return "'" + shortened(text) + "' cannot be read as a number";
    }



    /** One number that passes @p test. */
    template <typename Predicate>
    AllowedValues
    number_that(const Predicate   &is_allowed,
                const std::string &range,
                const std::string &unit)
    {
      const auto test =
        [is_allowed](const std::string &text) -> std::optional<std::string> {
        double value = 0;
        if (!read_number(text, value))
          return why_no_number(text);
        return is_allowed(value) ? std::nullopt : std::make_optional("");
      };
      return {test,
              "a number" + range + (unit.empty() ? "" : " [" + unit + "]")};
    }
  } // namespace



  namespace Allowed
  {
    AllowedValues
    number(const std::string &unit)
    {
      return number_that([](const double) { return true; }, "", unit);
    }



    AllowedValues
    number_above(const double bound, const std::string &unit)
    {
      return number_that([bound](const double x) { return x > bound; },
                         " > " + exact_text(bound),
                         unit);
    }



    AllowedValues
    number_from(const double bound, const std::string &unit)
    {
      return number_that([bound](const double x) { return x >= bound; },
                         " >= " + exact_text(bound),
                         unit);
    }



    AllowedValues
    number_between(const double       lower,
                   const double       upper,
                   const std::string &unit)
    {
      return number_that(
        [=](const double x) { return x >= lower && x <= upper; },
        " from " + exact_text(lower) + " to " + exact_text(upper),
        unit);
    }



    AllowedValues
    whole_number(const unsigned int lower, const unsigned int upper)
    {
      const auto test =
        [=](const std::string &text) -> std::optional<std::string> {
        double value = 0;
        if (!read_number(text, value))
          return why_no_number(text);
        return consists_of(text, "+0123456789") && value >= lower &&
                   value <= upper ?
                 std::nullopt :
                 std::make_optional("");
      };
      return {test,
              "a whole number from " + std::to_string(lower) + " to " +
                std::to_string(upper)};
    }



    AllowedValues
    list(const AllowedValues &each,
         const unsigned int   min_count,
         const unsigned int   max_count)
    {
      const auto test =
        [=](const std::string &text) -> std::optional<std::string> {
        const std::vector<std::string> items  = split_list(text);
        double                         number = 0;
        for (const std::string &item : items)
          if (!read_number(item, number))
            return text.find(';') != std::string::npos ||
                       (!item.empty() &&
                        consists_of(item, "0123456789+-.eE \t")) ?
                     "values are separated by commas" :
                     why_no_number(item);
          else if (!each.match(item))
            return "'" + item + "' is not";
        if (items.size() < min_count ||
            (max_count > 0 && items.size() > max_count))
          return "here are " + std::to_string(items.size()) +
                 (max_count > 0 && items.size() > max_count ?
                    " (decimals are written with a point)" :
                    "");
        return std::nullopt;
      };
      const std::string how_many =
        std::to_string(min_count) +
        (max_count == 0         ? " or more" :
         max_count == min_count ? "" :
                                  " to " + std::to_string(max_count));
      return {test,
              how_many + " values separated by commas, each " +
                each.description()};
    }



    AllowedValues
    choice(const std::string &choices)
    {
      const std::vector<std::string> names =
        dealii::Utilities::split_string_list(choices, '|');
      const auto test =
        [names](const std::string &text) -> std::optional<std::string> {
        return std::find(names.begin(), names.end(), text) != names.end() ?
                 std::nullopt :
                 std::make_optional("");
      };
      return {test, choices, names};
    }



    AllowedValues
    yes_or_no()
    {
      return choice("false | true");
    }



    AllowedValues
    text(const std::string &what)
    {
      return {[](const std::string &text) {
                return text.empty() ? std::make_optional("") : std::nullopt;
              },
              what};
    }



    AllowedValues
    optional_text(const std::string &what)
    {
      return {[](const std::string &) { return std::nullopt; }, what};
    }



    AllowedValues
    directory()
    {
      const auto test =
        [](const std::string &text) -> std::optional<std::string> {
        if (!text.empty() && text[0] != '~' && text[0] != '$' &&
            text.find_first_of("\"'`\\") == std::string::npos &&
            text.find("\xE2\x80") == std::string::npos && // typographic ones
            std::filesystem::path(text).lexically_normal() != "/")
          return std::nullopt;
        return "it is taken as it is: without quotes and backslashes, without "
               "~ or $ at its beginning, and not /";
      };
      return {test, "the name of a directory"};
    }



    AllowedValues
    reserved(const std::string &value)
    {
      const auto test =
        [value](const std::string &text) -> std::optional<std::string> {
        return text == value ? std::nullopt : std::make_optional("");
      };
      return {test,
              (value.empty() ? "no value" : value) +
                " (nothing else in this version)"};
    }
  } // namespace Allowed
} // namespace Debond
