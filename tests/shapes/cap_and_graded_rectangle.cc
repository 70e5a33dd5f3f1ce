// The contact face of a cap: its distance from the sphere falls with the third
// power of the size of the elements, the error of its normals with the second,
// that of its area with the fourth. The graded rectangle: knot lines where they
// should be, an affine map, and closest points that are found.

#include <debond/bulk/bulk_space.h>
#include <debond/geometry/surface_geometry.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

#include "checks.h"
#include "rectangle_of.h"

using namespace Debond;

constexpr double R = 2.7, sphere_radius = 6.;



struct CapError
{
  double surface = 0, normal = 0, area = 0, rim = 0;
};



Eigen::Vector3d
normal_at(const NurbsSurface    &surface,
          const Eigen::Vector2d &xi,
          Eigen::Vector3d       &position)
{
  SurfaceBasis    basis;
  SurfaceGeometry geometry;
  surface.evaluate(xi, basis);
  contract(basis, surface.control_points(), geometry);
  position = geometry.y;
  return geometry.a1.cross(geometry.a2).normalized();
}



/** Distance from the sphere [R], and angle between the normals. */
CapError
error_of_cap(const unsigned int n)
{
  const NurbsSurface     cap = NurbsSurface::cap(R, sphere_radius, n);
  const Eigen::Vector3d  centre(0, 0, sphere_radius);
  CapError               error;
  constexpr unsigned int samples = 211;
  for (unsigned int j = 0; j < samples; ++j)
    for (unsigned int i = 0; i < samples; ++i)
      {
        Eigen::Vector3d       y;
        const Eigen::Vector3d normal =
          normal_at(cap, {(i + 0.5) / samples, (j + 0.5) / samples}, y);
        grow(error.surface, std::abs((y - centre).norm() - sphere_radius) / R);
        grow(error.normal, (normal - (centre - y).normalized()).norm());
      }
  for (const auto &point : surface_quadrature(cap, dealii::QGauss<1>(8)))
    error.area += point.JxW;
  error.area = std::abs(error.area / (2. * M_PI * sphere_radius *
                                      height_on_sphere(R, sphere_radius)) -
                        1.);
  for (unsigned int i = 0; i <= 100; ++i)
    grow(error.rim,
         std::abs(cap.point({i / 100., 0.}).head<2>().norm() / R - 1.));
  return error;
}



void
report_order(const std::string &what,
             const double       coarse,
             const double       fine,
             const double       lower,
             const double       upper)
{
  const double order = std::log2(coarse / fine);
  std::cout << what << " falls with order " << lower << " to " << upper << ": ";
  if (lower < order && order < upper)
    std::cout << "yes" << std::endl;
  else
    std::cout << "NO, " << order << " from " << coarse << " to " << fine
              << std::endl;
}



