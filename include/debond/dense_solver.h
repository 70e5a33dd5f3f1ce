#ifndef debond_dense_solver_h
#define debond_dense_solver_h

#include <Eigen/Core>
#include <Eigen/LU>

#include <functional>

namespace Debond
{
  /**
   * Solves a dense unsymmetric system whose matrix changes little from one call
   * to the next: GMRES with the LU factorisation of an earlier matrix, and a
   * new factorisation when that no longer pays. Whether it pays is decided by
   * the size of the system and the number of iterations only, so that results
   * do not depend on the clock.
   */
  class DenseSolver
  {
  public:
    using Product =
      std::function<void(const Eigen::VectorXd &, Eigen::VectorXd &)>;
    using Assemble = std::function<void(Eigen::MatrixXd &)>;

    /** Returns x with |b - A x| <= relative_tolerance |b|. @p product applies
     * A;
     *  @p assemble writes A, and is called only for a new factorisation. */
    Eigen::VectorXd
    solve(const Eigen::VectorXd &b,
          const Product         &product,
          const Assemble        &assemble,
          double                 relative_tolerance);

    /** The next call factorises. */
    void
    forget()
    {
      usable = false;
    }

    unsigned int
    n_factorisations() const
    {
      return factorisations;
    }
    unsigned int
    n_iterations() const
    {
      return iterations;
    }

  private:
    Eigen::VectorXd
    factorise_and_solve(const Eigen::VectorXd &b, const Assemble &assemble);

    bool                                 usable = false;
    Eigen::MatrixXd                      matrix;
    Eigen::PartialPivLU<Eigen::MatrixXd> lu;
    unsigned int                         factorisations = 0, iterations = 0;
  };
} // namespace Debond
#endif
