#include <debond/shapes/body_geometry.h>
#include <debond/shapes/body_parameters.h>
#include <debond/shapes/faces_of_mesh.h>

#include <algorithm>
#include <tuple>

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
      std::vector<std::string>
      entries() const override
      {
        return {"Mesh file"};
      }

      void
      check(const BodyParameters &body, const EntryCheck &refuse) const override
      {
        for (const auto &[is_set, entry, expected] :
             {std::make_tuple(body.element == ElementKind::spline,
                              "Element",
                              "trilinear or quadratic"),
              std::make_tuple(body.coarser_below, "Coarser below", "false"),
              std::make_tuple(body.cells_under_implant > 0,
                              "Cells under implant",
                              "0"),
              std::make_tuple(body.lateral_grading != 1.,
                              "Lateral grading",
                              "1"),
              std::make_tuple(body.layer_grading != 1., "Layer grading", "1"),
              std::make_tuple(body.bulk_solver == BulkSolver::lattice,
                              "Bulk solver",
                              "auto, direct or multigrid")})
          refuse(is_set,
                 entry,
                 std::string("the cells are those of a file: expected ") +
                   expected);
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
