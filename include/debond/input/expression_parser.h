#ifndef debond_input_expression_parser_h
#define debond_input_expression_parser_h

#include <deal.II/base/function_parser.h>

#include <memory>
#include <string>

namespace Debond
{
  /**
   * A parser of an expression (muParser syntax, as in deal.II's FunctionParser)
   * in @p variables, names separated by commas: dim of them, or dim + 1, the
   * last of which deal.II calls the time. Constants are `pi` and `R` =
   * @p radius [mm]; random numbers are refused. Throws InputError with the
   * expression and the parser's own words if it is invalid.
   */
  template <int dim>
  std::unique_ptr<dealii::FunctionParser<dim>>
  make_parser(const std::string &variables,
              const std::string &expression,
              double             radius);
} // namespace Debond
#endif
