// NURBS basis functions are a partition of unity, not negative, and with
// control points at the Greville abscissae the rectangle is an affine map.

#include <debond/geometry/nurbs_surface.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "checks.h"
#include "rectangle_of.h"

using namespace Debond;

template <typename Check>
void
for_all_points(const NurbsSurface &surface, const Check &check)
{
  for (unsigned int element = 0; element < surface.n_elements(); ++element)
    {
      const auto bounds = surface.element_bounds(element);
      for (const double s : {0., 0.1, 0.5, 0.77, 1.})
        for (const double t : {0., 0.3, 0.5, 0.9, 1.})
          {
            const Eigen::Vector2d xi =
              bounds[0] +
              Eigen::Vector2d(s, t).cwiseProduct(bounds[1] - bounds[0]);
            CurvedBasis basis;
            surface.evaluate_in_element(element, xi, basis);
            check(xi, basis);
          }
    }
}



void
check_sums(const std::string &name, const NurbsSurface &surface)
{
  double values = 0, first = 0, second = 0, negative = 0;
  for_all_points(surface, [&](const Eigen::Vector2d &, const CurvedBasis &b) {
    double N = 0, N_1 = 0, N_2 = 0, N_11 = 0, N_12 = 0, N_22 = 0;
    for (unsigned int k = 0; k < b.size; ++k)
      {
        N += b.N[k];
        N_1 += b.N_1[k];
        N_2 += b.N_2[k];
        N_11 += b.N_11[k];
        N_12 += b.N_12[k];
        N_22 += b.N_22[k];
        negative = std::max(negative, -b.N[k]);
      }
    values = std::max(values, std::abs(N - 1.));
    first  = std::max({first, std::abs(N_1), std::abs(N_2)});
    second = std::max({second, std::abs(N_11), std::abs(N_12), std::abs(N_22)});
  });
  std::cout << name << std::endl;
  report("  deviation of the sum from 1", values, 1e-14);
  report("  sum of first derivatives", first, 1e-12);
  report("  sum of second derivatives", second, 1e-10);
  report("  negative values", negative, 1e-15);
}



NurbsSurface
uneven_surface(const unsigned int degree)
{
  const KnotVector knots_1 =
    degree == 2 ? KnotVector(2, {0, 0, 0, 0.1, 0.4, 0.4, 0.85, 1, 1, 1}) :
                  KnotVector(1, {0, 0, 0.1, 0.4, 0.85, 1, 1});
  const KnotVector   knots_2 = degree == 2 ?
                                 KnotVector(2, {0, 0, 0, 0.7, 1, 1, 1}) :
                                 KnotVector(1, {0, 0, 0.7, 1, 1});
  const unsigned int n =
    knots_1.n_basis_functions() * knots_2.n_basis_functions();
  std::vector<double> weights(n);
  for (unsigned int i = 0; i < n; ++i)
    weights[i] = 1. + 0.6 * std::sin(2.3 * i);
  return NurbsSurface(knots_1, knots_2, ControlNet::Zero(3, n), weights);
}



void
check_affine(const unsigned int degree)
{
  const double       lx = 7, ly = 3;
  const NurbsSurface surface  = rectangle_of(lx, ly, 5, 4, degree);
  double             position = 0, slope = 0;
  for_all_points(surface, [&](const Eigen::Vector2d &xi, const CurvedBasis &b) {
    Eigen::Vector3d y = Eigen::Vector3d::Zero(), a1 = y, a2 = y;
    for (unsigned int k = 0; k < b.size; ++k)
      {
        const auto P = surface.control_points().col(b.control_point[k]);
        y += b.N[k] * P;
        a1 += b.N_1[k] * P;
        a2 += b.N_2[k] * P;
      }
    const Eigen::Vector3d exact(lx * (xi[0] - 0.5), ly * (xi[1] - 0.5), 0.);
    position = std::max(position, (y - exact).norm());
    slope    = std::max({slope,
                         (a1 - Eigen::Vector3d(lx, 0, 0)).norm(),
                         (a2 - Eigen::Vector3d(0, ly, 0)).norm()});
  });
  std::cout << "Rectangle of degree " << degree << ": " << surface.n_elements()
            << " elements, " << surface.n_control_points() << " control points"
            << std::endl;
  report("  deviation of positions", position, 1e-14);
  report("  deviation of tangents", slope, 1e-12);
}



/** A basis that is kept is that of where it has been moved to last. */
void
check_kept()
{
  const NurbsSurface surfaces[]{NurbsSurface::disk(30., 5), uneven_surface(2)};
  KeptBasis          kept;
  double             difference = 0.;
  for (const auto &[surface, u] : {std::pair(0, 0.2),
                                   std::pair(0, 0.7),
                                   std::pair(1, 0.7),
                                   std::pair(1, 0.7),
                                   std::pair(0, 0.7),
                                   std::pair(0, 0.2)})
    {
      const Eigen::Vector2d xi(u, 0.4);
      SurfaceBasis          fresh;
      surfaces[surface].evaluate(xi, fresh);
      kept.move_to(surfaces[surface], xi);
      for (unsigned int k = 0; k < fresh.size; ++k)
        difference += (kept.control_point[k] != fresh.control_point[k]) +
                      std::abs(kept.N[k] - fresh.N[k]) +
                      std::abs(kept.N_1[k] - fresh.N_1[k]) +
                      std::abs(kept.N_2[k] - fresh.N_2[k]);
      difference += kept.size != fresh.size || kept.element != fresh.element;
    }
  report("A basis that is kept differs by", difference, 1e-30);
}



int
main()
{
  check_sums("Disk, 5 x 5 elements", NurbsSurface::disk(30., 5));
  check_sums("Uneven knots and weights, degree 2", uneven_surface(2));
  check_sums("Uneven knots and weights, degree 1", uneven_surface(1));
  check_affine(2);
  check_affine(1);
  check_kept();
}
