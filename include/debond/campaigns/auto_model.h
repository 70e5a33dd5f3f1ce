#ifndef debond_campaigns_auto_model_h
#define debond_campaigns_auto_model_h

#include <iosfwd>

namespace Debond
{
  struct Scene;

  /**
   * `Model = auto`: runs the models that a ModelChoice tries. Results of the
   * answer are then in the scene's directory, those of every model in
   * DIR/rung-1 and so on, and auto.csv lists them. Throws RunError if the
   * tolerance was not reached; the answer is then the best model, and
   * summary.json says so. Throws what ModelChoice throws.
   */
  void
  run_auto(const Scene &scene);

  /** Prints which models it would try. */
  void
  check_auto(const Scene &scene, std::ostream &out);
} // namespace Debond
#endif
