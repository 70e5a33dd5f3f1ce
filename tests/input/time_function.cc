// Expressions in t know pi and R; those without a value are refused.

#include <debond/input/expression_parser.h>
#include <debond/support/input_error.h>

#include <iostream>

namespace
{
  void
  show(const std::string &expression, const double t)
  {
    try
      {
        const auto function = Debond::read_time_function(expression, 2.5);
        std::cout << expression << " at " << t << ": " << function(t) << '\n';
      }
    catch (const Debond::InputError &error)
      {
        std::cout << error.what() << '\n';
      }
  }
} // namespace



int
main()
{
  std::cout.precision(12);
  show("-0.0049 * min(t, 1)", 0.5);
  show("10 * max(t - 1, 0)", 1.25);
  show("R * sin(pi * t / 2)", 1);
  show("if(t < 1, 0, 3)", 2);
  show("1 / t", 0);
  show("2 * (t", 0);
  show("speed * t", 0);
  show("1,5 * t", 0);
  show("t; t", 0);
}
