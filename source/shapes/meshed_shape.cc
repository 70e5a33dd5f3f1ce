#include <debond/shapes/body_parameters.h>
#include <debond/shapes/faces_of_mesh.h>
#include <debond/shapes/mesh_builder.h>
#include <debond/shapes/meshed_shape.h>
#include <debond/support/input_error.h>

#include <string>

namespace Debond
{
  std::shared_ptr<const BodyMesh>
  MeshedShape::make_mesh(const BodyParameters &body,
                         const BodyParameters &implant,
                         const std::string    &section) const
  {
    body.check(section);
    const StoredMesh  stored = stored_mesh(body, implant);
    const FileRefusal refuse = [&section](const std::string &why) {
      throw EntryError(section + " / Cells",
                       "no mesh of this shape comes of them: " + why);
    };
    return MeshBuilder(stored, refuse).mesh;
  }



  // Circles are exact, whatever the elements: the face is of the second degree.
  NurbsSurface
  MeshedShape::contact_face(const BodyParameters &body, const Side side) const
  {
    return contact_surface_of(
      *body.mesh, body.contact_surface == SurfaceKind::nurbs ? 2 : 1, side);
  }

  double
  MeshedShape::thickness(const BodyParameters &body) const
  {
    return body.mesh ? body.mesh->box.side_length(2) : body.height;
  }
  double
  MeshedShape::reach(const BodyParameters &body) const
  {
    return 0.5 * width(body, 0);
  }



  void
  MeshedShape::check_cells(const BodyParameters &body,
                           const bool            has_square,
                           const EntryCheck     &refuse)
  {
    refuse_entries_of_lattices(body, "this shape has no such cells", refuse);
    refuse(body.cells[0] < 8 || (has_square && body.cells[0] % 4 != 0),
           "Cells",
           "cells around, radial and along: expected " +
             std::string(has_square ? "8, 12, 16, ... around" :
                                      "at least 8 around"));
  }
} // namespace Debond
