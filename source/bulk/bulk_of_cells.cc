#include <debond/bulk/bulk_of_cells.h>

#include <array>

namespace Debond
{
  // R = int P : dF/dv dV by the true Neo-Hookean law, Eq. (1), cell by cell
  // and without K.
  bool
  BulkOfCells::internal_forces(const Eigen::VectorXd &v,
                               Eigen::VectorXd       &force,
                               double                &energy) const
  {
    return cells.internal_forces(v, force, energy);
  }



  // K x cell by cell, with the rows of the supports, which the factorised K
  // does not have: from them a linear body has the reactions of its
  // supports. Cells that x leaves at rest, and that is most of them, are
  // passed over: x are rigid motions of the supported nodes only. A second
  // matrix with the rows of the supports would have to be kept for six
  // products.
  Eigen::MatrixXd
  BulkOfCells::product_at_rest(const Eigen::MatrixXd &x) const
  {
    const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(x.rows());
    Eigen::MatrixXd       y = Eigen::MatrixXd::Zero(x.rows(), x.cols()), K;
    for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
      {
        // Gather, multiply, scatter, as in a matrix-free operator.
        const unsigned int n = cells.n_nodes(cell);
        Eigen::MatrixXd    x_cell(3 * n, x.cols());
        for (unsigned int a = 0; a < n; ++a)
          x_cell.middleRows<3>(3 * a) =
            x.middleRows<3>(3 * cells.nodes(cell)[a]);
        if (x_cell.isZero(0.))
          continue;
        cells.tangent(cell, at_rest, K);
        const Eigen::MatrixXd y_cell = K * x_cell;
        for (unsigned int a = 0; a < n; ++a)
          y.middleRows<3>(3 * cells.nodes(cell)[a]) +=
            y_cell.middleRows<3>(3 * a);
      }
    return y;
  }



  // Cauchy stress [MPa] for pictures: from the Gauss points, where it is
  // most accurate, to the corners of each cell, and there the mean over the
  // cells. The trilinear extrapolation through the 2x2x2 points evaluates
  // no gradient at a corner, where the disk's parametrisation is singular.
  // It is not continuous from cell to cell; the mean hides that, so it is
  // no measure of the error.
  std::vector<Eigen::Matrix3d>
  BulkOfCells::vertex_stress(const Eigen::VectorXd &v,
                             const StressLaw        law) const
  {
    std::vector<Eigen::Matrix3d> stress(mesh.n_vertices(),
                                        Eigen::Matrix3d::Zero());
    std::vector<double>          n_cells(mesh.n_vertices(), 0.);
    for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
      {
        // H = dv/dX in the body's frame, and by the material's law the
        // stress.
        double H[EnrichedCells::n_q][3][3];
        cells.displacement_gradients(cell, v, H);
        std::array<Eigen::Matrix3d, EnrichedCells::n_q> at_points;
        const auto factors = cells.stiffness_factors(cell);
        for (unsigned int q = 0; q < EnrichedCells::n_q; ++q)
          at_points[q] = factors[q] * (cells.material().*law)(H[q]);
        for (const unsigned int a : dealii::GeometryInfo<3>::vertex_indices())
          {
            // The trilinear polynomial through the eight points, which are the
            // corners of a cell that is smaller by sqrt(3), at corner a.
            // Vertices of the contact face are corners as any other here:
            // pictures show the mesh, not the control points.
            const unsigned int     vertex = mesh.cells()[cell].vertices[a];
            const dealii::Point<3> middle(0.5, 0.5, 0.5);
            const dealii::Point<3> corner =
              middle +
              std::sqrt(3.) *
                (dealii::GeometryInfo<3>::unit_cell_vertex(a) - middle);
            for (unsigned int q = 0; q < EnrichedCells::n_q; ++q)
              stress[vertex] +=
                dealii::GeometryInfo<3>::d_linear_shape_function(corner, q) *
                at_points[q];
            ++n_cells[vertex];
          }
      }
    add_up_at_vertices(stress, n_cells);
    // Every cell counts the same, whatever its volume; each vertex has at
    // least one.
    for (unsigned int vertex = 0; vertex < mesh.n_vertices(); ++vertex)
      stress[vertex] /= n_cells[vertex];
    return stress;
  }
} // namespace Debond
