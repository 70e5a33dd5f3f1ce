#ifndef debond_interface_random_field_h
#define debond_interface_random_field_h

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace Debond
{
  /** The numbers 0 ... n-1 in random order, every order equally likely. */
  std::vector<unsigned int>
  random_order(unsigned int n, std::uint64_t seed);

  /**
   * A smooth random function of the place: nearly Gaussian, with mean 0,
   * variance 1 and the correlation exp(-(d/l)^2) between places at the distance
   * d. A sum of plane waves with random directions, lengths and phases, so that
   * it does not depend on any mesh.
   */
  class RandomField
  {
  public:
    /** @p correlation_length: l > 0 [mm]. */
    RandomField(std::uint64_t seed, double correlation_length);

    /** The value at @p place [mm]. */
    double
    operator()(const Eigen::Vector2d &place) const;

  private:
    struct Wave
    {
      Eigen::Vector2d k;     ///< wave vector [1/mm]
      double          phase; ///< [rad]
    };
    std::vector<Wave> waves;
  };
} // namespace Debond
#endif
