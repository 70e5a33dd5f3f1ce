#pragma once

#include <debond/bulk/neo_hookean.h>

#include <Eigen/LU>

/** Cauchy stress of Eq. (1) [MPa], sigma = (G (b - I) + Lambda ln J I) / J, for
 *  F = I + H: by products of H, so that small strains lose no digits. */
inline Eigen::Matrix3d
neo_hookean_stress(const Debond::NeoHookean &material, const Eigen::Matrix3d &H)
{
  const double dJ = H.trace() +
                    0.5 * (H.trace() * H.trace() - (H * H).trace()) +
                    H.determinant(); // J - 1
  return (material.G * (H + H.transpose() + H * H.transpose()) +
          material.Lambda * std::log1p(dJ) * Eigen::Matrix3d::Identity()) /
         (1. + dJ);
}

/** That of Hooke's law, 2 G eps + Lambda tr eps I. */
inline Eigen::Matrix3d
hooke_stress(const Debond::NeoHookean &material, const Eigen::Matrix3d &H)
{
  return material.G * (H + H.transpose()) +
         material.Lambda * H.trace() * Eigen::Matrix3d::Identity();
}
