#include <debond/interface/random_field.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace Debond
{
  double
  PortableRandom::uniform()
  {
    // the upper 53 bits, in the middle between two of their steps
    return (static_cast<double>(generator() >> 11) + 0.5) * 0x1p-53;
  }



  std::uint64_t
  PortableRandom::index(const std::uint64_t n)
  {
    // numbers above the last whole multiple of n would favour small indices
    const std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t limit   = largest - largest % n;
    std::uint64_t       draw;
    do
      draw = generator();
    while (draw >= limit);
    return draw % n;
  }



  std::vector<unsigned int>
  random_order(const unsigned int n, const std::uint64_t seed)
  {
    std::vector<unsigned int> order(n);
    std::iota(order.begin(), order.end(), 0);
    PortableRandom random(seed);
    for (unsigned int i = n; i > 1; --i)
      std::swap(order[i - 1], order[random.index(i)]);
    return order;
  }



  RandomField::RandomField(const std::uint64_t seed,
                           const double        correlation_length)
    : waves(1000)
  {
    PortableRandom random(seed);
    for (Wave &wave : waves)
      {
        // normally distributed components of variance 2/l^2: the mean of
        // cos(k . d) over them is exp(-(d/l)^2)
        const double length =
          2. / correlation_length * std::sqrt(-std::log(random.uniform()));
        const double direction = 2. * M_PI * random.uniform();
        wave.k =
          length * Eigen::Vector2d(std::cos(direction), std::sin(direction));
        wave.phase = 2. * M_PI * random.uniform();
      }
  }



  double
  RandomField::operator()(const Eigen::Vector2d &place) const
  {
    double sum = 0.;
    for (const Wave &wave : waves)
      sum += std::cos(wave.k.dot(place) + wave.phase);
    return sum * std::sqrt(2. / waves.size());
  }
} // namespace Debond
