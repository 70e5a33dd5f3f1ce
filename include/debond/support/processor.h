#pragma once

namespace Debond
{
  /** Ends the program with one line on stderr and exit code 1 if the processor
   *  lacks instructions that the library was compiled for, which would end it
   *  without a word. Needs nothing of the C++ library, so that it may be called
   *  before anything else (main.cc). */
  void
  require_instructions();
} // namespace Debond
