#ifndef debond_campaigns_run_scene_h
#define debond_campaigns_run_scene_h

#include <iosfwd>
#include <memory>

namespace Debond
{
  struct BodyPair;
  struct Scene;

  /** Runs a scene with the model that it asks for and writes everything into
   *  its directory. @p bodies: those of the scene if they are built already,
   *  see CoupledSystem; models other than finite elements make no use of them.
   *
   *  Throws InputError, with file and line, if the model does not apply to the
   *  scene; RunError if it cannot be finished: what was written before stays,
   *  and summary.json then says `converged: false` and why; Interrupted if a
   *  signal asks to stop.
   *
   *  With @p plan it prints there what a run would do, and runs nothing. */
  void
  run_scene(const Scene              &scene,
            std::shared_ptr<BodyPair> bodies = nullptr,
            std::ostream             *plan   = nullptr);
} // namespace Debond
#endif
