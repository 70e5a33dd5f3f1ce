#include <debond/output/vtu_patches.h>

namespace Debond
{
  unsigned int
  n_pieces(const NurbsSurface &surface,
           const unsigned int  pieces,
           const unsigned int  least,
           const unsigned int  most)
  {
    const auto         n      = surface.n_elements_per_direction();
    const unsigned int fewest = std::min(n[0], n[1]);
    return std::clamp((pieces + fewest - 1) / fewest, least, most);
  }



  Eigen::Vector2d
  between(const std::array<Eigen::Vector2d, 2> &bounds,
          const double                          s,
          const double                          t)
  {
    return {(1. - s) * bounds[0][0] + s * bounds[1][0],
            (1. - t) * bounds[0][1] + t * bounds[1][1]};
  }



  std::array<double, 4>
  bilinear(const double s, const double t)
  {
    return {{(1. - s) * (1. - t), s * (1. - t), (1. - s) * t, s * t}};
  }
} // namespace Debond
