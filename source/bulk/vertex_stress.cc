#include <debond/bulk/vertex_stress.h>

#include <array>
#include <cmath>

namespace Debond
{
  namespace
  {
    using CellStress = std::array<Eigen::Matrix3d, EnrichedCells::n_q>;

    /** Stress at the Gauss points of a cell. */
    CellStress
    stress_at_gauss_points(const Body            &body,
                           const unsigned int     cell,
                           const Eigen::VectorXd &v)
    {
      double H[EnrichedCells::n_q][3][3];
      body.cells()->displacement_gradients(cell, v, H);
      CellStress stress;
      for (unsigned int q = 0; q < EnrichedCells::n_q; ++q)
        {
          double sigma[3][3];
          if (body.material() == Material::linear)
            body.cells()->material().linear_stress(H[q], sigma);
          else
            body.cells()->material().cauchy_stress(H[q], sigma);
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              stress[q](i, j) = sigma[i][j];
        }
      return stress;
    }



    /** The trilinear function through the values at the Gauss points
     *  +-1/sqrt(3), at the corners +-1. Bit d of either number tells the sign
     *  of coordinate d. */
    CellStress
    extrapolate_to_corners(const CellStress &at_gauss_points)
    {
      const double near = 0.5 * (1. + std::sqrt(3.));
      const double far  = 0.5 * (1. - std::sqrt(3.));
      CellStress   at_corners;
      for (unsigned int corner = 0; corner < 8; ++corner)
        {
          at_corners[corner].setZero();
          for (unsigned int q = 0; q < 8; ++q)
            {
              double weight = 1.;
              for (unsigned int d = 0; d < 3; ++d)
                weight *= ((corner ^ q) >> d & 1) ? far : near;
              at_corners[corner] += weight * at_gauss_points[q];
            }
        }
      return at_corners;
    }
  } // namespace



  std::vector<Eigen::Matrix3d>
  vertex_stress(const Body &body, const Eigen::VectorXd &v)
  {
    const BodyMesh              &mesh = body.mesh();
    std::vector<Eigen::Matrix3d> stress(mesh.n_vertices(),
                                        Eigen::Matrix3d::Zero());
    if (!body.deformable())
      return stress;

    std::vector<unsigned int> n_cells(mesh.n_vertices(), 0);
    for (unsigned int c = 0; c < mesh.cells().size(); ++c)
      {
        const BodyMesh::Cell &cell = mesh.cells()[c];
        const CellStress      corners =
          extrapolate_to_corners(stress_at_gauss_points(body, c, v));
        // The third coordinate of an enriched cell begins at the contact face,
        // which is on top of the bone's cells.
        const unsigned int flip =
          (cell.enriched && mesh.side() == Side::bone) ? 4 : 0;
        for (unsigned int corner = 0; corner < 8; ++corner)
          {
            const unsigned int vertex = cell.vertices[corner ^ flip];
            stress[vertex] += corners[corner];
            ++n_cells[vertex];
          }
      }
    for (unsigned int vertex = 0; vertex < mesh.n_vertices(); ++vertex)
      stress[vertex] /= n_cells[vertex];
    return stress;
  }



  double
  von_mises(const Eigen::Matrix3d &stress)
  {
    const Eigen::Matrix3d deviator =
      stress - stress.trace() / 3. * Eigen::Matrix3d::Identity();
    return std::sqrt(1.5) * deviator.norm();
  }
} // namespace Debond
