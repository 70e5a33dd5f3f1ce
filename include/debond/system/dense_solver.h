#pragma once

#include <debond/support/serialization.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <memory>

namespace Debond
{
  /** An unsymmetric matrix A = B + C that is not stored: B the condensed bulk,
   *  C the interface. */
  struct SplitMatrix
  {
    virtual ~SplitMatrix() = default;
    /** A x. */
    virtual Eigen::VectorXd
    product(const Eigen::VectorXd &x) const = 0;
    /** C x. */
    virtual Eigen::VectorXd
    interface_product(const Eigen::VectorXd &x) const = 0;
    /** True if B has an inverse. */
    virtual bool
    bulk_is_regular() const = 0;
    /** B^-1 b. */
    virtual Eigen::VectorXd
    solve_bulk(const Eigen::VectorXd &b) const = 0;
    /** True if A can be written: a part of it may exist as products only. */
    virtual bool
    can_be_assembled() const
    {
      return true;
    }
    /** Writes A. */
    virtual void
    assemble(Eigen::MatrixXd &A) const = 0;
  };

  /**
   * Solves dense unsymmetric systems whose matrix changes little from one call
   * to the next, by GMRES.
   *
   * As long as the bulk is not much softer than the interface, B is all the
   * preconditioner it takes: C B^-1 is small and compact, since the compliance
   * of the bulk decays with the wave number. Otherwise it is the LU
   * factorisation of an earlier matrix, formed anew when that no longer pays.
   * Whether it pays is decided by the size of the system and the number of
   * iterations only, so that results do not depend on the clock.
   */
  class DenseSolver
  {
  public:
    /** Returns x with |b - A x| <= relative_tolerance |b|, or what is not
     * finite if there is none. */
    Eigen::VectorXd
    solve(const SplitMatrix     &A,
          const Eigen::VectorXd &b,
          double                 relative_tolerance);

    /** Matrices to come have nothing to do with those before. */
    void
    forget()
    {
      factors.reset();
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      if constexpr (is_in_memory<Archive>)
        archive &factors;
      else
        {
          bool     is_factorised = factors != nullptr;
          archive &is_factorised;
          if (!is_factorised)
            return forget();
          // what is saved stays as it is
          const auto known = Archive::is_loading::value ?
                               std::make_shared<Factors>() :
                               std::const_pointer_cast<Factors>(factors);
          archive & known->lu & known->permutation.indices();
          factors = known;
        }
    }

  private:
    bool
    iterate(const SplitMatrix     &A,
            const Eigen::VectorXd &b,
            double                 relative_tolerance,
            Eigen::VectorXd       &x);

    /** P A = L U, with both factors in one matrix. */
    struct Factors
    {
      Eigen::MatrixXd                                          lu;
      Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic> permutation;

      /** A^-1 b. */
      Eigen::VectorXd
      solve(const Eigen::VectorXd &b) const
      {
        Eigen::VectorXd x = permutation * b;
        lu.triangularView<Eigen::UnitLower>().solveInPlace(x);
        lu.triangularView<Eigen::Upper>().solveInPlace(x);
        return x;
      }
    };
    /** The preconditioner; null: it is the bulk. Never changed, so that states
     *  to go back to can share it. */
    std::shared_ptr<const Factors> factors;
  };
} // namespace Debond
