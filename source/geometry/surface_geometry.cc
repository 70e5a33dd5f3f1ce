#include <debond/geometry/surface_geometry.h>

#include <Eigen/Geometry>

namespace Debond
{
  void
  spread(const SurfaceBasis    &basis,
         const Eigen::Vector3d &value,
         ControlNet            &control_points)
  {
    for (unsigned int a = 0; a < basis.size; ++a)
      control_points.col(basis.control_point[a]) += basis.N[a] * value;
  }



  std::vector<SurfaceQuadraturePoint>
  element_quadrature(const NurbsSurface          &surface,
                     const unsigned int           element,
                     const dealii::Quadrature<2> &quadrature)
  {
    const auto            bounds = surface.element_bounds(element);
    const Eigen::Vector2d size   = bounds[1] - bounds[0];
    std::vector<SurfaceQuadraturePoint> points(quadrature.size());
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      {
        SurfaceQuadraturePoint &point = points[q];
        point.element                 = element;
        point.xi                      = bounds[0] +
                   size.cwiseProduct(Eigen::Vector2d(quadrature.point(q)[0],
                                                     quadrature.point(q)[1]));
        surface.evaluate_in_element(element, point.xi, point.basis);
        SurfaceGeometry geometry;
        contract(point.basis, surface.control_points(), geometry);
        point.X   = geometry.y;
        point.JxW = geometry.a1.cross(geometry.a2).norm() * size.prod() *
                    quadrature.weight(q);
      }
    return points;
  }



  std::vector<SurfaceQuadraturePoint>
  surface_quadrature(const NurbsSurface          &surface,
                     const dealii::Quadrature<1> &along)
  {
    const dealii::Quadrature<2>         both(along);
    std::vector<SurfaceQuadraturePoint> points;
    points.reserve(surface.n_elements() * both.size());
    for (unsigned int element = 0; element < surface.n_elements(); ++element)
      for (const auto &point : element_quadrature(surface, element, both))
        points.push_back(point);
    return points;
  }
} // namespace Debond
