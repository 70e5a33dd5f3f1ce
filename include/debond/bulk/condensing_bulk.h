#pragma once

#include <debond/bulk/bulk.h>

namespace Debond
{
  /** A bulk that condenses its stiffness K on the degrees of freedom c of the
   *  control points that contact can reach, its unknowns:
   *
   *   S = K_cc - K_ci K_ii^-1 K_ic. */
  class CondensingBulk : public Bulk
  {
  public:
    /** S x, S^-1 b. */
    virtual Eigen::VectorXd
    product(const Eigen::VectorXd &x) const = 0;
    virtual Eigen::VectorXd
    solve(const Eigen::VectorXd &b) const = 0;
    /** True if there is S as a dense matrix; the coupled system must else do
     *  with products and solves. */
    virtual bool
    is_dense() const = 0;
    /** S as a dense matrix; formed at every call. */
    virtual Eigen::MatrixXd
    dense_stiffness() const = 0;

    virtual Residual
    condense(const Eigen::VectorXd &r) const = 0;
    /** The displacement dv whose unknowns are @p dv_c and whose others follow,
     *  dv_i = -K_ii^-1 (r_i + K_ic dv_c). */
    virtual Eigen::VectorXd
    correction(const Eigen::VectorXd &dv_c, const Residual &r) const = 0;

  protected:
    using Bulk::Bulk;
  };
} // namespace Debond
