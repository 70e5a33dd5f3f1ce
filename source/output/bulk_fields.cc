#include <debond/bulk/body.h>
#include <debond/bulk/cell_shape.h>
#include <debond/bulk/chuck.h>
#include <debond/output/bulk_fields.h>
#include <debond/output/vtu_patches.h>

namespace Debond
{
  namespace
  {
    /** Draws one body. */
    class BulkPatches
    {
    public:
      BulkPatches(const Body &body, const Chuck &chuck, PatchSet<3> &output)
        : mesh(body.mesh())
        , is_implant(mesh.side() == Side::implant)
        , chuck(chuck)
        , v(body.full_displacement())
        , stress(body.vertex_stress(v))
        , output(output)
      {
        // A surface of degree one makes its cells trilinear.
        const unsigned int n_enriched =
          mesh.surface().degree() == 1 ? 1 : n_pieces(mesh.surface(), 24, 2, 8);
        for (const BodyMesh::Cell &cell : mesh.cells())
          draw(cell, cell.enriched ? n_enriched : 1);
      }

    private:
      void
      draw(const BodyMesh::Cell &cell, const unsigned int n)
      {
        output.add_patch(n);
        for (unsigned int k = 0; k <= n; ++k)
          for (unsigned int j = 0; j <= n; ++j)
            for (unsigned int i = 0; i <= n; ++i)
              draw(cell,
                   2. / n * Eigen::Vector3d(i, j, k) - Eigen::Vector3d::Ones());
      }

      void
      draw(const BodyMesh::Cell &cell, const Eigen::Vector3d &point)
      {
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
        const Eigen::Matrix3d Q =
          is_implant ? chuck.rotation() : Eigen::Matrix3d::Identity();

        values.clear();
        append_values(values, is_implant ? chuck.map(X, v_point) - X : v_point);
        append_values(values, v_point);
        append_values(values, (Q * sigma * Q.transpose()).eval());
        values.push_back(von_mises(sigma));
        values.push_back(is_implant ? 1. : 0.);
        output.add_point(X, values);
      }

      const BodyMesh                    &mesh;
      const bool                         is_implant;
      const Chuck                       &chuck;
      const Eigen::VectorXd              v;
      const std::vector<Eigen::Matrix3d> stress;
      PatchSet<3>                       &output;
      std::vector<double>                values;
    };
  } // namespace



  std::string
  bulk_vtu(const std::array<const Body *, 2> &bodies, const Chuck &chuck)
  {
    PatchSet<3> output({{"displacement", FieldSize::vector},
                        {"displacement_in_frame", FieldSize::vector},
                        {"stress_MPa", FieldSize::tensor},
                        {"von_Mises_MPa", FieldSize::scalar},
                        {"body", FieldSize::scalar}});
    for (const Body *const body : bodies)
      BulkPatches(*body, chuck, output);
    return output.vtu();
  }
} // namespace Debond
