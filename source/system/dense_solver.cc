#include <debond/system/dense_solver.h>

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <functional>

// The linear solver: deal.II's GMRES for A x = b, A = B + C, unsymmetric and
// dense, of some 300 to 8300 unknowns. What it is preconditioned with decides
// how many iterations it takes.
//
// With B, the condensed bodies: their factors are there anyway, and a solve is
// two triangular ones, O(n^2). A B^-1 = 1 + C B^-1, and C B^-1 is compact: a
// load that varies fast along the face hardly moves it. Or with the LU factors
// of an earlier A: O(n^3) to make, O(n^2) to use.
//
// The number of iterations with B depends on the stiffness of the interface and
// not on the mesh: 3.7 for eps = 585 MPa/mm, 4.4 for 1800, and 9 for 18 000
// (doc/explanation/solution.md).
namespace Debond
{
  namespace
  {
    using DealVector = dealii::Vector<double>;
    // A view, no copy: the bodies work on Eigen's vectors, GMRES on those of
    // deal.II.

    Eigen::Map<const Eigen::VectorXd>
    as_eigen(const DealVector &v)
    {
      return {v.begin(), static_cast<Eigen::Index>(v.size())};
    }

    // More iterations than this with the bulk as preconditioner, and those with
    // a factorisation, which cost twice as much each but are fewer, are cheaper
    // in the long run. A matrix changes little from one iteration of Newton's
    // method to the next, so that factors serve for many.
    constexpr unsigned int max_bulk_iterations = 12;

    // Vectors that are kept at most where nothing else can solve: all there
    // could be are as many as unknowns.
    constexpr unsigned int max_vectors = 200;

  } // namespace



  // Preconditioned from the right with P: (A P^-1) y = b, x = P^-1 y, and with
  // P = B there is no product with B: A B^-1 = 1 + C B^-1. From the right the
  // residual that GMRES watches is that of A x = b itself, so that its
  // tolerance means what Newton's method asks for.
  //
  // False if it takes too many iterations: x is then not to be used.
  bool
  DenseSolver::iterate(const SplitMatrix     &A,
                       const Eigen::VectorXd &b,
                       const double           relative_tolerance,
                       Eigen::VectorXd       &x)
  {
    // What deal.II's solvers ask of a matrix is vmult(). No matrix is behind
    // it, but a function.
    const struct
    {
      std::function<void(DealVector &, const DealVector &)> vmult;
    } preconditioned{[&](DealVector &result, const DealVector &of) {
      const Eigen::VectorXd       y = as_eigen(of);
      Eigen::Map<Eigen::VectorXd> to(result.begin(), y.size());
      if (of.all_zero()) // where GMRES begins
        to.setZero();
      else if (factors)
        to = A.product(factors->solve(y));
      else
        to = y + A.interface_product(A.solve_bulk(y));
    }};
    // What cannot be assembled has no other solver behind it, and may iterate
    // as long as GMRES can in exact arithmetic. With factors as often as is
    // cheaper than a new factorisation: n^3 against n^2 work, with a floor for
    // small systems where overheads count. A count and not the clock, which
    // would make results depend on what else the machine does.
    // Relative to |b|. Restarts only then: all vectors are kept, which costs
    // little where iterations are few.
    const unsigned int n              = b.size(),
                       max_iterations = !A.can_be_assembled() ? n :
                                        factors ? std::clamp(n / 50, 6u, 40u) :
                                                  max_bulk_iterations;
    dealii::SolverControl           control(max_iterations,
                                  relative_tolerance * b.norm(),
                                  false,
                                  false);
    dealii::SolverGMRES<DealVector> gmres(
      control,
      dealii::SolverGMRES<DealVector>::AdditionalData(
        std::min(max_iterations, max_vectors) + 2));
    DealVector       y(b.size());
    const DealVector right_hand_side(b.begin(), b.end());
    try
      {
        gmres.solve(preconditioned,
                    y,
                    right_hand_side,
                    dealii::PreconditionIdentity());
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        return false;
      }
    // From y to x, by the preconditioner that the iteration used.
    x = factors ? factors->solve(as_eigen(y)) : A.solve_bulk(as_eigen(y));
    return true;
  }



  // Iterates with what there is; where that is too slow, or there is nothing, A
  // is assembled and factorised, which solves this system directly and
  // preconditions those to come. Factors of another numbering are of no use: a
  // size that differs tells them, and forget().
  Eigen::VectorXd
  DenseSolver::solve(const SplitMatrix     &A,
                     const Eigen::VectorXd &b,
                     const double           relative_tolerance)
  {
    // Two rigid bodies with a prescribed chuck have no unknowns. And GMRES
    // could not make a residual of zero smaller.
    // With unknown components of the chuck, which condensed bodies do not
    // resist, B has no inverse: the first system goes straight to LU.
    if (b.size() == 0 || b.isZero(0.))
      return Eigen::VectorXd::Zero(b.size());
    Eigen::VectorXd x;
    const bool      can_iterate =
      factors ? factors->lu.rows() == b.size() : A.bulk_is_regular();
    if (can_iterate && iterate(A, b, relative_tolerance, x))
      return x;
    // Not finite: the caller takes it for a singular system and gives the
    // attempt up.
    if (!A.can_be_assembled())
      return Eigen::VectorXd::Constant(b.size(), std::nan(""));
    // LU with partial pivoting: A is neither symmetric nor, with the rows of
    // the chuck, definite. The factors take the place of the matrix. Those
    // before are let go of first, but a state to go back to may hold them.
    factors.reset();
    const auto next = std::make_shared<Factors>();
    A.assemble(next->lu);
    const Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>> lu(next->lu);
    next->permutation = lu.permutationP();
    factors           = next;
    return factors->solve(b);
  }

} // namespace Debond
