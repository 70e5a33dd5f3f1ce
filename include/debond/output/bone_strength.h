#pragma once

#include <Eigen/Core>

#include <array>

namespace Debond
{
  class Body;

  /** Bone whose principal stresses are beyond its strengths: in tension, and in
   *  compression. */
  struct BeyondStrength
  {
    double volume_mm3 = 0; ///< of both
    /** The stresses that are furthest beyond, over the strengths, where they
     *  are [mm], and what they are [MPa]. */
    std::array<double, 2>          ratio{{0., 0.}}, stress_MPa{{0., 0.}};
    std::array<Eigen::Vector3d, 2> X;
  };

  /** That of the trial state of @p bone at its Gauss points; zero without
   *  strengths, and of rigid bone. Collective. */
  BeyondStrength
  beyond_strength(const Body &bone);
} // namespace Debond
