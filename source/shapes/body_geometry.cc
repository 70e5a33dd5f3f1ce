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
  const BodyGeometry &
  pin_geometry();
  const BodyGeometry &
  sleeve_geometry();
  const BodyGeometry &
  taper_geometry();
  const BodyGeometry &
  screw_geometry();
  const BodyGeometry &
  cup_geometry();
  const BodyGeometry &
  cavity_geometry();
  const BodyGeometry &
  ring_geometry();

  const std::vector<const BodyGeometry *> &
  body_geometries()
  {
    static const std::vector<const BodyGeometry *> all{&coin_geometry(),
                                                       &cap_geometry(),
                                                       &block_geometry(),
                                                       &mesh_geometry(),
                                                       &pin_geometry(),
                                                       &sleeve_geometry(),
                                                       &taper_geometry(),
                                                       &screw_geometry(),
                                                       &cup_geometry(),
                                                       &cavity_geometry(),
                                                       &ring_geometry()};
    return all;
  }



  double
  BodyGeometry::reach(const BodyParameters &body) const
  {
    return std::hypot(0.5 * width(body, 0), 0.5 * width(body, 1));
  }



  std::array<Eigen::Vector2d, 2>
  BodyGeometry::box_of_face(const BodyParameters &body) const
  {
    const Eigen::Vector2d half(0.5 * width(body, 0), 0.5 * width(body, 1));
    return {{-half, half}};
  }



  bool
  BodyGeometry::has_face_at(const BodyParameters  &body,
                            const Eigen::Vector2d &place) const
  {
    return !is_round() || place.norm() <= box_of_face(body)[1][0];
  }



  std::shared_ptr<const BodyMesh>
  BodyGeometry::make_mesh(const BodyParameters &,
                          const BodyParameters &,
                          const std::string &) const
  {
    return nullptr;
  }
} // namespace Debond
