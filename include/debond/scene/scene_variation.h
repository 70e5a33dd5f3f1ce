#ifndef debond_scene_scene_variation_h
#define debond_scene_scene_variation_h

#include <debond/scene/scene.h>

#include <string>
#include <vector>

namespace Debond
{
  /** How a scene changes with a parameter p: the scene at p + h and p - h. What
   *  the data of the model (friction law, penalties, moduli, bonding, motion of
   *  the chuck) change with p is the difference of the two; what the solution
   *  does follows from exact differentiation. */
  struct SceneVariation
  {
    std::string name; ///< of the parameter, for columns of files
    Scene       plus, minus;
    double      width = 0; ///< 2 h, in the unit of the parameter
  };

  /** Why the solution cannot be differentiated by it exactly ("Implant / Radius
   *  changes, which ..."); empty: it can. */
  std::string
  why_not_differentiable(const Scene &scene, const SceneVariation &variation);

  /** By the entries of `Output / Sensitivities`: numbers by themselves, a
   *  `Value` of the chuck by a factor, which is 1. Throws EntryError. */
  std::vector<SceneVariation>
  variations_of(const Scene &scene);

  /** Refuses sensitivities that cannot be had. Throws EntryError. */
  void
  check_sensitivities(const Scene &scene);
} // namespace Debond
#endif
