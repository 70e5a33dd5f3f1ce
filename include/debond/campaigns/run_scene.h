#pragma once

#include <iosfwd>
#include <memory>
#include <string>

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

  /** What scenes agree in if they can share bodies: what the bodies are, and
   *  where they are when the interface is set up. Empty if the scene shares
   *  them with none. */
  std::string
  what_bodies_depend_on(const Scene &scene);

  /** The bodies of a scene, condensed on what contact reaches at first; none
   *  if that is impossible: then whoever runs the scene meets it again, and
   *  says what is wrong.
   *
   *  The processes that this one starts by fork() inherit them (the pages of
   *  memory are copied when they change), and results are the same to the last
   *  digit. Building takes one thread, as a pool of threads would not survive
   *  fork(). */
  std::shared_ptr<BodyPair>
  condensed_bodies(Scene scene);

  /** Runs a variant of a study in this process, with the bodies that it
   *  inherits or none, from the checkpoint of a run that was ended, if it left
   *  one; @p force: from its beginning. Throws as run_scene(). */
  void
  run_variant(Scene scene, const std::shared_ptr<BodyPair> &bodies, bool force);
} // namespace Debond
