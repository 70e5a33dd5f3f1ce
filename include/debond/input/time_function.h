#ifndef debond_input_time_function_h
#define debond_input_time_function_h

#include <debond/input/expression_parser.h>

namespace Debond
{
  /** A function of time given by an expression in `t`, see read_expression().
   */
  class TimeFunction
  {
  public:
    /** @p radius is the value of `R` [mm]. Throws InputError with the
     *  expression and the parser's own words if the expression is invalid. */
    TimeFunction(const std::string &expression, double radius);

    /** The value at time @p t, in the unit that the expression is written in.
     *  Throws InputError if it is not finite. */
    double
    operator()(double t) const;

  private:
    std::string text;
    Expression  expression;
  };
} // namespace Debond
#endif
