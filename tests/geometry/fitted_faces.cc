// Faces whose elements follow the rim of a disk or a ring. These and the
// rectangle around them are exact, and rims are lines of elements' sides.
// Functions have continuous gradients inside patches, and values across their
// borders. Projections find their points from anywhere.

#include <debond/geometry/surface_geometry.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <map>

#include "checks.h"

using namespace Debond;

constexpr double       R = 2.7, hole = 1.1, lx = 12.5, ly = 10.;
constexpr unsigned int n_around = 12, n_rings = 4, n_outside = 5;

struct Measures
{
  double area = 0., tilt = 0.;
};
Measures
measures(const NurbsSurface &face)
{
  Measures result;
  for (const auto &point : surface_quadrature(face, dealii::QGauss<1>(12)))
    {
      SurfaceGeometry geometry;
      contract(point.basis, face.control_points(), geometry);
      const Eigen::Vector3d normal = geometry.a1.cross(geometry.a2);
      result.area += point.JxW;
      grow(result.tilt,
           (normal.normalized() - Eigen::Vector3d::UnitZ()).norm());
    }
  return result;
}

/** Values and gradients in space of all functions at a place. */
std::map<unsigned int, Eigen::Vector3d>
functions(const NurbsSurface &face, const NurbsSurface::Place &place)
{
  SurfaceBasis basis;
  face.evaluate_in_element(place.element, place.xi, basis);
  Eigen::Matrix2d J = Eigen::Matrix2d::Zero();
  for (unsigned int a = 0; a < basis.size; ++a)
    J += face.control_points().col(basis.control_point[a]).head<2>() *
         Eigen::RowVector2d(basis.N_1[a], basis.N_2[a]);
  std::map<unsigned int, Eigen::Vector3d> result;
  for (unsigned int a = 0; a < basis.size; ++a)
    {
      const Eigen::Vector2d slope =
        J.inverse().transpose() * Eigen::Vector2d(basis.N_1[a], basis.N_2[a]);
      result[basis.control_point[a]] = {basis.N[a], slope[0], slope[1]};
    }
  return result;
}

struct Sides
{
  unsigned int smooth = 0, shared = 0, border = 0, on_rim = 0;
  double       jump = 0.; ///< of values
};
Sides
sides(const NurbsSurface &face)
{
  Sides result;
  for (unsigned int e = 0; e < face.n_elements(); ++e)
    for (unsigned int side = 0; side < 4; ++side)
      {
        Eigen::Vector2d xi = face.element_bounds(e)[0];
        xi[side / 2] += side % 2;
        xi[1 - side / 2] += 0.3;
        const double r = face.point(xi).norm();
        result.on_rim +=
          std::min(std::abs(r / R - 1.), std::abs(r / hole - 1.)) < 1e-14;
        result.border += face.is_border(e, side);
        if (face.is_border(e, side))
          continue;
        ++result.shared;
        const auto here  = functions(face, {e, xi}),
                   there = functions(face, face.places_beside(e, xi).at(0));
        double kink      = 0.;
        for (const auto &[A, values] : here)
          {
            const auto            found = there.find(A);
            const Eigen::Vector3d jump =
              found == there.end() ? values : (values - found->second).eval();
            grow(result.jump, std::abs(jump[0]));
            grow(kink, jump.tail<2>().norm());
          }
        result.smooth += kink < 1e-10;
      }
  return result;
}

double
error_of_projections(const NurbsSurface &face, const double innermost)
{
  double          result = 0.;
  Eigen::Vector2d guess  = face.element_bounds(0)[0];
  for (unsigned int k = 0; k < 300; ++k)
    {
      const double r     = R * std::sqrt(random_number(innermost, 0.999)),
                   angle = random_number(0., 2. * M_PI);
      const Eigen::Vector3d x(r * std::cos(angle), r * std::sin(angle), 0.1);
      const ClosestPoint    closest =
        closest_point(face, face.control_points(), x, &guess);
      guess = closest.xi;
      grow(result, (face.point(closest.xi) - x).norm() - 0.1);
      if (!closest.converged || !closest.is_orthogonal)
        result = 1.;
    }
  return result;
}

void
check(const std::string  &name,
      const NurbsSurface &face,
      const double        area,
      const unsigned int  n_outside,
      const unsigned int  n_walls  = 1,
      const bool          has_core = true)
{
  std::cout << name << std::endl;
  const Measures found = measures(face);
  report("  area", std::abs(found.area / area - 1.), 1e-13);
  report("  normals", found.tilt, 1e-13);
  constexpr unsigned int n    = n_around / 4;
  const unsigned int     core = has_core ? n : 0, rims = has_core ? n_walls : 2;
  const Sides            seen = sides(face);
  const auto inside_of        = [](const unsigned int i, const unsigned int j) {
    return 2 * (i * (j - 1) + j * (i - 1)); // from both sides
  };
  report("  elements",
         face.n_elements() ==
           core * core + n_around * (n_walls * n_rings + n_outside));
  report("  sides on rims, each seen from both sides",
         seen.on_rim == (n_outside > 0 ? 2 : 1) * rims * n_around);
  report("  sides at the border", seen.border == (has_core ? 1 : 2) * n_around);
  report("  smooth across all sides inside patches",
         seen.smooth == (has_core ? inside_of(n, n) : 0) +
                          4 * n_walls * inside_of(n, n_rings) +
                          (n_outside > 0 ? 4 * inside_of(n, n_outside) : 0));
  report("  and across no others", seen.smooth < seen.shared);
  report("  functions are continuous", seen.jump, 1e-13);
  report("  projections of random points",
         error_of_projections(face,
                              has_core ? 0. : std::pow(1.001 * hole / R, 2)),
         1e-12);
}

int
main()
{
  check("disk",
        NurbsSurface::fitted_disk(R, n_around, n_rings),
        M_PI * R * R,
        0);
  check(
    "rectangle",
    NurbsSurface::fitted_rectangle(lx, ly, R, 0., n_around, n_rings, n_outside),
    lx * ly,
    n_outside);
  check("ring",
        NurbsSurface::fitted_ring(R, hole, n_around, n_rings),
        M_PI * (R * R - hole * hole),
        0,
        1,
        false);
  check("rectangle around a ring",
        NurbsSurface::fitted_rectangle(
          lx, ly, R, hole, n_around, n_rings, n_outside),
        lx * ly,
        n_outside,
        2);
}
