#include <debond/dense_solver.h>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector.h>

#include <algorithm>

namespace Debond
{
  namespace
  {
    using DealVector = dealii::Vector<double>;

    Eigen::Map<Eigen::VectorXd>
    as_eigen(DealVector &v)
    {
      return {v.begin(), static_cast<Eigen::Index>(v.size())};
    }
    Eigen::Map<const Eigen::VectorXd>
    as_eigen(const DealVector &v)
    {
      return {v.begin(), static_cast<Eigen::Index>(v.size())};
    }

    // What deal.II's solvers ask of a matrix or a preconditioner.
    struct Operator
    {
      std::function<void(const Eigen::VectorXd &, Eigen::VectorXd &)> product;

      void
      vmult(DealVector &y, const DealVector &x) const
      {
        Eigen::VectorXd result(x.size());
        product(as_eigen(x), result);
        as_eigen(y) = result;
      }
    };



    // Iterations that are cheaper than a new factorisation: n^3 against n^2
    // work, with a floor for small systems where overheads count.
    unsigned int
    affordable_iterations(const unsigned int n)
    {
      return std::clamp(n / 50, 6u, 40u);
    }
  } // namespace



  Eigen::VectorXd
  DenseSolver::factorise_and_solve(const Eigen::VectorXd &b,
                                   const Assemble        &assemble)
  {
    assemble(matrix);
    lu.compute(matrix);
    usable = true;
    ++factorisations;
    return lu.solve(b);
  }



  Eigen::VectorXd
  DenseSolver::solve(const Eigen::VectorXd &b,
                     const Product         &product,
                     const Assemble        &assemble,
                     const double           relative_tolerance)
  {
    if (b.size() == 0 || b.isZero(0.))
      return Eigen::VectorXd::Zero(b.size());
    if (!usable || lu.rows() != b.size())
      return factorise_and_solve(b, assemble);

    const unsigned int    max_iterations = affordable_iterations(b.size());
    dealii::SolverControl control(max_iterations,
                                  relative_tolerance * b.norm(),
                                  false,
                                  false);
    dealii::SolverGMRES<DealVector> gmres(
      control,
      dealii::SolverGMRES<DealVector>::AdditionalData(max_iterations + 2,
                                                      true));
    DealVector x(b.size()), right_hand_side(b.size());
    as_eigen(right_hand_side) = b;
    try
      {
        gmres.solve(Operator{product},
                    x,
                    right_hand_side,
                    Operator{[this](const Eigen::VectorXd &v,
                                    Eigen::VectorXd &y) { y = lu.solve(v); }});
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        iterations += control.last_step();
        return factorise_and_solve(b, assemble);
      }
    iterations += control.last_step();
    return as_eigen(x);
  }
} // namespace Debond
