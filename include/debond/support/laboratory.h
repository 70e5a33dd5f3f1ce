#pragma once

#include <string>
#include <vector>

/** The part of debond that is written in Python, `python3 -m debond COMMAND`:
 *  fits, comparisons, tables of laboratories and pages of results. */
namespace Debond::Laboratory
{
  /** Becomes that command: this process is Python from then on, with its exit
   *  code. Throws InputError if Python cannot be started. */
  [[noreturn]] void
  become(const std::string &command, const std::vector<std::string> &words);

  /** Runs that command and waits for its end; returns its exit code, or 127
   *  if Python cannot be started. What it writes to its standard output goes
   *  to @p output, or where this process's goes. */
  int
  run(const std::string              &command,
      const std::vector<std::string> &words,
      std::string                    *output = nullptr);

  /** What is missing if Python cannot be started. */
  extern const char *const what_it_needs;
} // namespace Debond::Laboratory
