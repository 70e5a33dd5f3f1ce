#ifndef debond_support_run_error_h
#define debond_support_run_error_h

#include <stdexcept>

namespace Debond
{
  /** A run that could not be finished; the message says where and why. */
  class RunError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** A file of results that could not be written: a full disk, a directory that
   *  is not ours to write to. The message names the file and says what the
   *  system says. */
  class WriteError : public RunError
  {
  public:
    using RunError::RunError;
  };
} // namespace Debond
#endif
