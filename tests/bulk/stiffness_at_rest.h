#pragma once

#include <debond/bulk/enriched_cells.h>
#include <debond/bulk/neo_hookean.h>

/** K at rest over all degrees of freedom of a body, supports not heeded. */
inline Eigen::MatrixXd
stiffness_at_rest(const Debond::BulkSpace &mesh)
{
  const Debond::EnrichedCells cells(
    mesh,
    Debond::NeoHookean::from_young(mesh.parameters().young_modulus,
                                   mesh.parameters().poisson_ratio));
  const unsigned int n = 3 * mesh.n_nodes();
  Eigen::MatrixXd    K = Eigen::MatrixXd::Zero(n, n), K_cell;
  for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
    {
      cells.tangent(cell, Eigen::VectorXd::Zero(n), K_cell);
      for (unsigned int i = 0; i < K_cell.rows(); ++i)
        for (unsigned int j = 0; j < K_cell.cols(); ++j)
          K(3 * cells.nodes(cell)[i / 3] + i % 3,
            3 * cells.nodes(cell)[j / 3] + j % 3) += K_cell(i, j);
    }
  if (!mesh.cells_have_followers())
    return K;
  // motions of which hanging nodes are a part
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(K.rows(), K.cols());
  for (unsigned int dof = 0; dof < T.cols(); ++dof)
    {
      Eigen::VectorXd motion = T.col(dof);
      mesh.distribute(motion);
      T.col(dof) = motion;
    }
  return T.transpose() * K * T;
}
