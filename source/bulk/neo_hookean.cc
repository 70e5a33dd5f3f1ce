#include <debond/bulk/neo_hookean.h>

namespace Debond
{
  Eigen::Matrix<double, 9, 9>
  NeoHookean::tangent(const double (&H)[3][3]) const
  {
    const double j = volume_change(H);
    double       A[3][3];
    inverse_transpose(H, 1. + j, A);
    const double                factor = G - Lambda * std::log1p(j);
    Eigen::Matrix<double, 9, 9> C = G * Eigen::Matrix<double, 9, 9>::Identity();
    for (unsigned int m = 0; m < 9; ++m)
      for (unsigned int n = 0; n < 9; ++n)
        C(m, n) += factor * A[m / 3][n % 3] * A[n / 3][m % 3] +
                   Lambda * A[m / 3][m % 3] * A[n / 3][n % 3];
    return C;
  }



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
