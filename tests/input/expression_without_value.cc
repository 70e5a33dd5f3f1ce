// What an expression is where a part of it has no value, or one that is too
// large: compared with what is written down beside it, from the rules in
// doc/reference/scene_file.md. Each of them once passed for a number, or is
// next to one that did.

#include <debond/input/expression_parser.h>
#include <debond/support/input_error.h>

#include <cmath>
#include <iostream>

using namespace Debond;

namespace
{
  unsigned int n_right = 0;

  void
  expect(const double right, const std::string &expression, const double x = -1)
  {
    const double value = read_expression("x", expression, 2.5)({x});
    if (std::abs(value - right) <= 1e-15 * std::abs(right) ||
        (std::isnan(right) && std::isnan(value)))
      ++n_right;
    else
      std::cout << expression << " at x = " << x << " is " << value << ", not "
                << right << '\n';
  }
} // namespace



int
main()
{
  const double none = std::nan("");

  // comparisons, min and max, in either order of arguments
  for (const char *const expression : {"min(20000, max(10, x^0.5))",
                                       "min(20000, max(x^0.5, 10))",
                                       "max(sqrt(x), 1)",
                                       "max(1, 2, ln(x), 3)",
                                       "min(3, 2, log10(x))",
                                       "min(1, acos(2 * x))",
                                       "x^0.5 < 1",
                                       "x^0.5 <= 1",
                                       "x^0.5 > 1",
                                       "x^0.5 >= 1",
                                       "x^0.5 == 1",
                                       "x^0.5 != 1",
                                       "1 < x^0.5",
                                       "1 == x^0.5",
                                       "1 != x^0.5",
                                       "sum(1, sqrt(x))",
                                       "avg(1, sqrt(x))"})
    expect(none, expression);

  // functions that made a number of it
  for (const char *const expression : {"sign(x^0.5)",
                                       "rint(x^0.5)",
                                       "(x^0.5)^0",
                                       "1^(x^0.5)",
                                       "pow(x^0.5, 0)",
                                       "pow(1, sqrt(x))",
                                       "abs(sqrt(x))",
                                       "floor(sqrt(x))",
                                       "ceil(sqrt(x))",
                                       "erf(sqrt(x))",
                                       "atan2(sqrt(x), 1)",
                                       "exp(-sqrt(x))",
                                       "-x^x^x^0.5"})
    expect(none, expression);

  // as conditions, and chosen
  for (const char *const expression : {"if(x^0.5, 1, 2)",
                                       "x^0.5 ? 1 : 2",
                                       "if(x^0.5 < 1, 1, 2)",
                                       "x^0.5 < 1 ? 1 : 2",
                                       "if(x < 0, x^0.5, 2)",
                                       "x < 0 ? x^0.5 : 2",
                                       "if(x > 0, 2, x^0.5)",
                                       "x^0.5 && 1",
                                       "x^0.5 && 0",
                                       "1 && x^0.5",
                                       "x > 0 && x^0.5 < 1",
                                       "x < 0 || x^0.5 < 1",
                                       "x^0.5 || 1",
                                       "0 || x^0.5",
                                       "x < 0 ? x > -2 ? x^0.5 : 1 : 2",
                                       "x > 0 ? 1 : x^0.5 ? 2 : 3",
                                       "2 * (x^0.5 ? 1 : 2)",
                                       "max(1, x^0.5 ? 1 : 2)"})
    expect(none, expression);

  // not chosen
  expect(7, "if(x > 0, x^0.5, 7)");
  expect(7, "if(x < 0, 7, x^0.5)");
  expect(7, "x > 0 ? x^0.5 : 7");
  expect(7, "x < 0 ? 7 : x^0.5");
  expect(7, "if(x > 0, x^0.5 ? 1 : 2, 7)");
  expect(7, "x > 0 ? (x^0.5 < 1 ? 1 : 2) : 7");
  expect(7, "if(x > 0, min(1, x^0.5), 7)");
  expect(3, "if(x > 0, x^0.5, 7)", 9);
  expect(3, "x > 0 ? x^0.5 : 7", 9);

  // poles have no value; what is too large compares as it should
  for (const char *const expression : {"min(1, 1 / x)",
                                       "1 / x > 3",
                                       "atan(1 / x)",
                                       "max(10, ln(x))",
                                       "max(10, log(x))",
                                       "max(10, log2(x))",
                                       "max(10, log10(x))",
                                       "min(1, x^-1)",
                                       "min(1, pow(x, -0.5))",
                                       "1 / (1 + 1 / x)",
                                       "0 * (1 / x)",
                                       "min(1, cot(x))",
                                       "min(1, csc(x))",
                                       "min(1, atanh(x + 1))",
                                       "exp(-1 / x^2)",
                                       "x / x"})
    {
      expect(none, expression, 0.);
      expect(none, expression, -0.);
    }
  expect(7, "if(x > 0, min(1, 1 / x), 7)", 0.);
  expect(20000, "min(20000, exp(1000 * x))", 1);
  expect(0, "1 / (1 + exp(1000 * x))", 1);
  expect(1, "1 / (1 + exp(-1000 * x))", 1);
  expect(1, "exp(1000 * x) > 5", 1);
  expect(1, "tanh(exp(1000 * x))", 1);
  expect(none, "exp(1000 * x) - exp(1000 * x)", 1);
  expect(1, "min(1, (-exp(1000 * x))^2)", 1);

  // what is not 0 is true
  expect(5, "if(0.4, 5, 6)");
  expect(5, "0.4 ? 5 : 6");
  expect(5, "if(x, 5, 6)");
  expect(6, "if(x, 5, 6)", 0.);
  expect(6, "if(x, 5, 6)", -0.);
  expect(1, "0.4 && 0.3");
  expect(1, "0 || -0.3");
  expect(1, "1 == 1 == 1");
  expect(0, "3 > 2 > 1");

  // whole numbers
  for (const double i : {-3., -2., 0., 1., 4., 9007199254740992.})
    {
      expect(i, "rint(x)", i);
      expect(i, "floor(x)", i);
      expect(i, "ceil(x)", i);
    }
  expect(3, "rint(2.5)");
  expect(-2, "rint(-2.5)");
  expect(-3, "floor(-2.5)");
  expect(-2, "ceil(-2.5)");
  expect(-1, "sign(-0.1)");
  expect(0, "sign(0)");

  // precedence
  expect(-4, "-2^2");
  expect(0.5, "2^-1");
  expect(512, "2^3^2");
  expect(2, "12 / 3 / 2");
  expect(-6, "2 * -3");
  expect(7, "1 + 2 * 3");
  expect(1, "1 || 0 && 0");
  expect(0, "2 > 1 && 3 < 2");
  expect(1, "1 + 1 == 2");
  expect(4, "1 ? 4 : 3 + 10");
  expect(14, "(1 ? 4 : 3) + 10");
  expect(5, "0 ? 2 : 0 ? 4 : 5");
  expect(2, "1 ? 1 ? 2 : 3 : 4");
  expect(9, "max(0 ? 1 : 9, 1 ? 2 : 3)");
  expect(8, "if(0 ? 1 : 0, 7, x < 0 ? 8 : 9)");

  // of many arguments, and of one
  expect(1, "min(3, 1, 2)");
  expect(3, "max(1, 3, 2)");
  expect(6, "sum(1, 2, 3)");
  expect(2, "avg(1, 2, 3)");
  expect(-1, "min(x)");
  expect(std::log(10.), "log(10)");
  expect(1., "log10(10)");
  expect(1 / std::tan(-1.), "cot(x)");
  expect(1 / std::sin(-1.), "csc(x)");
  expect(1 / std::cos(-1.), "sec(x)");
  std::cout << n_right << " are right\n";
}
