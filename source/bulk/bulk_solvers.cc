#include <debond/bulk/bulk_solvers.h>

namespace Debond
{
  // G and Lambda [MPa] from E and nu by Eq. (2). Other elements, or another
  // solver, get their place here.
  std::unique_ptr<Bulk>
  make_bulk(const BulkSpace &mesh)
  {
    const BodyParameters &body = mesh.parameters();
    const NeoHookean      material =
      NeoHookean::from_young(body.young_modulus, body.poisson_ratio);
    switch (body.bulk_solver)
      {
        case BulkSolver::lattice:
          return make_lattice_bulk(mesh, EnrichedCells(mesh, material));
        case BulkSolver::multigrid:
          return make_multigrid_bulk(mesh, material);
        default:
          return make_condensed_bulk(mesh, material);
      }
  }
} // namespace Debond
