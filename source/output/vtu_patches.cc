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
} // namespace Debond
