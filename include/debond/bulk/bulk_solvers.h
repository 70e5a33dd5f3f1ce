#pragma once

#include <debond/bulk/condensing_bulk.h>
#include <debond/bulk/whole_bulk.h>

#include <memory>

namespace Debond
{
  /** NURBS-enriched hexahedra or splines whose stiffness is factorised by
   *  sparse Cholesky and condensed on the degrees of freedom that contact can
   *  reach. A linear body uses it as a spring of many degrees of freedom, a
   *  Neo-Hookean one as an approximate inverse beside its true internal
   *  forces. */
  std::unique_ptr<CondensingBulk>
  make_condensed_bulk(const BulkSpace &mesh, EnrichedCells &&cells);

  /** A bone of equal splines across (BodyParameters::has_equal_splines), which
   *  sines and cosines make diagonal. Its unknowns are all control points of
   *  the contact face but those at the sides, which contact must not reach:
   *  set_contact() throws EntryError. Layers of @p cells may differ in their
   *  modulus. */
  std::unique_ptr<CondensingBulk>
  make_lattice_bulk(const BulkSpace &mesh, EnrichedCells &&cells);

  /** A WholeBulk with algebraic multigrid, on all ranks. */
  std::unique_ptr<WholeBulk>
  make_multigrid_bulk(const BulkSpace &mesh, EnrichedCells &&cells);

  /** The bulk of a body with the given @p mesh, which must outlive it; direct
   *  unless the mesh asks for another solver (ModelParameters says whether it
   *  may). */
  std::unique_ptr<Bulk>
  make_bulk(const BulkSpace &mesh);
} // namespace Debond
