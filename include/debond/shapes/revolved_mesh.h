#pragma once

#include <debond/shapes/mesh_formats.h>

#include <array>
#include <functional>
#include <string>

namespace Debond
{
  /** A body around the z axis. */
  struct RevolvedBody
  {
    /** A radius [mm] at the height z [mm] and the angle from the x axis [rad].
     */
    using Radius = std::function<double(double z, double angle)>;
    enum class Part
    {
      inner,
      outer,
      bottom
    };

    std::array<unsigned int, 3> cells; ///< around, radial, along
    double                      lowest = 0, height = 0; ///< [mm]
    Radius                      inner;                  ///< empty: it is solid
    Radius                      outer;
    Part                        contact = Part::outer;
    /** Whether its faces consist of circles, which are exact then. */
    bool is_round = true;
    /** Layers of cells from the contact face, and from the ends of a side, as
     *  `Layer grading' says. */
    double grading = 1;
    /** What the parts of the boundary are in the files of meshes, empty: free.
     */
    std::string inner_name, outer_name, bottom_name, top_name;
  };

  /** Its cells. The core of a solid one is square, of cells[0] / 4 cells
   *  across. */
  StoredMesh
  mesh_of_revolution(const RevolvedBody &body);
} // namespace Debond
