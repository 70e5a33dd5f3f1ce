#include <debond/support/processor.h>

#include <unistd.h>

// made by CMake: DEBOND_INSTRUCTIONS(X) is X("avx") X("avx2") ...
#include <debond_instructions.h>

// This file alone is compiled for every processor of the architecture. It calls
// no inline function of a header: the linker keeps one copy of those, which may
// be one that was compiled for this processor.
namespace Debond
{
  namespace
  {
    void
    say(const char *const text)
    {
      [[maybe_unused]] const ssize_t ignored =
        write(STDERR_FILENO, text, __builtin_strlen(text));
    }
  } // namespace



  void
  require_instructions()
  {
    bool lacks = false;
#define DEBOND_REQUIRE(name)                                              \
  if (!__builtin_cpu_supports(name))                                      \
    {                                                                     \
      say(lacks ?                                                         \
            ", " name :                                                   \
            "debond: this program was built for a processor with " name); \
      lacks = true;                                                       \
    }
#ifdef __x86_64__
    __builtin_cpu_init();
#endif
    DEBOND_INSTRUCTIONS(DEBOND_REQUIRE)
    if (!lacks)
      return;
    say(", which this one lacks; build it anew here with "
        "`cmake --preset release && cmake --build --preset release`, or use "
        "the preset `package`, whose program runs on any x86-64\n");
    _exit(1);
  }
} // namespace Debond
