#ifndef debond_input_time_function_h
#define debond_input_time_function_h

#include <functional>
#include <string>
#include <type_traits>

namespace Debond
{
  /** How a function of time is given: by an expression in `t` with the
   * constants `pi` and `R` (muParser syntax, as in deal.II's FunctionParser),
   * by a constant, or by anything that can be called with a time. */
  struct TimeExpression
  {
    template <typename Source,
              typename = std::enable_if_t<
                !std::is_same_v<std::decay_t<Source>, TimeExpression>>>
    TimeExpression(const Source &source)
    {
      if constexpr (std::is_arithmetic_v<Source>)
        function = [value = double(source)](double) { return value; };
      else if constexpr (std::is_convertible_v<Source, std::string>)
        text = source;
      else
        function = source;
    }

    std::string                   text;     ///< the expression, or empty
    std::function<double(double)> function; ///< without an expression
  };



  /** A function of time. */
  class TimeFunction
  {
  public:
    /** @p radius is the value of `R` [mm]. Throws InputError with the
     *  expression and the parser's own words if the expression is invalid. */
    TimeFunction(const TimeExpression &expression, const double radius);

    /** The value at time @p t, in the unit that the expression is written in.
     *  Throws InputError if it is not finite. */
    double
    operator()(const double t) const;

  private:
    std::string                   name; ///< for messages
    std::function<double(double)> function;
  };
} // namespace Debond
#endif
