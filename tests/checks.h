#pragma once

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>
#include <string>

/** One line of output that is the same on all machines as long as @p deviation
 *  is below @p limit; the value itself appears only if it is not, and in the
 *  file DEBOND_TEST_NUMBERS, which spread.py reads. */
inline void
report(const std::string &what, const double deviation, const double limit)
{
  if (const char *const file = std::getenv("DEBOND_TEST_NUMBERS"))
    std::ofstream(file, std::ios::app)
      << deviation << ",-inf," << limit << "," << what << std::endl;
  std::cout << what << " below " << limit << ": ";
  if (deviation < limit) // false for NaN as well
    std::cout << "yes" << std::endl;
  else
    std::cout << "NO, " << deviation << std::endl;
}



inline void
report(const std::string &what, const bool is_true)
{
  std::cout << what << ": " << (is_true ? "yes" : "NO") << std::endl;
}



/** Maximum that does not lose a NaN. */
inline void
grow(double &maximum, const double value)
{
  if (!std::isnan(maximum) && !(value <= maximum))
    maximum = value;
}



/** Numbers that are the same on all machines. */
inline double
random_number(const double from, const double to)
{
  static std::mt19937 generator;
  return from + (to - from) * (generator() / 4294967295.);
}
