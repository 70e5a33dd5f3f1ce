#ifndef debond_support_number_text_h
#define debond_support_number_text_h

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
} // namespace Debond
#endif
