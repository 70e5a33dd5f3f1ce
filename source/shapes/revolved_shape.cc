#include <debond/shapes/body_parameters.h>
#include <debond/shapes/faces_of_mesh.h>
#include <debond/shapes/revolved_shape.h>
#include <debond/support/input_error.h>

#include <string>

namespace Debond
{
  std::shared_ptr<const FileMesh>
  RevolvedShape::make_mesh(const BodyParameters &body,
                           const BodyParameters &implant,
                           const std::string    &section) const
  {
    body.check(section);
    RevolvedBody result = revolved(body, implant);
    result.cells        = body.cells;
    result.grading      = body.layer_grading;
    return mesh_of_revolution(result, [&section](const std::string &why) {
      throw EntryError(section + " / Cells",
                       "no mesh of this shape comes of them: " + why);
    });
  }



  // Circles are exact, whatever the elements: the face is of the second degree.
  NurbsSurface
  RevolvedShape::contact_face(const BodyParameters &body, const Side side) const
  {
    return contact_surface_of(
      *body.mesh, body.contact_surface == SurfaceKind::nurbs ? 2 : 1, side);
  }

  double
  RevolvedShape::thickness(const BodyParameters &body) const
  {
    return body.mesh ? body.mesh->box.side_length(2) : body.height;
  }
  double
  RevolvedShape::reach(const BodyParameters &body) const
  {
    return 0.5 * width(body, 0);
  }



  void
  RevolvedShape::check_cells(const BodyParameters &body,
                             const bool            is_solid,
                             const EntryCheck     &refuse)
  {
    refuse_entries_of_lattices(body, "this shape has no such cells", refuse);
    refuse(body.cells[0] < 3 || (is_solid && body.cells[0] % 4 != 0),
           "Cells",
           "cells around, radial and along: expected " +
             std::string(is_solid ? "4, 8, 12, ... around a solid body" :
                                    "at least 3 around"));
  }
} // namespace Debond
