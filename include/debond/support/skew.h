#ifndef debond_support_skew_h
#define debond_support_skew_h

#include <Eigen/Core>

namespace Debond
{
  /** The matrix of the cross product: skew(a) b = a x b. */
  inline Eigen::Matrix3d
  skew(const Eigen::Vector3d &a)
  {
    Eigen::Matrix3d S;
    S << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
    return S;
  }
} // namespace Debond
#endif
