#ifndef debond_bulk_vertex_stress_h
#define debond_bulk_vertex_stress_h

#include <debond/bulk/body.h>

#include <Eigen/Core>

#include <vector>

namespace Debond
{
  /**
   * Cauchy stress at the mesh vertices of a body [MPa], in the body's frame and
   * in the numbering of the vertex nodes, for pictures: computed at the 2x2x2
   * Gauss points, where it is most accurate, extrapolated trilinearly to the
   * corners of each cell and averaged there over the cells of the body.
   *
   * Nothing is differentiated at the corners: those of the disk are singular.
   *
   * @p v: Body::full_displacement() [mm]. Zero for a rigid body.
   */
  std::vector<Eigen::Matrix3d>
  vertex_stress(const Body &body, const Eigen::VectorXd &v);

  /** Equivalent stress of von Mises [MPa]. */
  double
  von_mises(const Eigen::Matrix3d &stress);
} // namespace Debond
#endif
