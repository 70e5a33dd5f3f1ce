#include <debond/geometry/surface_geometry.h>

namespace Debond
{
  void
  contract(const SurfaceBasis &basis,
           const ControlNet   &control_points,
           const bool          second_derivatives,
           SurfaceGeometry    &geometry)
  {
    const double   *net = control_points.data();
    Eigen::Vector3d y = Eigen::Vector3d::Zero(), a1 = y, a2 = y;
    for (unsigned int k = 0; k < basis.size; ++k)
      {
        const Eigen::Map<const Eigen::Vector3d> p(net +
                                                  3 * basis.control_point[k]);
        y += basis.N[k] * p;
        a1 += basis.N_1[k] * p;
        a2 += basis.N_2[k] * p;
      }
    geometry.y  = y;
    geometry.a1 = a1;
    geometry.a2 = a2;
    if (!second_derivatives)
      return;

    Eigen::Vector3d a11 = Eigen::Vector3d::Zero(), a12 = a11, a22 = a11;
    for (unsigned int k = 0; k < basis.size; ++k)
      {
        const Eigen::Map<const Eigen::Vector3d> p(net +
                                                  3 * basis.control_point[k]);
        a11 += basis.N_11[k] * p;
        a12 += basis.N_12[k] * p;
        a22 += basis.N_22[k] * p;
      }
    geometry.a11 = a11;
    geometry.a12 = a12;
    geometry.a22 = a22;
  }



  void
  spread(const SurfaceBasis    &basis,
         const Eigen::Vector3d &value,
         ControlNet            &control_points)
  {
    for (unsigned int a = 0; a < basis.size; ++a)
      control_points.col(basis.control_point[a]) += basis.N[a] * value;
  }
} // namespace Debond
