#ifndef debond_shapes_revolved_mesh_h
#define debond_shapes_revolved_mesh_h

#include <debond/input/input_file.h>
#include <debond/shapes/mesh_file.h>

#include <array>
#include <functional>
#include <memory>
#include <string>

namespace Debond
{
  /** A body around the z axis, between z = -height and z = 0. */
  struct RevolvedBody
  {
    /** A radius [mm] at the height z [mm] and the angle from the x axis [rad].
     */
    using Radius = std::function<double(double z, double angle)>;

    std::array<unsigned int, 3> cells;      ///< around, radial, along
    double                      height = 0; ///< [mm]
    Radius                      inner;      ///< empty: it is solid
    Radius                      outer;
    bool                        contact_is_inner = false;
    /** Whether the contact face consists of circles, which are exact then. */
    bool is_round = true;
    /** Layers of cells from the contact face, as `Layer grading' says. */
    double grading = 1;
    /** What the other parts of the boundary are, as in the files of meshes. */
    std::string opposite, bottom, top;
  };

  /** Its cells, of the second order. The core of a solid one is square, of
   * cells[0] / 4 cells across. */
  std::shared_ptr<const FileMesh>
  mesh_of_revolution(const RevolvedBody &body, const FileRefusal &refuse);
} // namespace Debond
#endif
