#include <debond/shapes/body_geometry.h>

#include <cmath>

namespace Debond
{
  BodyGeometry
  BodyGeometry::round(const double radius, const double height)
  {
    BodyGeometry result;
    result.width        = {{2. * radius, 2. * radius}};
    result.reach        = radius;
    result.thickness    = height;
    result.chuck_height = height;
    result.is_round     = true;
    return result;
  }



  Eigen::Vector3d
  BodyGeometry::outwards(const Eigen::Vector3d &X) const
  {
    if (centre_of_sphere)
      return (X - Eigen::Vector3d(0., 0., *centre_of_sphere)) / radius;
    return Eigen::Vector3d(X[0], X[1], 0.) / side(X[2], std::atan2(X[1], X[0]));
  }



  // On a sphere as far from the middle as along it from its lowest point.
  Eigen::Vector2d
  BodyGeometry::on_face(const Eigen::Vector3d &X) const
  {
    if (side)
      return {radius * std::atan2(X[1], X[0]), X[2]};
    const double across = std::hypot(X[0], X[1]);
    if (!centre_of_sphere || across == 0.)
      return X.head<2>();
    return radius * std::atan2(across, *centre_of_sphere - X[2]) / across *
           X.head<2>();
  }



  std::array<Eigen::Vector2d, 2>
  BodyGeometry::box_of_face() const
  {
    if (side)
      return {{{-M_PI * radius, -thickness}, {M_PI * radius, 0.}}};
    const Eigen::Vector2d half =
      centre_of_sphere ? Eigen::Vector2d::Constant(
                           radius * std::acos(*centre_of_sphere / radius)) :
                         Eigen::Vector2d(0.5 * width[0], 0.5 * width[1]);
    return {{-half, half}};
  }



  bool
  BodyGeometry::has_face_at(const Eigen::Vector2d &place) const
  {
    return !is_round || place.cwiseQuotient(box_of_face()[1]).norm() <= 1.;
  }



  const std::vector<ShapeRow> &
  shape_rows()
  {
    static const auto all = []() {
      std::vector<ShapeRow> result;
      for (const auto &group :
           {lattice_shapes(), file_shapes(), revolved_shapes(), bowl_shapes()})
        result.insert(result.end(), group.begin(), group.end());
      return result;
    }();
    return all;
  }
} // namespace Debond
