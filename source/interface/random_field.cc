#include <debond/interface/random_field.h>

#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace Debond
{
  namespace
  {
    /** Random numbers that are the same everywhere: the C++ standard fixes the
     *  generator, but not its distributions. */
    class PortableRandom
    {
    public:
      explicit PortableRandom(const std::uint64_t seed)
        : generator(seed)
      {}

      /** Evenly distributed in (0, 1). */
      double
      uniform()
      {
        // the upper 53 bits, in the middle between two of their steps
        return (static_cast<double>(generator() >> 11) + 0.5) * 0x1p-53;
      }

      /** A whole number in [0, @p n), all equally likely. */
      std::uint64_t
      index(const std::uint64_t n)
      {
        // numbers above the last whole multiple of n would favour small ones
        const std::uint64_t limit = generator.max() - generator.max() % n;
        std::uint64_t       draw;
        do
          draw = generator();
        while (draw >= limit);
        return draw % n;
      }

    private:
      std::mt19937_64 generator;
    };
  } // namespace



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