void
check_cap()
{
  std::cout << "Cap" << std::endl;
  std::vector<CapError> errors;
  for (const unsigned int n : {4, 8, 16, 32})
    errors.push_back(error_of_cap(n));
  for (unsigned int k = 0; k + 1 < errors.size(); ++k)
    {
      report_order("  distance from the sphere",
                   errors[k].surface,
                   errors[k + 1].surface,
                   2.8,
                   3.1);
      report_order(
        "  angle of normals", errors[k].normal, errors[k + 1].normal, 2., 2.4);
      report_order("  area", errors[k].area, errors[k + 1].area, 3.6, 4.);
    }
  report("  distance from the sphere, 32 x 32 elements, over R",
         errors[3].surface,
         1e-6);
  report("  distance of the rim from the circle", errors[3].rim, 1e-14);

  std::vector<double> fitted;
  for (const unsigned int n : {2, 4, 8})
    {
      const NurbsSurface cap =
        NurbsSurface::fitted_cap(R, sphere_radius, 0.4 * R, 8 * n, 3 * n);
      fitted.push_back(0.);
      for (const auto &point : surface_quadrature(cap, dealii::QGauss<1>(8)))
        grow(fitted.back(),
             std::abs((interpolate(point.basis, cap.control_points()) -
                       Eigen::Vector3d(0, 0, sphere_radius))
                        .norm() -
                      sphere_radius));
    }
  for (const unsigned int k : {0, 1})
    report_order(
      "  fitted, distance from the sphere", fitted[k], fitted[k + 1], 2.8, 3.6);

  double flat = 0;
  for (unsigned int n : {1, 2, 5})
    {
      const NurbsSurface disk = NurbsSurface::disk(R, n);
      const NurbsSurface cap  = NurbsSurface::cap(R, 1e9 * R, n);
      grow(flat, (disk.control_points() - cap.control_points()).norm());
      grow(flat,
           (cap.control_points().topRows<2>() -
            disk.control_points().topRows<2>())
               .norm() *
             1e9);
    }
  report("  a very flat cap is a disk, deviation", flat, 1e-8);

  BodyParameters parameters;
  parameters.shape      = BodyShape::cap;
  parameters.radius     = R;
  parameters.cap_radius = sphere_radius;
  parameters.height     = 2.;
  parameters.cells      = {{5, 5, 3}};
  for (const SurfaceKind kind : {SurfaceKind::nurbs, SurfaceKind::bilinear})
    {
      parameters.contact_surface = kind;
      const BulkSpace mesh(parameters, Side::implant);
      double          corners = 0, layers = 0;
      for (const BulkSpace::Cell &cell : mesh.cells())
        if (cell.enriched)
          {
            const auto bounds =
              mesh.surface().element_bounds(cell.surface_element);
            for (unsigned int corner = 0; corner < 4; ++corner)
              {
                const Eigen::Vector3d bottom = mesh.surface().point(
                  {bounds[corner % 2][0], bounds[corner / 2][1]});
                const Eigen::Vector3d &X =
                  mesh.reference_position(cell.vertices[4 + corner]);
                grow(corners,
                     (mesh.reference_position(cell.vertices[corner]) - bottom)
                       .norm());
                grow(corners, (X - bottom).head<2>().norm());
                grow(layers,
                     std::abs(X[2] - (bottom[2] + (2. - bottom[2]) / 3.)));
              }
          }
      report(kind == SurfaceKind::nurbs ? "  vertices over the surface" :
                                          "  bilinear: the same",
             std::max(corners, layers),
             1e-14);
    }
}



void
check_rectangle(const std::array<unsigned int, 2> n, const double grading)
{
  std::cout << "Rectangle of " << n[0] << " x " << n[1] << ", grading "
            << grading << std::endl;
  const Eigen::Vector2d size(5., 4.);
  const NurbsSurface    rectangle =
    rectangle_of(size[0], size[1], n[0], n[1], 2, grading);
  const NurbsSurface bilinear = rectangle.bilinear_interpolant();

  double lines = 0, affine = 0, projected = 0;
  for (unsigned int d = 0; d < 2; ++d)
    for (unsigned int i = 0; i <= n[d]; ++i)
      {
        const double    s = 2. * i / n[d] - 1.;
        Eigen::Vector2d xi(0.3, 0.3);
        xi[d] = rectangle.knots(d).breakpoints()[i];
        grow(lines,
             std::abs(rectangle.point(xi)[d] -
                      0.5 * size[d] * std::copysign(1., s) *
                        std::pow(std::abs(s), grading)));
      }
  for (unsigned int k = 0; k < 300; ++k)
    {
      const Eigen::Vector2d xi(random_number(0, 1), random_number(0, 1));
      for (const NurbsSurface *surface : {&rectangle, &bilinear})
        {
          const Eigen::Vector3d y = surface->point(xi);
          const Eigen::Vector3d plane((xi[0] - 0.5) * size[0],
                                      (xi[1] - 0.5) * size[1],
                                      0);
          grow(affine, (y - plane).norm());
          const ClosestPoint found =
            closest_point(*surface,
                          surface->control_points(),
                          y + Eigen::Vector3d(0, 0, 0.3));
          grow(projected, (found.xi - xi).norm());
          if (!found.is_orthogonal || !found.converged)
            projected = 1e9;
        }
    }
  report("  knot lines", lines, 1e-14);
  report("  affine map", affine, 1e-14);
  report("  closest points", projected, 1e-12);
}



int
main()
{
  check_cap();
  check_rectangle({{6, 5}}, 2.);
  check_rectangle({{9, 24}}, 1.5);
  check_rectangle({{8, 7}}, 0.7);
  check_rectangle({{8, 7}}, 1.);
}
