#pragma once

#include <debond/support/input_error.h>
#include <debond/support/runtime.h>

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

/** What libFuzzer calls with each input. */
extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

/** What libFuzzer calls once, before the first input. */
extern "C" __attribute__((used)) inline int
LLVMFuzzerInitialize(int *, char ***)
{
  Debond::set_up_libraries();
  return 0;
}

/** Anything but a result or an InputError is a finding: other exceptions are
 *  let through, and a message that is empty is no message. */
template <typename Reader>
void
must_read_or_refuse(const Reader &reader)
{
  try
    {
      reader();
    }
  catch (const Debond::InputError &error)
    {
      if (error.what()[0] == '\0')
        std::abort();
    }
}

/** A file in memory that holds these bytes as long as this object lives. */
class FileInMemory
{
public:
  explicit FileInMemory(const std::string &bytes)
    : descriptor(memfd_create("input", 0))
  {
    if (descriptor < 0 || write(descriptor, bytes.data(), bytes.size()) !=
                            static_cast<ssize_t>(bytes.size()))
      std::abort();
  }
  FileInMemory(const FileInMemory &) = delete;
  FileInMemory &
  operator=(const FileInMemory &) = delete;
  ~FileInMemory()
  {
    close(descriptor);
  }

  std::string
  name() const
  {
    return "/proc/self/fd/" + std::to_string(descriptor);
  }

private:
  const int descriptor;
};
