#include <debond/input/expression_parser.h>
#include <debond/input/time_function.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <cmath>

namespace Debond
{
  TimeFunction::TimeFunction(const std::string &expression, const double radius)
    : parser(make_parser<1>("t", expression, radius))
  {}



  TimeFunction::~TimeFunction()                        = default;
  TimeFunction::TimeFunction(TimeFunction &&) noexcept = default;
  TimeFunction &
  TimeFunction::operator=(TimeFunction &&) noexcept = default;



  double
  TimeFunction::operator()(const double t) const
  {
    const double value = parser->value(dealii::Point<1>(t));
    if (!std::isfinite(value))
      throw InputError("it has no finite value at t = " + to_text(t));
    return value;
  }
} // namespace Debond
