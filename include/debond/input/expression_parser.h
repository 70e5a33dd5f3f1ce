#pragma once

#include <functional>
#include <string>
#include <vector>

namespace Debond
{
  /** The value of an expression for values of its variables, in their order.
   *  Not to be called by several threads at a time; copies share a parser. */
  using Expression = std::function<double(const std::vector<double> &)>;

  /**
   * Reads an expression in muParser's language, with the functions that
   * doc/reference/scene_file.md lists, in @p variables, names separated by
   * commas. Constants are `pi` and `R` = @p radius [mm]. Throws InputError with
   * the expression and the parser's own words if it is invalid.
   *
   * Its value is not a number where a part of it has none, unless `if` or
   * `a ? b : c` does not choose that part. Who asks for it says where that was,
   * and remark_on_no_value.
   */
  Expression
  read_expression(const std::string &variables,
                  const std::string &expression,
                  double             radius);

  /** What to do about it. */
  constexpr const char *remark_on_no_value =
    "; if(condition, a, b) leaves out what has none";

  /** A function of time. */
  using TimeFunction = std::function<double(double)>;

  /** That of an expression in `t`, see read_expression(), or @p given if there
   *  is one. It throws InputError where it has no finite value. */
  TimeFunction
  read_time_function(const std::string  &expression,
                     double              radius,
                     const TimeFunction &given = nullptr);
} // namespace Debond
