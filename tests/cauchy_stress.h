#ifndef debond_tests_cauchy_stress_h
#define debond_tests_cauchy_stress_h

#include <debond/bulk/neo_hookean.h>

/** Cauchy stress of Eq. (1) [MPa], sigma = (G (b - I) + Lambda ln J I) / J, for
 *  F = I + H. */
inline Eigen::Matrix3d
neo_hookean_stress(const Debond::NeoHookean &material, const Eigen::Matrix3d &H)
{
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity(), F = I + H;
  const double          J = F.determinant();
  return (material.G * (F * F.transpose() - I) +
          material.Lambda * std::log(J) * I) /
         J;
}

/** That of Hooke's law, 2 G eps + Lambda tr eps I. */
inline Eigen::Matrix3d
hooke_stress(const Debond::NeoHookean &material, const Eigen::Matrix3d &H)
{
  return material.G * (H + H.transpose()) +
         material.Lambda * H.trace() * Eigen::Matrix3d::Identity();
}
#endif
