#include <debond/geometry/nurbs_surface.h>
#include <debond/shapes/body_parameters.h>
#include <debond/shapes/faces_of_mesh.h>
#include <debond/shapes/mesh_builder.h>
#include <debond/support/input_error.h>

#include <algorithm>
#include <cmath>

// Bodies whose cells are hexahedra of their own, of a file or of their shape.
namespace Debond
{
  namespace
  {
    // Nothing is known of it before it is read.
    BodyGeometry
    geometry_of_file(const BodyParameters &body)
    {
      BodyGeometry result;
      if (!body.mesh)
        return result;
      const auto &[lower, upper] = body.mesh->box.get_boundary_points();
      result.width               = {{body.mesh->box_of_face.side_length(0),
                                     body.mesh->box_of_face.side_length(1)}};
      result.reach        = 0.5 * std::hypot(result.width[0], result.width[1]);
      result.thickness    = std::max(-lower[2], upper[2]);
      result.chuck_height = upper[2];
      return result;
    }

    void
    check_file(const BodyParameters &body, const EntryCheck &refuse)
    {
      const std::string of_file = "the cells are those of a file";
      refuse_entries_of_lattices(body, of_file, refuse);
      refuse(body.layer_grading != 1.,
             "Layer grading",
             of_file + ": expected 1");
      refuse(body.mesh && !body.mesh->has_cells_of_corners &&
               body.element == ElementKind::trilinear,
             "Element",
             "without the middles of edges cells of the file are tangled: "
             "expected quadratic");
    }
  } // namespace



  std::vector<ShapeRow>
  file_shapes()
  {
    return {{"file",
             "the cells of a Mesh file",
             true,
             true,
             {"Mesh file", "Coarser mesh file"},
             geometry_of_file,
             check_file,
             nullptr}};
  }



  void
  BodyParameters::make_mesh(const std::string    &section,
                            const BodyParameters &implant)
  {
    mesh.reset();
    if (shape == BodyShape::file && mesh_file.empty())
      throw EntryError(section + " / Shape",
                       "it needs the name of a file: " + section +
                         " / Mesh file");
    if (shape == BodyShape::file)
      mesh = read_mesh_file(mesh_file, section + " / Mesh file");
    if (shape_row().cells == nullptr || is_fitted())
      return;
    check(section);
    mesh = MeshBuilder(shape_row().cells(*this, implant),
                       [&section](const std::string &why) {
                         throw EntryError(section + " / Cells",
                                          "no mesh of this shape comes of "
                                          "them: " +
                                            why);
                       })
             .mesh;
  }



  bool
  BodyParameters::has_tetrahedra() const
  {
    return element == ElementKind::quadratic && mesh && mesh->has_tetrahedra();
  }



  bool
  BodyParameters::is_in_socket() const
  {
    if (!mesh || shape != BodyShape::file)
      return geometry().is_in_bore();
    const dealii::BoundingBox<3> &face = mesh->box_of_face;
    return face.side_length(2) >
           0.25 * std::min(face.side_length(0), face.side_length(1));
  }



  // Circles of shapes are exact, whatever the elements: their faces are of the
  // second degree. Those of files are as their elements.
  NurbsSurface
  make_contact_surface(const BodyParameters &body, const Side side)
  {
    const bool is_smooth = body.contact_surface == SurfaceKind::nurbs;
    if (body.mesh)
      {
        const bool   is_of_file = body.shape == BodyShape::file;
        NurbsSurface face       = contact_surface_of(
          *body.mesh,
          is_smooth && (!is_of_file || body.element == ElementKind::quadratic) ?
                  2 :
                  1,
          side);
        // where a file is curved, trilinear cells have the same edges
        if (is_of_file)
          face.cut_at_edges(largest_smooth_angle,
                            face.degree() < body.mesh->order ?
                              contact_surface_of(*body.mesh, 2, side) :
                              face);
        return face;
      }
    const NurbsSurface face = body.shape_row().contact_face(body);
    return is_smooth ? face : face.bilinear_interpolant();
  }
} // namespace Debond
