// Stands in for libFuzzer where the fuzz targets are tests: calls the target
// named by the first argument with each of the files named by the others, once.
// All targets are in one program, which is compiled in a quarter of the time.

#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>

#define LLVMFuzzerTestOneInput fuzz_scene
#include "fuzz_scene.cc"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_csv
#include "fuzz_csv.cc"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_image
#include "fuzz_image.cc"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput fuzz_expression
#include "fuzz_expression.cc"

int
main(int argc, char *argv[])
{
  const std::map<std::string,
                 std::function<int(const std::uint8_t *, std::size_t)>>
    targets{{"scene", fuzz_scene},
            {"csv", fuzz_csv},
            {"image", fuzz_image},
            {"expression", fuzz_expression}};
  if (argc < 3)
    return 1;
  LLVMFuzzerInitialize(&argc, &argv);
  for (int i = 2; i < argc; ++i)
    {
      std::cout << argv[i] << std::endl;
      std::ostringstream bytes;
      bytes << std::ifstream(argv[i], std::ios::binary).rdbuf();
      const std::string text = bytes.str();
      targets.at(argv[1])(reinterpret_cast<const std::uint8_t *>(text.data()),
                          text.size());
    }
  std::cout << argc - 2 << " inputs were read or refused\n";
  return 0;
}
