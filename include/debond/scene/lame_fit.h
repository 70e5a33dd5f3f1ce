#pragma once

#include <optional>

namespace Debond
{
  struct Scene;

  /** A press fit by Lame: half the interference is taken up by the interface
   *  and by both bodies in series. */
  struct LameFit
  {
    double half_interference; ///< at the last time [mm]
    /** Compliances [mm/MPa] of the interface, and of both bodies. */
    double interface, bodies;
    double area; ///< of the contact face [mm^2]
    double arm;  ///< mean distance of the face from the axis [mm]
    /** Relative error of the compliance of the bodies: how far their ends are
     *  from what Lame's solutions take them for. More than 1 where that is not
     *  known. */
    double error;
    /** The interference over time, or what lies around the implant along it. */
    bool changes;

    /** [MPa] */
    double
    pressure() const
    {
      return half_interference / (interface + bodies);
    }
  };

  /** That of a pin in a sleeve, or of half a sphere in a shell, whose bone is
   *  the same everywhere; nothing of others, or without an interference. */
  std::optional<LameFit>
  lame_fit(const Scene &scene);
} // namespace Debond
