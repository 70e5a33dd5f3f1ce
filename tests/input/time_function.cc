// Expressions in t know pi and R. What is refused:
// tests/bad_scenes/expressions.scenes.

#include <debond/input/expression_parser.h>

#include <iostream>

namespace
{
  void
  show(const std::string &expression, const double t)
  {
    const auto function = Debond::read_time_function(expression, 2.5);
    std::cout << expression << " at " << t << ": " << function(t) << '\n';
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
}
