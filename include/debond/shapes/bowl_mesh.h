#pragma once

#include <debond/shapes/mesh_formats.h>

#include <array>
#include <string>

namespace Debond
{
  /** The inner or the outer face of a bowl whose rim is at z = 0: a part of a
   *  sphere, or the bottom and the sides of a box. Places on it are those of
   *  half a cube, x and y from -1 to 1, z from -1 at the bottom to 0 at the
   * rim.
   */
  struct BowlFace
  {
    double                radius = 0;     ///< of a sphere [mm]; 0: it is a box
    double                centre = 0;     ///< its height [mm]
    std::array<double, 3> box{{0, 0, 0}}; ///< edge lengths [mm]

    dealii::Point<3>
    at(const dealii::Point<3> &place) const;
    /** The point between others, from their mean. */
    dealii::Point<3>
    between(const dealii::Point<3> &mean, bool is_at_rim) const;
  };

  /** What is between two such faces, or within the outer one. The grid on them
   *  is that of half a cube: no pole, and no cell that is slimmer than others.
   */
  struct Bowl
  {
    std::array<unsigned int, 3> cells; ///< around, radial, along the sides
    BowlFace inner, outer;             ///< a sphere where the contact face is
    bool     is_solid         = false; ///< `inner' is the box of its core
    bool     contact_is_inner = false;
    /** Layers of cells from the contact face, as `Layer grading' says. */
    double grading = 1;
    /** What the other parts of the boundary are in the files of meshes, empty:
     *  free. The sides of the opposite face are those across x and y. */
    std::string                rim, bottom;
    std::array<std::string, 2> sides;
  };

  StoredMesh
  mesh_of_bowl(const Bowl &bowl);
} // namespace Debond
