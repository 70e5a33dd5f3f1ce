#pragma once

#include <debond/shapes/body_parameters.h>
#include <debond/support/input_error.h>

namespace Debond
{
  struct ModelParameters;

  /** Message after an allocation that has failed. */
  extern const char *const out_of_memory;

  /** A scene whose bodies do not fit into the memory that there is. */
  struct NotEnoughMemory : EntryError
  {
    using EntryError::EntryError;
  };

  /** Unknowns of a body on a lattice, if it is not rigid and none of its cells
   *  are coarser below; of any other about. */
  double
  n_unknowns_of(const BodyParameters &body);
  /** The same of both bodies, a rigid one without any. */
  double
  n_unknowns_of(const ModelParameters &model);

  /**
   * Memory that a finite element run needs at its peak [GB], of several ranks
   * each, from the numbers of its cells, quadrature points and unknowns alone:
   * nothing is built. Measured peaks of linear and Neo-Hookean bodies of flat
   * and of thick meshes are within a factor of 2 (test `memory_estimate`).
   */
  struct MemoryEstimate
  {
    /** With this @p solver of the bone; whether it @p draws fields. */
    MemoryEstimate(const ModelParameters &model, BulkSolver solver, bool draws);

    double bone, implant, points, total;
  };

  /** Throws NotEnoughMemory, which names the entry that needs most, if the
   *  estimate is more than what is available. @p has_bodies: those of the scene
   *  are in the memory already. Collective. */
  void
  require_memory(const ModelParameters &model, bool draws, bool has_bodies);
} // namespace Debond
