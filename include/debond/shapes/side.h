#pragma once

#include <array>

namespace Debond
{
  namespace Names
  {
    /** In a class of its own: found as Side::bone and Side::implant only. */
    struct Sides
    {
      enum Side : unsigned int
      {
        bone,
        implant
      };
    };
  } // namespace Names

  /** The two bodies, and the two sides of the interface between them; an index
   *  of whatever there is two of. */
  using Side = Names::Sides::Side;

  constexpr std::array<Side, 2> both_sides{{Side::bone, Side::implant}};

  constexpr Side
  other(const Side side)
  {
    return side == Side::bone ? Side::implant : Side::bone;
  }

  /** "bone" or "implant", for messages. */
  constexpr const char *
  name_of(const Side side)
  {
    return side == Side::bone ? "bone" : "implant";
  }
} // namespace Debond
