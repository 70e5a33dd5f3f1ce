#include <debond/geometry/surface_geometry.h>
#include <debond/geometry/surface_quadrature.h>

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Geometry>

namespace Debond
{
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
        surface.evaluate_in_element(element, point.xi, point.basis, false);
        SurfaceGeometry geometry;
        contract(point.basis, surface.control_points(), false, geometry);
        point.X   = geometry.y;
        point.JxW = geometry.a1.cross(geometry.a2).norm() * size.prod() *
                    quadrature.weight(q);
      }
    return points;
  }



  std::vector<SurfaceQuadraturePoint>
  surface_quadrature(const NurbsSurface &surface, const unsigned int n)
  {
    const dealii::QGauss<2>             gauss(n);
    std::vector<SurfaceQuadraturePoint> points;
    points.reserve(surface.n_elements() * gauss.size());
    for (unsigned int element = 0; element < surface.n_elements(); ++element)
      for (const auto &point : element_quadrature(surface, element, gauss))
        points.push_back(point);
    return points;
  }
} // namespace Debond
