#include <debond/bulk/body.h>
#include <debond/bulk/cell_shape.h>
#include <debond/bulk/chuck.h>
#include <debond/output/field_output.h>
#include <debond/output/vtu_patches.h>

namespace Debond
{
  namespace
  {
    /** The patches of one body: a cell each, cells at the curved surface finely
     *  subdivided. */
    void
    draw(const Body &body, const Chuck &chuck, PatchSet<3> &output)
    {
      const BodyMesh       &mesh       = body.mesh();
      const bool            is_implant = mesh.side() == Side::implant;
      const Eigen::VectorXd v          = body.full_displacement();
      const auto            stress     = body.vertex_stress(v);
      Eigen::Matrix3d       Q          = Eigen::Matrix3d::Identity();
      if (is_implant)
        Q = chuck.rotation();
      // A surface of degree one makes its cells trilinear.
      const unsigned int n_enriched =
        mesh.surface().degree() == 1 ? 1 : n_pieces(mesh.surface(), 24, 2, 8);
      for (const BodyMesh::Cell &cell : mesh.cells())
        output.add_patch(
          cell.enriched ? n_enriched : 1,
          [&](const Eigen::Vector3d &point, std::vector<double> &values) {
            const std::vector<double> N = shape_functions(mesh, cell, point).N;
            Eigen::Vector3d           X = Eigen::Vector3d::Zero(), v_point = X;
            for (unsigned int a = 0; a < N.size(); ++a)
              {
                X += N[a] * mesh.reference_position(cell.nodes[a]);
                v_point += N[a] * v.segment<3>(3 * cell.nodes[a]);
              }
            const auto      corners = trilinear(point);
            Eigen::Matrix3d sigma   = Eigen::Matrix3d::Zero();
            for (unsigned int a = 0; a < n_corners; ++a)
              sigma += corners[a] * stress[cell.vertices[a]];

            append_values(values,
                          is_implant ? chuck.map(X, v_point) - X : v_point);
            append_values(values, v_point);
            append_values(values, (Q * sigma * Q.transpose()).eval());
            values.push_back(von_mises(sigma));
            values.push_back(is_implant ? 1. : 0.);
            return X;
          });
    }
  } // namespace



  std::string
  bulk_vtu(const std::array<const Body *, 2> &bodies, const Chuck &chuck)
  {
    PatchSet<3> output({{"displacement", 3},
                        {"displacement_in_frame", 3},
                        {"stress_MPa", 9},
                        {"von_Mises_MPa", 1},
                        {"body", 1}});
    for (const Body *const body : bodies)
      draw(*body, chuck, output);
    return output.vtu();
  }
} // namespace Debond
