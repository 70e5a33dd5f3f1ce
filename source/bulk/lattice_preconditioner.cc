#include <debond/bulk/bulk_solvers.h>
#include <debond/bulk/lattice_preconditioner.h>
#include <debond/support/ranks.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    /** Calls work(node, Young's modulus of a cell over the mean of its layer)
     *  for all nodes of all cells. */
    template <typename Work>
    void
    for_each_node_of_cells(const BodyMesh      &mesh,
                           const EnrichedCells &cells,
                           const Work          &work)
    {
      const auto         &n = mesh.parameters().cells;
      std::vector<double> of_layer(n[2], 0.);
      for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
        of_layer[mesh.cells()[cell].layer] +=
          cells.stiffness_factors(cell).mean() / (n[0] * n[1]);
      for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
        for (unsigned int a = 0; a < cells.n_nodes(cell); ++a)
          work(cells.nodes(cell)[a],
               cells.stiffness_factors(cell).mean() /
                 of_layer[mesh.cells()[cell].layer]);
    }
  } // namespace



  LatticePreconditioner::LatticePreconditioner(const BodyMesh           &mesh,
                                               const EnrichedCells      &cells,
                                               std::vector<unsigned int> rows)
    : n_dofs(3 * mesh.n_nodes())
    , dofs(std::move(rows))
    , lattice(make_lattice_bulk(mesh, cells))
    , scale(dofs.size())
  {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(mesh.n_nodes()), number = sum;
    for_each_node_of_cells(mesh,
                           cells,
                           [&](const unsigned int node, const double e) {
                             sum[node] += e;
                             number[node] += 1.;
                           });
    for (unsigned int row = 0; row < dofs.size(); ++row)
      {
        const unsigned int node = dofs[row] / 3, c = dofs[row] % 3;
        scale[row]                     = std::sqrt(number[node] / sum[node]);
        const Eigen::Vector3d &X       = mesh.reference_position(node);
        const auto             at_side = [&](const unsigned int d) {
          return std::abs(X[d]) > (0.5 - 1e-9) * mesh.parameters().size[d];
        };
        if (!mesh.is_fixed(node, c) && (at_side(0) || at_side(1)))
          at_sides.push_back(row);
      }
    lattice->set_contact(
      std::vector<bool>(mesh.surface().n_control_points(), false));
    lattice->linearise({});
  }



  // Where the modulus jumps from cell to cell scaling helps little, and the
  // number of iterations grows with the jump; one of them costs a sixth of one
  // with multigrid.
  bool
  LatticePreconditioner::pays(const BodyMesh &mesh, const EnrichedCells &cells)
  {
    constexpr double largest_jump = 10.;
    if (Ranks::number() > 1 || !mesh.parameters().has_equal_splines())
      return false;
    const double    none     = std::numeric_limits<double>::infinity();
    Eigen::VectorXd smallest = Eigen::VectorXd::Constant(mesh.n_nodes(), none),
                    largest  = Eigen::VectorXd::Zero(mesh.n_nodes());
    for_each_node_of_cells(mesh,
                           cells,
                           [&](const unsigned int node, const double e) {
                             smallest[node] = std::min(smallest[node], e);
                             largest[node]  = std::max(largest[node], e);
                           });
    return (largest.array() <= largest_jump * (1. + 1e-9) * smallest.array())
      .all();
  }



  bool
  LatticePreconditioner::set_up(const Epetra_CrsMatrix &K)
  {
    std::vector<int> place(dofs.size(), -1);
    for (unsigned int i = 0; i < at_sides.size(); ++i)
      place[at_sides[i]] = i;
    std::vector<Eigen::Triplet<double>> of_sides, of_columns;
    for (unsigned int i = 0; i < at_sides.size(); ++i)
      {
        int     n, *rows;
        double *values; // of a row, which is a column, too
        K.ExtractMyRowView(at_sides[i], n, values, rows);
        for (int k = 0; k < n; ++k)
          {
            of_columns.emplace_back(rows[k], i, values[k]);
            if (place[rows[k]] >= 0)
              of_sides.emplace_back(place[rows[k]], i, values[k]);
          }
      }
    columns_of_sides.resize(dofs.size(), at_sides.size());
    columns_of_sides.setFromTriplets(of_columns.begin(), of_columns.end());
    Eigen::SparseMatrix<double> K_of_sides(at_sides.size(), at_sides.size());
    K_of_sides.setFromTriplets(of_sides.begin(), of_sides.end());
    return sides.compute(K_of_sides).info() == Eigen::Success;
  }



  void
  LatticePreconditioner::solve(const double *const x, double *const y) const
  {
    Eigen::VectorXd       r = Eigen::Map<const Eigen::VectorXd>(x, dofs.size());
    const Eigen::VectorXd of_sides = sides.solve(r(at_sides));
    r -= columns_of_sides * of_sides;
    Eigen::VectorXd at_nodes = Eigen::VectorXd::Zero(n_dofs);
    at_nodes(dofs)           = scale.cwiseProduct(r);
    at_nodes                 = lattice->condense(at_nodes).interior;
    Eigen::Map<Eigen::VectorXd> result(y, dofs.size());
    result = scale.cwiseProduct(Eigen::VectorXd(at_nodes(dofs)));
    result(at_sides) += of_sides;
  }
} // namespace Debond
