#ifndef debond_models_memory_estimate_h
#define debond_models_memory_estimate_h

#include <debond/support/input_error.h>

namespace Debond
{
  struct Scene;

  /** What to say when an allocation has failed. */
  extern const char *const out_of_memory;

  /** A scene whose bodies do not fit into the memory that there is. */
  class NotEnoughMemory : public EntryError
  {
  public:
    using EntryError::EntryError;
  };

  /**
   * Memory that a finite element run of a scene needs at its peak [MB], of
   * several ranks each, from the numbers of its cells, quadrature points and
   * unknowns alone: nothing is built. Measured peaks of linear and Neo-Hookean
   * bodies of flat and of thick meshes are within a factor of 2 (test
   * `memory_estimate`).
   */
  double
  estimated_memory_MB(const Scene &scene);

  /** Throws NotEnoughMemory, which names the entry that needs most, if the
   *  estimate is more than what is available. @p has_bodies: those of the scene
   *  are in the memory already. Collective. */
  void
  require_memory(const Scene &scene, bool has_bodies);
} // namespace Debond
#endif
