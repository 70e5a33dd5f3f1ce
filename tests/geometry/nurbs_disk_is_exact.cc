// The disk is exact: its edges are on the circle, its area is pi R^2 and its
// normal is +z, as one element and refined.

#include <debond/geometry/surface_geometry.h>

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

#include "checks.h"

using namespace Debond;

constexpr double R = 2.7;

double
deviation_of_edges(const NurbsSurface &disk)
{
  double result = 0;
  for (unsigned int i = 0; i <= 100; ++i)
    {
      const double t = i / 100.;
      for (const Eigen::Vector2d &xi : {Eigen::Vector2d(t, 0),
                                        Eigen::Vector2d(t, 1),
                                        Eigen::Vector2d(0, t),
                                        Eigen::Vector2d(1, t)})
        {
          const Eigen::Vector3d y       = disk.point(xi);
          const double          squared = y[0] * y[0] + y[1] * y[1];
          result                        = std::max(
            {result, std::abs(squared / (R * R) - 1.), std::abs(y[2]) / R});
        }
    }
  return result;
}



/** Both at the points of a Gauss rule in every element. */
void
check_area_and_normals(const NurbsSurface &disk)
{
  const dealii::QGauss<2> gauss(disk.n_elements() == 1 ? 30 : 12);

  double area = 0, tilt = 0;
  bool   is_up = true;
  for (unsigned int element = 0; element < disk.n_elements(); ++element)
    {
      const auto            bounds = disk.element_bounds(element);
      const Eigen::Vector2d size   = bounds[1] - bounds[0];
      for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const Eigen::Vector2d t(gauss.point(q)[0], gauss.point(q)[1]);
          SurfaceBasis          basis;
          SurfaceGeometry       geometry;
          disk.evaluate(bounds[0] + t.cwiseProduct(size), basis);
          contract(basis, disk.control_points(), geometry);

          const Eigen::Vector3d normal = geometry.a1.cross(geometry.a2);
          area += normal.norm() * size[0] * size[1] * gauss.weight(q);
          tilt  = std::max(tilt, normal.head<2>().norm() / normal.norm());
          is_up = is_up && normal[2] > 0;
        }
    }
  report("  relative deviation of the area",
         std::abs(area / (M_PI * R * R) - 1.),
         1e-13);
  report("  tilt of normals", tilt, 1e-14);
  std::cout << "  normals point to +z: " << (is_up ? "yes" : "NO") << std::endl;
}



int
main()
{
  for (const unsigned int n : {1, 2, 7, 12})
    {
      const NurbsSurface disk = NurbsSurface::disk(R, n);
      std::cout << n << " x " << n << " elements, " << disk.n_control_points()
                << " control points" << std::endl;
      report("  relative deviation from the circle",
             deviation_of_edges(disk),
             1e-14);
      check_area_and_normals(disk);
    }
}
