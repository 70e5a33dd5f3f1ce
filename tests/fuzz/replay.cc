// Stands in for libFuzzer where the fuzz targets are tests: calls the target
// with each of the files named on the command line, once.

#include <fstream>
#include <iostream>
#include <sstream>

#include "fuzz_target.h"

int
main(int argc, char *argv[])
{
  LLVMFuzzerInitialize(&argc, &argv);
  for (int i = 1; i < argc; ++i)
    {
      std::cout << argv[i] << std::endl;
      std::ostringstream bytes;
      bytes << std::ifstream(argv[i], std::ios::binary).rdbuf();
      const std::string text = bytes.str();
      LLVMFuzzerTestOneInput(
        reinterpret_cast<const std::uint8_t *>(text.data()), text.size());
    }
  std::cout << argc - 1 << " inputs were read or refused\n";
  return argc > 1 ? 0 : 1;
}
