#pragma once

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace Debond
{
  /** A symmetric matrix, of which the lower triangle is stored: compressed
   *  columns with sorted rows. */
  using SymmetricSparseMatrix = Eigen::SparseMatrix<double>;

  /**
   * Static condensation of a symmetric positive definite matrix K on a few of
   * its unknowns c (i are the others):
   *
   *   S = K_cc - K_ci K_ii^-1 K_ic.
   *
   * The unknowns c are ordered last in a sparse Cholesky factorisation
   * P K P^T = L L^T (CHOLMOD, nested dissection of the rest), so that
   * S = L_cc L_cc^T falls out of the factor. Solves with K_ii use the other
   * columns of the factor only, those with S only the block L_cc.
   */
  class Condensation
  {
  public:
    /** Factorises @p K. @p condensed lists the unknowns c; their order is the
     *  order of the rows of S. Returns false if K is not positive definite
     *  (this object is then unusable until the next successful call). */
    bool
    factorise(const SymmetricSparseMatrix &K,
              const std::vector<int>      &condensed);

    /** S, n_c x n_c; formed at every call. */
    Eigen::MatrixXd
    schur_complement() const;
    /** S x. */
    Eigen::VectorXd
    schur_product(const Eigen::VectorXd &x) const;
    /** S^-1 b. */
    Eigen::VectorXd
    schur_solve(const Eigen::VectorXd &b) const;

    /** A vector r over all unknowns, condensed. */
    struct Condensed
    {
      Eigen::VectorXd condensed; ///< r_c - K_ci K_ii^-1 r_i
      /** L_ii^-1 (P r)_i, which backward() goes on from; empty: r_i = 0. */
      Eigen::VectorXd interior;
    };
    /** Forward half of a solve. */
    Condensed
    forward(const Eigen::VectorXd &r) const;
    /** Backward half: given x_c, returns x over all unknowns with
     *  x_i = K_ii^-1 (r_i - K_ic x_c), r_i by the @p interior of forward().
     * With an empty one it is the equilibrium shape that belongs to x_c. */
    Eigen::VectorXd
    backward(const Eigen::VectorXd &x_c, const Eigen::VectorXd &interior) const;

  private:
    struct Cholmod;
    std::shared_ptr<const Cholmod> cholmod;

    void
    extract_trailing_block();

    unsigned int     n_total = 0, n_c = 0;
    std::vector<int> permutation; ///< new -> old
    Eigen::MatrixXd  L_cc;        ///< lower triangular
  };
} // namespace Debond
