#pragma once

#include <debond/bulk/bulk_space.h>
#include <debond/bulk/enriched_cells.h>

/** Forces at all nodes [N] under a displacement whose gradient is the same
 *  everywhere; those inside a body vanish. */
inline Eigen::VectorXd
forces_of_uniform_strain(const Debond::BulkSpace     &mesh,
                         const Debond::EnrichedCells &cells)
{
  Eigen::Matrix3d H;
  H << 2e-3, -1e-3, 3e-3, 4e-3, 1e-3, -2e-3, 1e-3, 5e-3, -3e-3;
  Eigen::VectorXd v(3 * mesh.n_nodes());
  for (unsigned int node = 0; node < mesh.n_nodes(); ++node)
    v.segment<3>(3 * node) = H * mesh.reference_position(node);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(v.size());
  double          energy;
  cells.internal_forces(v, force, energy);
  mesh.condense(force);
  return force;
}
