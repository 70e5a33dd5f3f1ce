#ifndef debond_models_foundation_h
#define debond_models_foundation_h

#include <debond/scene/scene.h>

#include <vector>

namespace Debond
{
  /** Stiffness of interface and bodies in series, lumped into the interface of
   *  a disk [MPa/mm]. */
  struct FoundationStiffness
  {
    double normal    = 0; ///< mean pressure per depth of push-in
    double torsional = 0; ///< lambda, with a torque pi/2 R^4 lambda theta

    /** What the solution says of one point of the interface, where a foundation
     *  has the same everywhere. */
    struct Point
    {
      double radius   = 0; ///< [mm]
      double area     = 0; ///< [mm^2]
      double phi_0    = 0; ///< initial bonding
      double pressure = 0; ///< over the mean pressure
      /** Traction about the axis per path radius * angle [MPa/mm]. */
      double stiffness = 0;
    };
    std::vector<Point> points;
  };

  /**
   * One linear solution with the bodies of @p scene, all of whose interface
   * sticks: pressed by a millionth of its radius, then turned by as little. The
   * bodies keep mesh and elasticity, rigid ones stay rigid. Throws InputError
   * if the bodies do not touch all over then.
   */
  FoundationStiffness
  foundation_stiffness(const Scene &scene);
} // namespace Debond
#endif
