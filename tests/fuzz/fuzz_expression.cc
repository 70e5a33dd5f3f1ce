// Fuzz target: expressions in time and in place, read and evaluated.

#include <debond/input/expression_parser.h>

#include "fuzz_target.h"

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  const std::string expression(reinterpret_cast<const char *>(data), size);
  must_read_or_refuse([&expression]() {
    const auto value = Debond::read_time_function(expression, 2.5);
    for (const double t : {0., 0.5, 1., 2.})
      value(t);
  });
  must_read_or_refuse([&expression]() {
    Debond::read_expression("x,y,r,angle", expression, 2.5)(
      {0.3, -0.4, 0.5, -53.});
  });
  return 0;
}
