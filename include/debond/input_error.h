#ifndef debond_input_error_h
#define debond_input_error_h

#include <stdexcept>

namespace Debond
{
  /** Anything wrong with what the user gave: the message is complete and is
   *  printed as it is. */
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace Debond
#endif
