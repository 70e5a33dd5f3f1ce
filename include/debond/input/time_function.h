#ifndef debond_input_time_function_h
#define debond_input_time_function_h

#include <memory>
#include <string>

namespace dealii
{
  template <int dim>
  class FunctionParser;
}

namespace Debond
{
  /** A function of time given by an expression in `t` with the constants `pi`
   *  and `R` (muParser syntax, as in deal.II's FunctionParser). */
  class TimeFunction
  {
  public:
    /** @p radius is the value of `R` [mm]. Throws InputError with the
     *  expression and the parser's own words if the expression is invalid. */
    TimeFunction(const std::string &expression, const double radius);
    ~TimeFunction();
    TimeFunction(TimeFunction &&) noexcept;
    TimeFunction &
    operator=(TimeFunction &&) noexcept;

    /** The value at time @p t, in the unit that the expression is written in.
     *  Throws InputError if it is not finite. */
    double
    operator()(const double t) const;

  private:
    std::unique_ptr<dealii::FunctionParser<1>> parser;
  };
} // namespace Debond
#endif
