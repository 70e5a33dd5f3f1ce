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
// (doc/solution.md).
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

    // What deal.II's solvers ask of a matrix is vmult(). No matrix is behind
    // it, but a function.
    struct Operator
    {
      std::function<Eigen::VectorXd(const Eigen::VectorXd &)> product;

      void
      vmult(DealVector &y, const DealVector &x) const
      {
        const Eigen::VectorXd result = product(as_eigen(x));
        std::copy(result.begin(), result.end(), y.begin());
      }
    };



    // More iterations than this with the bulk as preconditioner, and those with
    // a factorisation, which cost twice as much each but are fewer, are cheaper
    // in the long run. A matrix changes little from one iteration of Newton's
    // method to the next, so that factors serve for many.
    constexpr unsigned int max_bulk_iterations = 12;

    // Vectors that are kept at most where nothing else can solve: all there
    // could be are as many as unknowns.
    constexpr unsigned int max_vectors = 200;

    // Iterations that are cheaper than a new factorisation: n^3 against n^2
    // work, with a floor for small systems where overheads count. A count and
    // not the clock, which would make results depend on what else the machine
    // does.
    unsigned int
    affordable_iterations(const unsigned int n)
    {
      return std::clamp(n / 50, 6u, 40u);
    }
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
    const Operator preconditioned{
      [&](const Eigen::VectorXd &y) -> Eigen::VectorXd {
        if (factors)
          return A.product(factors->solve(y));
        return y + A.interface_product(A.solve_bulk(y));
      }};
    // What cannot be assembled has no other solver behind it, and may iterate
    // as long as GMRES can in exact arithmetic.
    // Relative to |b|. Restarts only then: all vectors are kept, which costs
    // little where iterations are few.
    const unsigned int max_iterations =
      !A.can_be_assembled() ? b.size() :
      factors               ? affordable_iterations(b.size()) :
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



  // By the method of generalised conjugate residuals, for as many right-hand
  // sides at once as products are cheap for. It minimises |b - A x| over all
  // directions z so far, whichever residual they are from: their images q = A z
  // are kept orthonormal, and each right-hand side begins with what those
  // before do for it. As C B^-1 is compact, little is left after a few. False
  // if it takes too many.
  bool
  DenseSolver::iterate_all(const SplitMatrix     &A,
                           const Eigen::MatrixXd &B,
                           const double           relative_tolerance,
                           Eigen::MatrixXd       &X) const
  {
    constexpr unsigned int at_once = 8;
    const unsigned int     n       = B.rows();
    const unsigned int     max_directions =
      std::min<unsigned int>(n,
                             (A.can_be_assembled() ? affordable_iterations(n) :
                                                     max_vectors) *
                               (1 + B.cols()));
    Eigen::MatrixXd Q(n, max_directions), Z(n, max_directions), R = B;
    unsigned int    n_directions = 0;
    X.setZero(n, B.cols());
    for (unsigned int begin = 0; begin < B.cols(); begin += at_once)
      {
        const unsigned int width =
          std::min<unsigned int>(at_once, B.cols() - begin);
        auto       r         = R.middleCols(begin, width);
        auto       x         = X.middleCols(begin, width);
        const auto take_away = [&](const unsigned int first) {
          const unsigned int    m    = n_directions - first;
          const Eigen::MatrixXd part = Q.middleCols(first, m).transpose() * r;
          r -= Q.middleCols(first, m) * part;
          x += Z.middleCols(first, m) * part;
        };
        take_away(0);
        while (true)
          {
            Eigen::MatrixXd left(n, width);
            unsigned int    n_left = 0;
            for (unsigned int j = 0; j < width; ++j)
              if (const double tolerance =
                    relative_tolerance * B.col(begin + j).norm();
                  r.col(j).norm() > tolerance)
                left.col(n_left++) = r.col(j).normalized();
            if (n_left == 0)
              break;
            left.conservativeResize(n, n_left);
            const unsigned int first = n_directions;
            if (!add_directions(A, left, Q, Z, n_directions))
              return false;
            take_away(first);
          }
      }
    return true;
  }



  // Twice against the old ones, by which orthogonality is good to the last
  // digits, then against each other. What is nothing but a combination of
  // others is left out; without anything new there is no way on.
  bool
  DenseSolver::add_directions(const SplitMatrix     &A,
                              const Eigen::MatrixXd &residuals,
                              Eigen::MatrixXd       &Q,
                              Eigen::MatrixXd       &Z,
                              unsigned int          &n_directions) const
  {
    Eigen::MatrixXd z = residuals, q = residuals;
    if (factors)
      z = factors->solve(residuals);
    else
      z = A.solve_bulk_all(residuals);
    if (factors)
      for (unsigned int j = 0; j < z.cols(); ++j)
        q.col(j) = A.product(z.col(j));
    else
      q += A.interface_products(z);
    const unsigned int first = n_directions;
    for (unsigned int repetition = 0; repetition < 2; ++repetition)
      {
        const Eigen::MatrixXd part = Q.leftCols(first).transpose() * q;
        q -= Q.leftCols(first) * part;
        z -= Z.leftCols(first) * part;
      }
    for (unsigned int j = 0; j < z.cols() && n_directions < Q.cols(); ++j)
      {
        const double before = q.col(j).norm();
        for (unsigned int i = first; i < n_directions; ++i)
          {
            const double part = Q.col(i).dot(q.col(j));
            q.col(j) -= part * Q.col(i);
            z.col(j) -= part * Z.col(i);
          }
        const double length = q.col(j).norm();
        if (!(length > 1e-6 * before))
          continue;
        Q.col(n_directions) = q.col(j) / length;
        Z.col(n_directions) = z.col(j) / length;
        ++n_directions;
      }
    return n_directions > first;
  }



  // Factors of this matrix, where it takes them, are not kept: with other ones
  // than without derivatives Newton's method would go other ways in the last
  // digits.
  Eigen::MatrixXd
  DenseSolver::solve_all(const SplitMatrix     &A,
                         const Eigen::MatrixXd &B,
                         const double           relative_tolerance) const
  {
    Eigen::MatrixXd X = Eigen::MatrixXd::Zero(B.rows(), B.cols());
    const bool      can_iterate =
      factors ? factors->lu.rows() == B.rows() : A.bulk_is_regular();
    if (B.rows() == 0 ||
        (can_iterate && iterate_all(A, B, relative_tolerance, X)))
      return X;
    if (!A.can_be_assembled())
      return X.setConstant(std::nan(""));
    Eigen::MatrixXd matrix_now;
    A.assemble(matrix_now);
    return matrix_now.partialPivLu().solve(B);
  }
} // namespace Debond
