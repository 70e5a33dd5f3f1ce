// Random numbers for bonding patterns: the same on every machine, without
// favour, and a field with the correlation it is said to have.

#include <debond/interface/bonding_source.h>

#include "checks.h"

using namespace Debond;

// An implementation of the Mersenne twister written separately gives these.
void
check_order()
{
  report("order of ten from seed 1",
         random_order(10, 1) ==
           std::vector<unsigned int>{1, 7, 3, 9, 4, 0, 5, 2, 6, 8});
  report("order of ten from seed 2",
         random_order(10, 2) ==
           std::vector<unsigned int>{9, 4, 6, 1, 7, 0, 2, 5, 3, 8});
  const auto                      order = random_order(400, 7);
  const std::vector<unsigned int> begin(order.begin(), order.begin() + 8);
  report("beginning of an order of 400 from seed 7",
         begin ==
           std::vector<unsigned int>{386, 236, 305, 113, 104, 189, 51, 264});
}



// Each of five numbers is at each place in a fifth of the orders: five standard
// deviations of a binomial distribution.
void
check_fairness()
{
  const unsigned int        n = 5, samples = 20000;
  std::vector<unsigned int> counts(n * n);
  for (unsigned int seed = 0; seed < samples; ++seed)
    {
      const auto order = random_order(n, seed);
      for (unsigned int i = 0; i < n; ++i)
        ++counts[n * i + order[i]];
    }
  double largest = 0.;
  for (const unsigned int count : counts)
    grow(largest, std::abs(count / double(samples) - 1. / n));
  report("deviation of the frequency of a number at a place",
         largest,
         5. * std::sqrt(0.2 * 0.8 / samples));
}



// Means over many fields, within five standard deviations of the mean of that
// many independent products of two normal variables.
void
check_correlation()
{
  const double       l       = 0.7;
  const unsigned int samples = 4000;
  for (const double ratio : {0., 0.5, 1., 2.})
    for (const Eigen::Vector3d &direction :
         {Eigen::Vector3d(0.6, 0.8, 0), Eigen::Vector3d(0.48, 0.36, 0.8)})
      {
        const Eigen::Vector3d place(0.3, -1.1, 0.4);
        double                sum = 0., product = 0.;
        for (unsigned int seed = 0; seed < samples; ++seed)
          {
            const RandomField field(seed, l);
            const double      here  = field(place);
            const double      there = field(place + ratio * l * direction);
            sum += here;
            product += here * there;
          }
        const double expected = std::exp(-ratio * ratio);
        report("mean of the field, deviation",
               std::abs(sum / samples),
               5. / std::sqrt(samples));
        report("correlation, deviation",
               std::abs(product / samples - expected),
               5. * std::sqrt((1. + expected * expected) / samples));
      }
}



int
main()
{
  check_order();
  check_fairness();
  check_correlation();
}
