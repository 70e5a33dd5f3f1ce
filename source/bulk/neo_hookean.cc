#include <debond/bulk/neo_hookean.h>

namespace Debond
{
  namespace
  {
    Eigen::Matrix3d
    as_matrix(const double (&H)[3][3])
    {
      return Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(&H[0][0]);
    }
  } // namespace



  // sigma = (G (b - I) + Lambda ln J I) / J with b - I = H + H^T + H H^T
  Eigen::Matrix3d
  NeoHookean::cauchy_stress(const double (&H)[3][3]) const
  {
    const double          j = volume_change(H);
    const Eigen::Matrix3d h = as_matrix(H);
    return (G * (h + h.transpose() + h * h.transpose()) +
            Lambda * std::log1p(j) * Eigen::Matrix3d::Identity()) /
           (1. + j);
  }



  Eigen::Matrix3d
  NeoHookean::linear_stress(const double (&H)[3][3]) const
  {
    const Eigen::Matrix3d h = as_matrix(H);
    return G * (h + h.transpose()) +
           Lambda * h.trace() * Eigen::Matrix3d::Identity();
  }
} // namespace Debond
