#include <debond/shapes/body_geometry.h>
#include <debond/shapes/body_parameters.h>
#include <debond/shapes/faces_of_mesh.h>
#include <debond/shapes/mesh_builder.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <string>

namespace Debond
{
  namespace
  {
    /** The hexahedra of a file, where the file has them. */
    class MeshShape : public BodyGeometry
    {
    public:
      std::string
      name() const override
      {
        return "file";
      }
      std::string
      description() const override
      {
        return "the hexahedra of a Mesh file";
      }
      bool
      is_for_bone() const override
      {
        return true;
      }
      bool
      is_lattice() const override
      {
        return false;
      }
      std::vector<std::string>
      entries() const override
      {
        return {"Mesh file"};
      }

      void
      check(const BodyParameters &body, const EntryCheck &refuse) const override
      {
        const std::string of_file = "the cells are those of a file";
        refuse_entries_of_lattices(body, of_file, refuse);
        refuse(body.layer_grading != 1.,
               "Layer grading",
               of_file + ": expected 1");
        refuse(body.mesh && body.mesh->order == 2 &&
                 body.element == ElementKind::trilinear,
               "Element",
               "the cells of the file are of the second order: expected "
               "quadratic");
      }

      double
      width(const BodyParameters &body,
            const unsigned int    direction) const override
      {
        return body.mesh->box_of_face.side_length(direction);
      }
      // how far it reaches from z = 0
      double
      thickness(const BodyParameters &body) const override
      {
        const auto &[lower, upper] = body.mesh->box.get_boundary_points();
        return std::max(-lower[2], upper[2]);
      }
      double
      chuck_height(const BodyParameters &body) const override
      {
        return body.mesh->box.get_boundary_points().second[2];
      }

      std::shared_ptr<const BodyMesh>
      make_mesh(const BodyParameters &body,
                const BodyParameters &,
                const std::string &section) const override
      {
        if (body.mesh_file.empty())
          throw EntryError(section + " / Shape",
                           "it needs the name of a file: " + section +
                             " / Mesh file");
        return read_mesh_file(body.mesh_file, section + " / Mesh file");
      }

      NurbsSurface
      contact_face(const BodyParameters &body, const Side side) const override
      {
        const unsigned int degree =
          body.element == ElementKind::quadratic ? 2 : 1;
        return contact_surface_of(*body.mesh, degree, side);
      }
    };
  } // namespace



  const BodyGeometry &
  mesh_geometry()
  {
    static const MeshShape shape;
    return shape;
  }
} // namespace Debond
