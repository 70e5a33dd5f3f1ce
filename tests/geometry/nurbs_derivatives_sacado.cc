// First and second derivatives of the NURBS basis agree with automatic
// differentiation of the Cox-de Boor recursion and the rational weights.

#include <debond/geometry/nurbs_surface.h>

#include <Sacado.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "checks.h"

using namespace Debond;

using First  = Sacado::Fad::SFad<double, 2>;
using Number = Sacado::Fad::SFad<First, 2>;

/** B-spline i of degree p by the recursion of Cox and de Boor, 0/0 = 0. Knows
 *  nothing of extraction. Right at an inner knot it takes the right span. */
Number
cox_de_boor(const std::vector<double> &U,
            const unsigned int         i,
            const unsigned int         p,
            const Number              &u)
{
  const double value = u.val().val();
  if (p == 0)
    return Number(U[i] <= value && value < U[i + 1] ? 1. : 0.);

  Number result = 0.;
  if (U[i + p] > U[i])
    result += (u - U[i]) / (U[i + p] - U[i]) * cox_de_boor(U, i, p - 1, u);
  if (U[i + p + 1] > U[i + 1])
    result += (U[i + p + 1] - u) / (U[i + p + 1] - U[i + 1]) *
              cox_de_boor(U, i + 1, p - 1, u);
  return result;
}



/** All basis functions of the patch. */
std::vector<Number>
reference_basis(const NurbsSurface &surface, const Eigen::Vector2d &point)
{
  Number xi[2];
  for (unsigned int d = 0; d < 2; ++d)
    {
      xi[d]       = Number(2, d, First(point[d]));
      xi[d].val() = First(2, d, point[d]);
    }

  const unsigned int  n[]{surface.knots(0).n_basis_functions(),
                          surface.knots(1).n_basis_functions()};
  std::vector<Number> R(n[0] * n[1]);
  Number              W = 0.;
  for (unsigned int j = 0; j < n[1]; ++j)
    for (unsigned int i = 0; i < n[0]; ++i)
      {
        const unsigned int k = j * n[0] + i;
        R[k] =
          surface.weights()[k] *
          cox_de_boor(surface.knots(0).knots(), i, surface.degree(), xi[0]) *
          cox_de_boor(surface.knots(1).knots(), j, surface.degree(), xi[1]);
        W += R[k];
      }
  for (Number &r : R)
    r = Number(r / W);
  return R;
}



struct Deviation
{
  double values = 0, first = 0, second = 0;
};



/** Compares all functions of the patch: those that do not live on the element
 *  must vanish. */
void
compare(const NurbsSurface    &surface,
        const Eigen::Vector2d &xi,
        Deviation             &deviation)
{
  CurvedBasis basis;
  surface.evaluate(xi, basis);
  std::vector<std::array<double, 6>> ours(surface.n_control_points(),
                                          std::array<double, 6>{});
  for (unsigned int k = 0; k < basis.size; ++k)
    ours[basis.control_point[k]] = {{basis.N[k],
                                     basis.N_1[k],
                                     basis.N_2[k],
                                     basis.N_11[k],
                                     basis.N_12[k],
                                     basis.N_22[k]}};

  const std::vector<Number> reference = reference_basis(surface, xi);
  for (unsigned int k = 0; k < ours.size(); ++k)
    {
      const Number &R         = reference[k];
      const double  theirs[6] = {R.val().val(),
                                 R.dx(0).val(),
                                 R.dx(1).val(),
                                 R.dx(0).dx(0),
                                 R.dx(0).dx(1),
                                 R.dx(1).dx(1)};
      // Written such that a NaN is not lost.
      const auto grow = [&](double &maximum, const unsigned int c) {
        const double d = std::abs(ours[k][c] - theirs[c]);
        if (!(d <= maximum))
          maximum = d;
      };
      grow(deviation.values, 0);
      grow(deviation.first, 1);
      grow(deviation.first, 2);
      grow(deviation.second, 3);
      grow(deviation.second, 4);
      grow(deviation.second, 5);
    }
}



void
check(const std::string &name, const NurbsSurface &surface)
{
  Deviation deviation;
  for (const double u : {0., 0.05, 0.1, 0.25, 0.4, 0.51, 0.8, 0.999})
    for (const double v : {0., 0.01, 0.3, 0.5, 0.7, 0.77, 0.95})
      compare(surface, Eigen::Vector2d(u, v), deviation);
  std::cout << name << std::endl;
  report("  deviation of values", deviation.values, 1e-14);
  report("  deviation of first derivatives", deviation.first, 1e-12);
  report("  deviation of second derivatives", deviation.second, 1e-10);
}



NurbsSurface
surface_with(const KnotVector &knots_1,
             const KnotVector &knots_2,
             const bool        is_rational)
{
  const unsigned int n =
    knots_1.n_basis_functions() * knots_2.n_basis_functions();
  std::vector<double> weights(n, 1.);
  if (is_rational)
    for (unsigned int i = 0; i < n; ++i)
      weights[i] = 1. + 0.6 * std::sin(2.3 * i);
  return NurbsSurface(knots_1, knots_2, ControlNet::Zero(3, n), weights);
}



int
main()
{
  const KnotVector uneven_1(2, {0, 0, 0, 0.1, 0.4, 0.4, 0.85, 1, 1, 1});
  const KnotVector uneven_2(2, {0, 0, 0, 0.3, 0.37, 0.7, 1, 1, 1});
  check("Disk, 4 x 4 elements", NurbsSurface::disk(1., 4));
  check("Degree 2, uneven knots, uneven weights",
        surface_with(uneven_1, uneven_2, true));
  check("Degree 2, uneven knots, weights 1",
        surface_with(uneven_1, uneven_2, false));
  check("Degree 2, one span, uneven weights",
        surface_with(KnotVector::graded(2, 1), KnotVector::graded(2, 1), true));
  const KnotVector linear_1(1, {0, 0, 0.1, 0.4, 1, 1});
  const KnotVector linear_2(1, {0, 0, 0.7, 1, 1});
  check("Degree 1, uneven knots, uneven weights",
        surface_with(linear_1, linear_2, true));
  check("Degree 1, uneven knots, weights 1",
        surface_with(linear_1, linear_2, false));
}
