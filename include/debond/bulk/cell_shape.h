#ifndef debond_bulk_cell_shape_h
#define debond_bulk_cell_shape_h

#include <debond/bulk/body_mesh.h>

#include <array>
#include <cmath>
#include <vector>

namespace Debond
{
  /** @name The reference cell [-1,1]^3
   *  Shape functions, quadrature and extrapolation of all cells. The third
   *  coordinate runs upwards as the vertices do, in the contact layer, too:
   *  the contact face is at +1 in the bone and at -1 in the implant. */
  //@{
  /** Number of corners, and of the points of the 2x2x2 Gauss quadrature, whose
   *  weights are all 1. */
  constexpr unsigned int n_corners = 8;

  /** Corner @p a in deal.II's order: bit d tells the sign of coordinate d. */
  inline Eigen::Vector3d
  corner(const unsigned int a)
  {
    return {a & 1 ? 1. : -1., a & 2 ? 1. : -1., a & 4 ? 1. : -1.};
  }

  /** Gauss point @p q, next to the corner of the same number. */
  inline Eigen::Vector3d
  gauss_point(const unsigned int q)
  {
    return corner(q) / std::sqrt(3.);
  }

  /** The four bilinear functions on [-1,1]^2, lexicographic. */
  std::array<double, 4>
  bilinear(double xi, double eta);

  /** The trilinear functions of the eight corners. */
  std::array<double, n_corners>
  trilinear(const Eigen::Vector3d &point);

  /** What the values at the Gauss points weigh at corner @p a if the trilinear
   *  function through them is continued: these points are the corners of a
   *  cell that is smaller by sqrt(3). */
  inline std::array<double, n_corners>
  extrapolation_weights(const unsigned int a)
  {
    return trilinear(std::sqrt(3.) * corner(a));
  }

  /** The point of [-1,1]^2 in the parameters of an element with these
   *  @p bounds, exact at both: neighbours must agree on their border. */
  Eigen::Vector2d
  parameters_at(const std::array<Eigen::Vector2d, 2> &bounds,
                double                                xi,
                double                                eta);

  /** Values and derivatives with respect to the reference coordinates of the
   *  functions of a cell, in the order of its nodes. */
  struct CellShape
  {
    std::vector<double>          N;
    std::vector<Eigen::Vector3d> derivative;
  };

  /**
   * Eight trilinear functions, or those of the contact layer (Corbett & Sauer
   * 2014),
   *
   *   x = (1-zeta)/2 sum_A N_A(xi,eta) x_A + (1+zeta)/2 sum_a L_a(xi,eta) x_a,
   *
   * zeta from the contact face inwards, N_A those of the NURBS by Bezier
   * extraction (Eqs. 34, 35 of the paper), L_a bilinear; or, with splines M_k
   * of the depth, sum_k M_k(zeta) sum_A N_A(xi,eta) x_kA in all layers.
   */
  CellShape
  shape_functions(const BodyMesh        &mesh,
                  const BodyMesh::Cell  &cell,
                  const Eigen::Vector3d &point);
  //@}
} // namespace Debond
#endif
