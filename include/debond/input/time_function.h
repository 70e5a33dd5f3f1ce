#ifndef debond_input_time_function_h
#define debond_input_time_function_h

#include <functional>
#include <string>

namespace Debond
{
  /** A function of time: an expression in `t`, see read_expression(), or any
   *  function. */
  class TimeFunction
  {
  public:
    /** @p radius is the value of `R` [mm]. Throws InputError with the
     *  expression and the parser's own words if the expression is invalid. */
    TimeFunction(const std::string &expression, double radius);
    explicit TimeFunction(const std::function<double(double)> &function)
      : function(function)
    {}

    /** The value at time @p t, in the unit that the expression is written in.
     *  Throws InputError if it is not finite. */
    double
    operator()(double t) const;

  private:
    std::function<double(double)> function;
  };
} // namespace Debond
#endif
