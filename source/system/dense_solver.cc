#include <debond/system/dense_solver.h>

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace Debond
{
  namespace
  {
    using DealVector = dealii::Vector<double>;

    Eigen::Map<const Eigen::VectorXd>
    as_eigen(const DealVector &v)
    {
      return {v.begin(), static_cast<Eigen::Index>(v.size())};
    }

    // What deal.II's solvers ask of a matrix.
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



    // More iterations than this with the bulk as preconditioner, and those
    // with a factorisation, which cost twice as much each but are fewer, are
    // cheaper in the long run.
    constexpr unsigned int max_bulk_iterations = 12;

    // Iterations that are cheaper than a new factorisation: n^3 against n^2
    // work, with a floor for small systems where overheads count.
    unsigned int
    affordable_iterations(const unsigned int n)
    {
      return std::clamp(n / 50, 6u, 40u);
    }
  } // namespace



  // Preconditioned from the right with P: (A P^-1) y = b, x = P^-1 y, and with
  // P = B there is no product with B: A B^-1 = 1 + C B^-1.
  bool
  DenseSolver::iterate(const SplitMatrix     &A,
                       const Eigen::VectorXd &b,
                       const double           relative_tolerance,
                       Eigen::VectorXd       &x)
  {
    const Operator preconditioned{
      [&](const Eigen::VectorXd &y) -> Eigen::VectorXd {
        if (is_factorised)
          return A.product(lu.solve(y));
        return y + A.interface_product(A.solve_bulk(y));
      }};
    const unsigned int max_iterations =
      !A.can_be_assembled() ? b.size() :
      is_factorised         ? affordable_iterations(b.size()) :
                              max_bulk_iterations;
    dealii::SolverControl           control(max_iterations,
                                  relative_tolerance * b.norm(),
                                  false,
                                  false);
    dealii::SolverGMRES<DealVector> gmres(
      control,
      dealii::SolverGMRES<DealVector>::AdditionalData(max_iterations + 2));
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
    x =
      is_factorised ? lu.solve(as_eigen(y)).eval() : A.solve_bulk(as_eigen(y));
    return true;
  }



  Eigen::VectorXd
  DenseSolver::solve(const SplitMatrix     &A,
                     const Eigen::VectorXd &b,
                     const double           relative_tolerance)
  {
    if (b.size() == 0 || b.isZero(0.))
      return Eigen::VectorXd::Zero(b.size());
    Eigen::VectorXd x;
    const bool      can_iterate =
      is_factorised ? lu.rows() == b.size() : A.bulk_is_regular();
    if (can_iterate && iterate(A, b, relative_tolerance, x))
      return x;
    if (!A.can_be_assembled())
      return Eigen::VectorXd::Constant(b.size(), std::nan(""));
    A.assemble(matrix);
    lu.compute(matrix);
    is_factorised = true;
    return lu.solve(b);
  }
} // namespace Debond
