// Seconds that this machine takes for work of the kind that debond spends its
// time on, none of it debond's own code: small dense kernels, a dense
// factorisation, and triangular solves that wait for the memory. Seconds of a
// benchmark divided by these can be compared between machines, and on one
// machine between hours. Prints the median of five, all on one thread.

#include <debond/support/runtime.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <chrono>
#include <iostream>
#include <vector>

namespace
{
  // What keeps the compiler from leaving the work out.
  double sum = 0;

  void
  small_kernels()
  {
    Eigen::Matrix<double, 3, 12> a =
      Eigen::Matrix<double, 3, 12>::Constant(0.1);
    Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
    for (unsigned int i = 0; i < 2000000; ++i)
      {
        a                     = (m * a).eval();
        m(i % 3, (i + 1) % 3) = 1e-9 * a.sum();
      }
    sum += a.sum();
  }

  void
  factorisation()
  {
    Eigen::MatrixXd A = Eigen::MatrixXd::Constant(1200, 1200, 0.5);
    A.diagonal().setLinSpaced(600., 1200.);
    sum += A.partialPivLu().matrixLU().trace();
  }

  void
  triangular_solves(const Eigen::MatrixXd &L)
  {
    Eigen::VectorXd x = Eigen::VectorXd::Ones(L.rows());
    for (unsigned int i = 0; i < 20; ++i)
      L.triangularView<Eigen::Lower>().solveInPlace(x);
    sum += x.sum();
  }
} // namespace

int
main()
{
  Debond::set_up_libraries();
  Eigen::MatrixXd L = Eigen::MatrixXd::Constant(3000, 3000, 1e-4);
  L.diagonal().setConstant(1.);
  std::array<double, 5> seconds;
  for (double &time : seconds)
    {
      const auto start = std::chrono::steady_clock::now();
      small_kernels();
      factorisation();
      triangular_solves(L);
      time =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count();
    }
  std::sort(seconds.begin(), seconds.end());
  std::cout << seconds[2] << (sum == 0.12345 ? " " : "") << std::endl;
}
