#include <debond/bulk/bulk.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>

namespace Debond
{
  // R = int P : dF/dv dV by the true law, Eq. (1), cell by cell
  // and without K.
  bool
  Bulk::internal_forces(const Eigen::VectorXd &v,
                        Eigen::VectorXd       &force,
                        double                &energy) const
  {
    const bool is_valid = cells.internal_forces(v, force, energy);
    mesh.condense(force);
    return is_valid;
  }



  // K x cell by cell, with the rows of the supports, which the factorised K
  // does not have: from them a linear body has the reactions of its
  // supports. Cells that x leaves at rest, and that is most of them, are
  // passed over: x are rigid motions of the supported nodes only. A second
  // matrix with the rows of the supports would have to be kept for six
  // products.
  Eigen::MatrixXd
  Bulk::product_at_rest(Eigen::MatrixXd x) const
  {
    const Eigen::VectorXd at_rest = Eigen::VectorXd::Zero(x.rows());
    Eigen::MatrixXd       y = Eigen::MatrixXd::Zero(x.rows(), x.cols()), K;
    for (unsigned int j = 0; j < x.cols(); ++j)
      mesh.distribute(x.col(j));
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
    for (unsigned int j = 0; j < y.cols(); ++j)
      mesh.condense(y.col(j));
    return y;
  }



  std::vector<dealii::types::global_dof_index>
  Bulk::dofs_of(const unsigned int cell) const
  {
    std::vector<dealii::types::global_dof_index> dofs;
    for (const unsigned int node : mesh.cells()[cell].nodes)
      for (unsigned int c = 0; c < 3; ++c)
        dofs.push_back(3 * node + c);
    return dofs;
  }



  dealii::FullMatrix<double>
  Bulk::stiffness_of(const unsigned int cell, const Eigen::VectorXd &v) const
  {
    Eigen::MatrixXd tangent;
    cells.tangent(cell, v, tangent);
    // symmetric: by rows is by columns
    return dealii::FullMatrix<double>(tangent.rows(),
                                      tangent.cols(),
                                      tangent.data());
  }



  // Cauchy stress [MPa] for pictures: from the Gauss points, where it is
  // most accurate, to the corners of each cell, and there the mean over the
  // cells. The polynomial through the points evaluates no gradient at a
  // corner, where the disk's parametrisation is singular. It is not continuous
  // from cell to cell; the mean hides that, so it is no measure of the error.
  std::vector<Eigen::Matrix3d>
  Bulk::vertex_stress(const Eigen::VectorXd &v,
                      const bool             has_small_strains) const
  {
    const dealii::FE_DGQArbitraryNodes<3> through_points(
      dealii::QGauss<1>(cells.n_along()));
    std::vector<Eigen::Matrix3d> stress(mesh.n_vertices(),
                                        Eigen::Matrix3d::Zero());
    std::vector<double>          n_cells(mesh.n_vertices(), 0.);
    for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
      {
        const auto at_points = cells.stress(cell, v, has_small_strains);
        for (const unsigned int a : dealii::GeometryInfo<3>::vertex_indices())
          {
            // Vertices of the contact face are corners as any other here:
            // pictures show the mesh, not the control points.
            const unsigned int vertex = mesh.cells()[cell].vertices[a];
            for (unsigned int q = 0; q < at_points.size(); ++q)
              stress[vertex] +=
                through_points.shape_value(
                  q, dealii::GeometryInfo<3>::unit_cell_vertex(a)) *
                at_points[q];
            ++n_cells[vertex];
          }
      }
    add_up_at_vertices(stress, n_cells);
    // Every cell counts the same, whatever its volume.
    for (unsigned int vertex = 0; vertex < mesh.n_vertices(); ++vertex)
      if (n_cells[vertex] > 0.)
        stress[vertex] /= n_cells[vertex];
    return stress;
  }



  void
  Bulk::for_each_stress(const Eigen::VectorXd &v,
                        const bool             has_small_strains,
                        const StressVisitor   &visit) const
  {
    for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
      {
        const auto stress = cells.stress(cell, v, has_small_strains);
        for (unsigned int q = 0; q < stress.size(); ++q)
          visit(cell, cells.point(q), stress[q], cells.volume(cell, q));
      }
  }
} // namespace Debond
