#include <debond/shapes/body_geometry.h>

#include <cmath>

namespace Debond
{
  // Each shape's own file defines it; it is named here, and nowhere else.
  const BodyGeometry &
  coin_geometry();
  const BodyGeometry &
  cap_geometry();
  const BodyGeometry &
  block_geometry();
  const BodyGeometry &
  mesh_geometry();

  const std::vector<const BodyGeometry *> &
  body_geometries()
  {
    static const std::vector<const BodyGeometry *> all{&coin_geometry(),
                                                       &cap_geometry(),
                                                       &block_geometry(),
                                                       &mesh_geometry()};
    return all;
  }



  double
  BodyGeometry::reach(const BodyParameters &body) const
  {
    return std::hypot(0.5 * width(body, 0), 0.5 * width(body, 1));
  }

} // namespace Debond
