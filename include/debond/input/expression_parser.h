#ifndef debond_input_expression_parser_h
#define debond_input_expression_parser_h

#include <functional>
#include <initializer_list>
#include <string>

namespace Debond
{
  /** The value of an expression for values of its variables, in their order.
   *  Not to be called by several threads at a time; copies share a parser. */
  using Expression =
    std::function<double(const std::initializer_list<double> &)>;

  /**
   * Reads an expression in muParser's language, with the functions that
   * deal.II's FunctionParser adds to it but random numbers, in @p variables,
   * names separated by commas. Constants are `pi` and `R` = @p radius [mm].
   * Throws InputError with the expression and the parser's own words if it is
   * invalid.
   */
  Expression
  read_expression(const std::string &variables,
                  const std::string &expression,
                  double             radius);

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
