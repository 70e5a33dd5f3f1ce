#include <debond/input/expression_parser.h>
#include <debond/input/time_function.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <cmath>
#include <memory>

namespace Debond
{
  TimeFunction::TimeFunction(const TimeExpression &expression,
                             const double          radius)
    : name(expression.function ? "the function of time" :
                                 "the expression '" + expression.text + "'")
    , function(expression.function)
  {
    if (function)
      return;
    // a FunctionParser cannot be copied, but what refers to it can
    const std::shared_ptr<const dealii::FunctionParser<1>> parser =
      make_parser<1>("t", expression.text, radius);
    function = [parser](const double t) {
      return parser->value(dealii::Point<1>(t));
    };
  }



  double
  TimeFunction::operator()(const double t) const
  {
    const double value = function(t);
    if (!std::isfinite(value))
      throw InputError(name + " has no finite value at t = " + to_text(t));
    return value;
  }
} // namespace Debond
