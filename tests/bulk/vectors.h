#pragma once

#include <Eigen/Core>

#include "checks.h"

inline Eigen::VectorXd
random_vector(const unsigned int n)
{
  Eigen::VectorXd result(n);
  for (double &value : result)
    value = random_number(-1., 1.);
  return result;
}



/** Relative, in the norm of Frobenius. */
inline double
deviation(const Eigen::MatrixXd &ours, const Eigen::MatrixXd &reference)
{
  return (ours - reference).norm() / reference.norm();
}
