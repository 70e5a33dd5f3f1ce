#ifndef debond_system_bulk_memory_h
#define debond_system_bulk_memory_h

#include <debond/system/load_step_parameters.h>

#include <array>

namespace Debond
{
  /** Unknowns of a body on a lattice, if it is not rigid and none of its cells
   *  are coarser below; of any other about. */
  double
  n_unknowns_of(const BodyParameters &body);

  /** Bytes that a body takes on a rank without dense matrices: triangulation,
   *  shape functions and sparse matrices, the text of VTU files if it @p draws
   *  any (measured), and the sparse part of its factor, or multigrid.
   *  @p n_condensed: its unknowns that contact can reach, if it is condensed on
   *  them. */
  double
  bytes_of_body(const ModelParameters &model,
                Side                   side,
                BulkSolver             solver,
                bool                   draws,
                double                &n_condensed);

  /** Bytes of dense matrices that go with the bone and with the implant if so
   *  many of their unknowns are condensed on. */
  std::array<double, 2>
  bytes_of_matrices(const ModelParameters &model,
                    double                 n_bone,
                    double                 n_implant);
} // namespace Debond
#endif
