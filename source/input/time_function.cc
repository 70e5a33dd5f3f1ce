#include <debond/input/expression_parser.h>
#include <debond/input/time_function.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <cmath>

namespace Debond
{
  TimeFunction::TimeFunction(const std::string &expression, const double radius)
    : function([parsed = read_expression("t", expression, radius)](
                 const double t) { return parsed({t}); })
  {}



  double
  TimeFunction::operator()(const double t) const
  {
    const double value = function(t);
    if (!std::isfinite(value))
      throw InputError("it has no finite value at t = " + to_text(t));
    return value;
  }
} // namespace Debond
