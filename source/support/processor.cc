#include <debond/support/processor.h>

#include <unistd.h>

// made by CMake: DEBOND_INSTRUCTIONS(X) is X("avx") X("avx2") ...
#include <debond_instructions.h>

#include <cstddef>

// This file alone is compiled for every processor of the architecture. It calls
// no inline function of a header: the linker keeps one copy of those, which may
// be one that was compiled for this processor.
namespace Debond
{
  namespace
  {
    struct Line
    {
      char        text[1024];
      std::size_t length;
    };



    void
    append(Line &line, const char *text)
    {
      while (*text != 0 && line.length < sizeof(line.text))
        line.text[line.length++] = *text++;
    }
  } // namespace



  void
  require_instructions()
  {
    Line line;
    line.length = 0;
    append(line, "debond: this program was built for a processor with");
    const std::size_t length = line.length;
#define DEBOND_REQUIRE(name)         \
  if (!__builtin_cpu_supports(name)) \
    append(line, length == line.length ? " " name : ", " name);
#ifdef __x86_64__
    __builtin_cpu_init();
#endif
    DEBOND_INSTRUCTIONS(DEBOND_REQUIRE)
    if (line.length == length)
      return;
    append(line,
           ", which this one lacks; build it anew here with "
           "`cmake --preset release && cmake --build --preset release`, or use "
           "the preset `package`, whose program runs on any x86-64\n");
    const ssize_t ignored = write(STDERR_FILENO, line.text, line.length);
    static_cast<void>(ignored);
    _exit(1);
  }
} // namespace Debond
