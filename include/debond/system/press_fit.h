#pragma once

#include <debond/geometry/nurbs_surface.h>
#include <debond/input/expression_parser.h>

namespace Debond
{
  struct InterfaceParameters;
  struct BodyParameters;

  /** An implant that is thicker than the bore that it is in, see Interface /
   *  Interference: its contact face stands out by half of that, on a body that
   *  is not strained by it. */
  class PressFit
  {
  public:
    /** @p face: of the implant, as thick as its bore. */
    PressFit(const InterfaceParameters &interface,
             const BodyParameters      &implant,
             const NurbsSurface        &face);

    /** Takes that of a @p time; nothing is accepted yet. */
    void
    set(double time);
    void
    rollback()
    {
      half = accepted_half;
    }
    /** @p forces: on the control points, in the frame of the implant [N]. */
    void
    commit(const ControlNet &forces);

    bool
    is_none() const
    {
      return outwards.cols() == 0;
    }
    /** Of the control points, in the frame of the implant [mm]. */
    ControlNet
    offset() const
    {
      return half * outwards;
    }
    TimeFunction interference; ///< [mm], null where there is none
    /** Work that thickening has put in up to the accepted state [N mm], a
     *  trapezoid, and the bound of its error. */
    double work = 0., bound = 0.;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &half &accepted_half &accepted_force &work &bound;
    }

  private:
    ControlNet outwards; ///< per length that the face is to stand out
    double     half = 0, accepted_half = 0; ///< [mm]
    double     accepted_force = 0;          ///< conjugate to `half' [N]
  };
} // namespace Debond
