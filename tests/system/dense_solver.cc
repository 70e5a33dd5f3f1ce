// The solver of the interface: the bulk alone preconditions a soft interface
// and saves every factorisation; a stiff one, and one whose bulk is singular,
// is factorised once for many similar matrices. The answer is the same.

#include <debond/system/dense_solver.h>

#include <Eigen/Dense>

#include <cmath>

#include "checks.h"

using namespace Debond;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/** A surface on a half space: stiffness |k| of the wave numbers k in cosines,
 *  and springs of stiffness @p spring that pull to one side (unsymmetric) and
 *  vary by @p variation along the surface. */
class Surface : public SplitMatrix
{
public:
  Surface(const int    n,
          const double spring,
          const double variation,
          const bool   fixed)
    : regular(fixed)
  {
    MatrixXd waves(n, n);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k)
        waves(i, k) = std::sqrt((k == 0 ? 1. : 2.) / n) *
                      std::cos(M_PI * k * (i + 0.5) / n);
    VectorXd stiffness = VectorXd::LinSpaced(n, 0, n - 1);
    if (fixed)
      stiffness[0] = 0.5;
    B = waves * stiffness.asDiagonal() * waves.transpose();
    C = MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i)
      {
        C(i, i) = spring * (1. + variation * std::sin(i));
        if (i > 0)
          C(i, i - 1) = -0.5 * C(i, i);
      }
  }

  VectorXd
  product(const VectorXd &x) const override
  {
    return B * x + C * x;
  }
  VectorXd
  interface_product(const VectorXd &x) const override
  {
    return C * x;
  }
  bool
  bulk_is_regular() const override
  {
    return regular;
  }
  VectorXd
  solve_bulk(const VectorXd &b) const override
  {
    return B.llt().solve(b);
  }
  void
  assemble(MatrixXd &A) const override
  {
    A = B + C;
    ++n_assembled;
  }

  static unsigned int n_assembled; ///< each of them is factorised

private:
  MatrixXd B, C;
  bool     regular;
};

unsigned int Surface::n_assembled = 0;



/** Solves with several matrices in turn. */
void
check(const std::string &name,
      const double       spring,
      const bool         fixed,
      const int          n = 200)
{
  DenseSolver solver;
  double      deviation = 0;
  Surface::n_assembled  = 0;
  for (const double variation : {0., 0.01, 0.012, 0.015, 0.01})
    {
      const Surface  A(n, spring, variation, fixed);
      const VectorXd b = VectorXd::LinSpaced(n, -1., 2.);
      const VectorXd x = solver.solve(A, b, 1e-9);
      grow(deviation, (A.product(x) - b).norm() / b.norm());
    }
  report(name + ", residual", deviation, 1e-9);
  std::cout << "  factorisations: " << Surface::n_assembled << std::endl;
}



int
main()
{
  check("Soft interface", 0.05, true);
  check("Stiff interface", 1e5, true);
  check("Singular bulk", 5., false);
  // some twenty iterations with the bulk: fewer than this size affords with a
  // factorisation, but too many
  check("Stiff interface of a large surface", 10., true, 1000);
  DenseSolver   solver;
  const Surface A(10, 1., 0., true);
  report("Nothing to solve for",
         solver.solve(A, VectorXd::Zero(10), 1e-9).isZero(0.));
}
