#ifndef debond_support_input_error_h
#define debond_support_input_error_h

#include <stdexcept>
#include <string>

namespace Debond
{
  /** Anything wrong with what the user gave: the message is complete and is
   *  printed as it is. */
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** What a user has written as it is shown in messages: the end of a very long
   *  text is left out. */
  inline std::string
  shortened(const std::string &text)
  {
    constexpr std::size_t longest = 300;
    return text.size() <= longest ? text : text.substr(0, longest) + "...";
  }
} // namespace Debond
#endif
