// Knot insertion does not change the surface; knots that cannot be inserted
// are refused.

#include <debond/geometry/nurbs_surface.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "checks.h"

using namespace Debond;

/** Curved, with unequal knots and weights; of size one. */
NurbsSurface
curved_surface(const KnotVector &knots_1, const KnotVector &knots_2)
{
  const unsigned int  n_1 = knots_1.n_basis_functions();
  const unsigned int  n_2 = knots_2.n_basis_functions();
  ControlNet          net(3, n_1 * n_2);
  std::vector<double> weights(n_1 * n_2);
  for (unsigned int j = 0; j < n_2; ++j)
    for (unsigned int i = 0; i < n_1; ++i)
      {
        const unsigned int k = j * n_1 + i;
        net.col(k) << i / (n_1 - 1.) + 0.05 * std::sin(1. * k),
          j / (n_2 - 1.) + 0.05 * std::cos(3. * k), 0.3 * std::sin(2. * k);
        weights[k] = 1. + 0.5 * std::cos(1.7 * k);
      }
  return NurbsSurface(knots_1, knots_2, net, weights);
}



double
difference(const NurbsSurface &a, const NurbsSurface &b)
{
  double result = 0;
  for (unsigned int i = 0; i <= 40; ++i)
    for (unsigned int j = 0; j <= 40; ++j)
      {
        const Eigen::Vector2d xi(i / 40., j / 40.);
        result = std::max(result, (a.point(xi) - b.point(xi)).norm());
      }
  return result;
}



void
check_insertion(const NurbsSurface &surface)
{
  std::cout << "Degree " << surface.degree() << std::endl;
  const unsigned int n_knots = surface.degree() == 2 ? 3 : 2;
  // The last one of degree 2 repeats a knot that is there already.
  const double values[3] = {0.33, 0.62, 0.25};
  for (unsigned int direction = 0; direction < 2; ++direction)
    {
      NurbsSurface refined = surface;
      for (unsigned int k = 0; k < n_knots; ++k)
        refined = refined.insert_knot(direction, values[k]);
      std::cout << "  direction " << direction << ": " << surface.n_elements()
                << " -> " << refined.n_elements() << " elements, "
                << surface.n_control_points() << " -> "
                << refined.n_control_points() << " control points" << std::endl;
      report("    change of the surface", difference(surface, refined), 1e-14);
    }
}



void
check_uniform_refinement()
{
  const NurbsSurface one =
    curved_surface(KnotVector::graded(2, 1), KnotVector::graded(2, 1));
  NurbsSurface refined = one;
  for (const auto &[direction, n] : {std::pair(0U, 7U), std::pair(1U, 4U)})
    for (unsigned int i = 1; i < n; ++i)
      refined = refined.insert_knot(direction, double(i) / n);
  const auto n = refined.n_elements_per_direction();
  std::cout << "Uniform refinement: " << n[0] << " x " << n[1] << " elements"
            << std::endl;
  report("    change of the surface", difference(one, refined), 1e-14);

  double uneven = 0;
  for (unsigned int e = 0; e < refined.n_elements(); ++e)
    {
      const auto bounds = refined.element_bounds(e);
      uneven            = std::max(
        uneven, (bounds[1] - bounds[0] - Eigen::Vector2d(1. / 7, 0.25)).norm());
    }
  report("    deviation of element sizes", uneven, 1e-15);
}



void
check_bilinear_interpolant(const NurbsSurface &surface)
{
  const NurbsSurface flat = surface.bilinear_interpolant();
  double             gap  = 0;
  for (const double u : flat.knots(0).breakpoints())
    for (const double v : flat.knots(1).breakpoints())
      gap = std::max(gap,
                     (flat.point(Eigen::Vector2d(u, v)) -
                      surface.point(Eigen::Vector2d(u, v)))
                       .norm());
  std::cout << "Bilinear interpolant: degree " << flat.degree() << ", "
            << flat.n_elements() << " elements, " << flat.n_control_points()
            << " control points" << std::endl;
  report("    gap at the knots", gap, 1e-14);
}



template <typename Action>
void
expect_refusal(const std::string &what, const Action &action)
{
  try
    {
      action();
      std::cout << "  " << what << ": ACCEPTED" << std::endl;
    }
  catch (const std::invalid_argument &)
    {
      std::cout << "  " << what << ": refused" << std::endl;
    }
}



int
main()
{
  const NurbsSurface surface =
    curved_surface(KnotVector(2, {0, 0, 0, 0.25, 0.7, 1, 1, 1}),
                   KnotVector(2, {0, 0, 0, 0.25, 0.5, 0.5, 1, 1, 1}));
  check_insertion(surface);
  check_insertion(curved_surface(KnotVector(1, {0, 0, 0.25, 0.7, 1, 1}),
                                 KnotVector(1, {0, 0, 0.5, 1, 1})));
  check_uniform_refinement();
  check_bilinear_interpolant(surface);

  std::cout << "What is not a knot" << std::endl;
  expect_refusal("a third 0.5", [&] { surface.insert_knot(1, 0.5); });
  expect_refusal("0.5 + 1e-14", [&] { surface.insert_knot(1, 0.5 + 1e-14); });
  expect_refusal("decreasing knots", [] {
    KnotVector(1, {0, 0, 0.7, 0.3, 1, 1});
  });
  expect_refusal("knots that are not open", [] {
    KnotVector(2, {0, 0, 0.5, 1, 1, 1});
  });
  expect_refusal("degree 3", [] { KnotVector::graded(3, 4); });
}
