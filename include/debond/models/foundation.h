#pragma once

#include <debond/scene/scene.h>

#include <memory>

namespace Debond
{
  struct BodyPair;

  /** Stiffness of interface and bodies in series, lumped into the interface of
   *  a disk [MPa/mm]. */
  struct FoundationStiffness
  {
    double normal    = 0; ///< mean pressure per depth of push-in
    double torsional = 0; ///< lambda, with a torque pi/2 R^4 lambda theta
  };

  /**
   * One linear solution with the bodies of @p scene, all of whose interface
   * sticks: pressed by a millionth of its radius, then turned by as little. The
   * bodies keep mesh and elasticity, rigid ones stay rigid. @p bodies: those of
   * an earlier call with a scene that has the same ones, or null; here they are
   * then. Throws InputError if the bodies do not touch all over then.
   */
  FoundationStiffness
  foundation_stiffness(const Scene               &scene,
                       std::shared_ptr<BodyPair> *bodies = nullptr);
} // namespace Debond
