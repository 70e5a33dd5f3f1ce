#include <debond/bulk/body.h>
#include <debond/bulk/chuck.h>
#include <debond/bulk/vertex_stress.h>
#include <debond/output/bulk_fields.h>
#include <debond/output/vtu_patches.h>

namespace Debond
{
  namespace
  {
    /**
     * Values of the shape functions of a cell, in the order of its nodes, at a
     * point of [0,1]^3 in the order of its *vertices* (so that all cells are
     * right-handed). No derivatives: they do not exist at the disk's corners.
     */
    std::vector<double>
    shape_values(const BodyMesh        &mesh,
                 const BodyMesh::Cell  &cell,
                 const Eigen::Vector3d &point)
    {
      std::vector<double> N;
      const auto          L     = bilinear(point[0], point[1]);
      const double        upper = point[2], lower = 1. - point[2];
      if (!cell.enriched)
        {
          for (const double z : {lower, upper})
            for (const double value : L)
              N.push_back(z * value);
          return N;
        }
      const auto bounds = mesh.surface().element_bounds(cell.surface_element);
      const Eigen::Vector2d xi = between(bounds, point[0], point[1]);
      SurfaceBasis          basis;
      mesh.surface().evaluate_in_element(cell.surface_element,
                                         xi,
                                         basis,
                                         false);
      // the contact face is on top of the bone, at the implant's bottom
      const bool on_top = mesh.side() == Side::bone;
      for (unsigned int a = 0; a < basis.size; ++a)
        N.push_back((on_top ? upper : lower) * basis.N[a]);
      for (const double value : L)
        N.push_back((on_top ? lower : upper) * value);
      return N;
    }



    /** Draws one body. */
    class BulkPatches
    {
    public:
      BulkPatches(Body &body, const Chuck &chuck, PatchSet<3> &output)
        : mesh(body.mesh())
        , is_implant(mesh.side() == Side::implant)
        , chuck(chuck)
        , v(body.full_displacement())
        , stress(vertex_stress(body, v))
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
              draw(cell, Eigen::Vector3d(i, j, k) / n);
      }

      void
      draw(const BodyMesh::Cell &cell, const Eigen::Vector3d &point)
      {
        const std::vector<double> N = shape_values(mesh, cell, point);
        Eigen::Vector3d           X = Eigen::Vector3d::Zero(), v_point = X;
        for (unsigned int a = 0; a < N.size(); ++a)
          {
            X += N[a] * mesh.reference_position(cell.nodes[a]);
            v_point += N[a] * v.segment<3>(3 * cell.nodes[a]);
          }
        const auto      L     = bilinear(point[0], point[1]);
        Eigen::Matrix3d sigma = Eigen::Matrix3d::Zero();
        for (unsigned int a = 0; a < 8; ++a)
          sigma += (a < 4 ? 1. - point[2] : point[2]) * L[a % 4] *
                   stress[cell.vertices[a]];
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
  bulk_vtu(const std::array<Body *, 2> &bodies, const Chuck &chuck)
  {
    PatchSet<3> output({{"displacement", FieldSize::vector},
                        {"displacement_in_frame", FieldSize::vector},
                        {"stress_MPa", FieldSize::tensor},
                        {"von_Mises_MPa", FieldSize::scalar},
                        {"body", FieldSize::scalar}});
    for (Body *const body : bodies)
      BulkPatches(*body, chuck, output);
    return output.vtu();
  }
} // namespace Debond
