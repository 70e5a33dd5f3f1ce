#include <debond/bulk/bulk_solvers.h>
#include <debond/bulk/neo_hookean.h>
#include <debond/support/ranks.h>

#include <optional>
#include <utility>

namespace Debond
{
  namespace
  {
    /** Material of Bone / Material and Implant / Material; `linear' is the
     *  Neo-Hookean one at rest. Another material has its place here. */
    HyperelasticMaterial
    make_material(const BodyParameters &body)
    {
      return NeoHookean::from_young(body.young_modulus, body.poisson_ratio);
    }
  } // namespace



  // A modulus that makes no sense in the cells of one rank is told to all.
  std::unique_ptr<Bulk>
  make_bulk(const BulkSpace &mesh)
  {
    std::optional<EnrichedCells> cells;
    Ranks::in_agreement(
      [&] { cells.emplace(mesh, make_material(mesh.parameters())); });
    switch (mesh.parameters().bulk_solver)
      {
        case BulkSolver::lattice:
          return make_lattice_bulk(mesh, std::move(*cells));
        case BulkSolver::multigrid:
          return make_multigrid_bulk(mesh, std::move(*cells));
        default:
          return make_condensed_bulk(mesh, std::move(*cells));
      }
  }
} // namespace Debond
