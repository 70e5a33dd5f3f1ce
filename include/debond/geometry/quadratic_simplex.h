#pragma once

#include <Eigen/Core>

namespace Debond
{
  // A triangle is cut into three quadrilaterals, a tetrahedron into four
  // hexahedra: one at each vertex, with the middles of edges and faces and the
  // centre. In the box at the vertex 0 the vertices 1, 2 and 3 are along its
  // axes.

  /** Barycentric coordinates of the 2^dim corners of that box, a column each,
   *  whose corner @p first is the vertex 0. */
  template <int dim>
  Eigen::Matrix<double, dim + 1, 1 << dim>
  barycentric_corners(const unsigned int first)
  {
    Eigen::Matrix<double, dim + 1, 1 << dim> L;
    L.setZero();
    L.row(0).setOnes();
    for (unsigned int c = 0; c < 1 << dim; ++c)
      {
        for (int d = 0; d < dim; ++d)
          L(1 + d, c) = (c ^ first) >> d & 1;
        L.col(c) /= L.col(c).sum();
      }
    return L;
  }

  /**
   * Functions of the second degree, a row each: those of the vertices, L_i (2
   * L_i - 1), then those of the middles of edges i < j, 4 L_i L_j. @p L:
   * barycentric coordinates, a row each; their values and, in further columns,
   * derivatives.
   */
  template <typename Coordinates>
  Eigen::MatrixXd
  quadratic_functions(const Coordinates &L)
  {
    const unsigned int n = L.rows(), n_derivatives = L.cols() - 1;
    Eigen::MatrixXd    N(n * (n + 1) / 2, 1 + n_derivatives);
    for (unsigned int i = 0, edge = n; i < n; ++i)
      {
        N.row(i) = (4. * L(i, 0) - 1.) * L.row(i);
        N(i, 0)  = L(i, 0) * (2. * L(i, 0) - 1.);
        for (unsigned int j = i + 1; j < n; ++j, ++edge)
          {
            N.row(edge) = 4. * (L(i, 0) * L.row(j) + L(j, 0) * L.row(i));
            N(edge, 0)  = 4. * L(i, 0) * L(j, 0);
          }
      }
    return N;
  }
} // namespace Debond
