#pragma once

#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>
#include <string>
#include <utility>

namespace Debond
{
  /** A stream of the standard library whose numbers are those of C++, 1234.5.
   *  Others take their locale, and so 1.234,5 of Germany, from the program that
   *  uses this library. */
  template <typename Stream>
  struct Classic : Stream
  {
    template <typename... Arguments>
    explicit Classic(Arguments &&...arguments)
      : Stream(std::forward<Arguments>(arguments)...)
    {
      this->imbue(std::locale::classic());
    }
  };

  /** A number in a format of std::to_chars, which knows no locale. */
  inline std::string
  to_text(const double number, const int digits, const std::chars_format format)
  {
    char buffer[400]; // 309 digits and a point, and what is asked for behind it
    return {
      buffer,
      std::to_chars(buffer, buffer + sizeof(buffer), number, format, digits)
        .ptr};
  }

  /** With so many significant digits at most; 17 give it back exactly. */
  inline std::string
  to_text(const double number, const int digits = 12)
  {
    return to_text(number, digits, std::chars_format::general);
  }

  /** With so many decimals. */
  inline std::string
  fixed_text(const double number, const int decimals)
  {
    return to_text(number, decimals, std::chars_format::fixed);
  }

  /** The shortest text that gives the number back exactly: 0.1, 18000, 1e-8. */
  inline std::string
  exact_text(const double number)
  {
    char       buffer[400];
    const auto written = [&](const std::chars_format format) {
      char *const end = buffer + sizeof(buffer);
      return std::string(buffer,
                         std::to_chars(buffer, end, number, format).ptr);
    };
    const std::string fixed      = written(std::chars_format::fixed);
    std::string       scientific = written(std::chars_format::scientific);
    const auto        exponent   = scientific.find('e') + 1;
    const bool        is_short_integer =
      fixed.size() <= 6 && number == std::rint(number);
    if (!std::isfinite(number) || is_short_integer)
      return fixed;
    // e-8 instead of e-08
    scientific.replace(exponent,
                       std::string::npos,
                       std::to_string(std::stoi(scientific.substr(exponent))));
    return scientific.size() < fixed.size() ? scientific : fixed;
  }

  /** A text of what a stream takes, `Text() << "at " << 1.5 << " mm"`. */
  class Text
  {
  public:
    template <typename Part>
    Text &
    operator<<(const Part &part)
    {
      stream << part;
      return *this;
    }
    operator std::string() const
    {
      return stream.str();
    }

  private:
    Classic<std::ostringstream> stream;
  };
} // namespace Debond
