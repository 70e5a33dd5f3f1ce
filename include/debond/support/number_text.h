#ifndef debond_support_number_text_h
#define debond_support_number_text_h

#include <charconv>
#include <cmath>
#include <sstream>
#include <string>

namespace Debond
{
  /** A number with so many significant digits at most; 17 give it back
   *  exactly. */
  inline std::string
  to_text(const double number, const int digits = 12)
  {
    std::ostringstream text;
    text.precision(digits);
    text << number;
    return text.str();
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
} // namespace Debond
#endif
