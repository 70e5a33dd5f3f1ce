#include <debond/input/time_function.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <cmath>

namespace Debond
{
  TimeFunction::TimeFunction(const std::string &expression, const double radius)
    : text(expression)
    , expression(read_expression("t", text, radius))
  {}



  double
  TimeFunction::operator()(const double t) const
  {
    const double value = expression({t});
    if (!std::isfinite(value))
      throw InputError("the expression '" + text +
                       "' has no finite value at t = " + to_text(t));
    return value;
  }
} // namespace Debond
