#include <debond/input/allowed_values.h>
#include <debond/input/special_characters.h>
#include <debond/support/number_text.h>

#include <deal.II/base/utilities.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <sstream>
#include <utility>

namespace Debond
{
  AllowedValues::AllowedValues(std::function<bool(const std::string &)> test,
                               std::string description)
    : test(std::move(test))
    , words(std::move(description))
  {}



  bool
  AllowedValues::match(const std::string &text) const
  {
    return test(dealii::Utilities::trim(text));
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



  std::vector<double>
  to_numbers(const std::string &text)
  {
    std::vector<double> numbers;
    for (const std::string &item : split_list(text))
      {
        double number = 0;
        read_number(item, number);
        numbers.push_back(number);
      }
    return numbers;
  }



  std::vector<unsigned int>
  to_whole_numbers(const std::string &text)
  {
    std::vector<unsigned int> numbers;
    for (const double number : to_numbers(text))
      numbers.push_back(static_cast<unsigned int>(number));
    return numbers;
  }



  namespace
  {
    std::string
    in_unit(const std::string &unit)
    {
      return unit.empty() ? "" : " [" + unit + "]";
    }



    /** Admits one number that passes @p test. */
    template <typename Test>
    AllowedValues
    number_that(const Test        &test,
                const std::string &range,
                const std::string &unit)
    {
      return {[test](const std::string &text) {
                double value = 0;
                return read_number(text, value) && test(value);
              },
              "a number" + range + in_unit(unit)};
    }



    bool
    is_whole(const std::string &text, const double lower, const double upper)
    {
      double value = 0;
      return text.find_first_not_of("+0123456789") == std::string::npos &&
             read_number(text, value) && value >= lower && value <= upper;
    }



    template <typename Test>
    std::function<bool(const std::string &)>
    list_of(const Test        &test,
            const unsigned int min_count,
            const unsigned int max_count)
    {
      return [=](const std::string &text) {
        const std::vector<std::string> items = split_list(text);
        if (items.size() < min_count ||
            (max_count > 0 && items.size() > max_count))
          return false;
        for (const std::string &item : items)
          if (!test(item))
            return false;
        return true;
      };
    }



    std::string
    how_many(const unsigned int min_count, const unsigned int max_count)
    {
      if (max_count == 0)
        return std::to_string(min_count) + " or more";
      if (min_count == max_count)
        return std::to_string(min_count);
      return std::to_string(min_count) + " to " + std::to_string(max_count);
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
                         " > " + to_text(bound),
                         unit);
    }



    AllowedValues
    number_from(const double bound, const std::string &unit)
    {
      return number_that([bound](const double x) { return x >= bound; },
                         " >= " + to_text(bound),
                         unit);
    }



    AllowedValues
    number_between(const double       lower,
                   const double       upper,
                   const std::string &unit)
    {
      return number_that([=](
                           const double x) { return x >= lower && x <= upper; },
                         " from " + to_text(lower) + " to " + to_text(upper),
                         unit);
    }



    AllowedValues
    number_between_excluding_lower(const double       lower,
                                   const double       upper,
                                   const std::string &unit)
    {
      return number_that([=](
                           const double x) { return x > lower && x <= upper; },
                         " > " + to_text(lower) + " and <= " + to_text(upper),
                         unit);
    }



    AllowedValues
    whole_number(const unsigned int lower, const unsigned int upper)
    {
      const std::string range =
        upper == std::numeric_limits<unsigned int>::max() ?
          " >= " + std::to_string(lower) :
          " from " + std::to_string(lower) + " to " + std::to_string(upper);
      return {[=](const std::string &text) {
                return is_whole(text, lower, upper);
              },
              "a whole number" + range};
    }



    AllowedValues
    numbers(const unsigned int min_count,
            const unsigned int max_count,
            const bool         positive,
            const std::string &unit)
    {
      const auto test = [positive](const std::string &item) {
        double value = 0;
        return read_number(item, value) && (!positive || value > 0);
      };
      return {list_of(test, min_count, max_count),
              how_many(min_count, max_count) + " numbers" +
                (positive ? " > 0" : "") + " separated by commas" +
                in_unit(unit)};
    }



    AllowedValues
    whole_numbers(const unsigned int min_count, const unsigned int max_count)
    {
      const auto test = [](const std::string &item) {
        return is_whole(item, 1, 1e9);
      };
      return {list_of(test, min_count, max_count),
              how_many(min_count, max_count) +
                " whole numbers >= 1 separated by commas"};
    }



    AllowedValues
    choice(const std::string &choices, const std::string &later)
    {
      const auto test = [choices](const std::string &text) {
        for (const std::string &choice :
             dealii::Utilities::split_string_list(choices, '|'))
          if (text == choice)
            return true;
        return false;
      };
      return {test,
              choices +
                (later.empty() ? "" : " (not in this version: " + later + ")")};
    }



    AllowedValues
    yes_or_no()
    {
      return choice("true | false");
    }



    AllowedValues
    text(const std::string &what)
    {
      return {[](const std::string &text) { return !text.empty(); }, what};
    }



    AllowedValues
    optional_text(const std::string &what)
    {
      return {[](const std::string &) { return true; }, what};
    }



    AllowedValues
    directory()
    {
      const auto test = [](const std::string &text) {
        return !text.empty() && !has_quotes(text) && text[0] != '~' &&
               text[0] != '$' && text.find('\\') == std::string::npos &&
               std::filesystem::path(text).lexically_normal() != "/";
      };
      return {test, "the name of a directory"};
    }



    AllowedValues
    only(const std::string &value)
    {
      const auto test = [value](const std::string &text) {
        double required = 0, given = 0;
        return text == value || (read_number(value, required) &&
                                 read_number(text, given) && given == required);
      };
      return {test,
              (value.empty() ? std::string("nothing") : value) +
                " (not in this version: anything else)"};
    }
  } // namespace Allowed
} // namespace Debond
