// Static condensation by sparse Cholesky factorisation agrees with dense
// algebra for few, many, scattered, all and no condensed unknowns in any order,
// in threads, and refuses matrices that are not positive definite.

#include <debond/bulk/condensation.h>

#include <Eigen/Dense>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "checks.h"
#include "vectors.h"

using namespace Debond;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/** A lattice of springs of different stiffness, n x n x n nodes. */
MatrixXd
lattice(const int n)
{
  MatrixXd   K  = MatrixXd::Zero(n * n * n, n * n * n);
  const auto id = [&](int i, int j, int k) { return i + n * (j + n * k); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        {
          const int a = id(i, j, k);
          K(a, a) += 0.1;
          for (const int b : {i + 1 < n ? id(i + 1, j, k) : a,
                              j + 1 < n ? id(i, j + 1, k) : a,
                              k + 1 < n ? id(i, j, k + 1) : a})
            if (b != a)
              {
                const double stiffness = random_number(0.5, 2.);
                K(a, a) += stiffness;
                K(b, b) += stiffness;
                K(a, b) -= stiffness;
                K(b, a) -= stiffness;
              }
        }
  return K;
}

/** Springs between random pairs: no band, one node tied to many. */
MatrixXd
web(const int n)
{
  MatrixXd K = 0.1 * MatrixXd::Identity(n, n);
  for (int k = 0; k < 3 * n; ++k)
    {
      const int a =
        (k % 7 == 0 ? 0 : std::min(n - 1, int(random_number(0, n))));
      const int b = std::min(n - 1, int(random_number(0, n)));
      if (a == b)
        continue;
      K(a, a) += 1.;
      K(b, b) += 1.;
      K(a, b) -= 1.;
      K(b, a) -= 1.;
    }
  return K;
}

SymmetricSparseMatrix
sparse(const MatrixXd &K)
{
  return MatrixXd(K.triangularView<Eigen::Lower>()).sparseView();
}

struct Deviation
{
  double S = 0, asymmetry = 0, product = 0, solve = 0, forward = 0,
         backward = 0, extend = 0;
};

void
compare(const MatrixXd &K, const std::vector<int> &c, Deviation &deviation)
{
  Condensation condensation;
  if (!condensation.factorise(sparse(K), c) ||
      condensation.schur_complement().rows() != int(c.size()))
    {
      std::cout << "  NO factorisation" << std::endl;
      return;
    }
  std::vector<int> i;
  for (int k = 0; k < K.rows(); ++k)
    if (std::find(c.begin(), c.end(), k) == c.end())
      i.push_back(k);
  const MatrixXd        K_cc = K(c, c), K_ci = K(c, i), K_ii = K(i, i);
  Eigen::LDLT<MatrixXd> inverse;
  if (!i.empty())
    inverse.compute(K_ii);
  const bool both = !i.empty() && !c.empty();
  MatrixXd   S    = K_cc;
  if (both)
    S -= K_ci * inverse.solve(K_ci.transpose());

  const MatrixXd ours = condensation.schur_complement();
  if (!c.empty())
    {
      grow(deviation.S, (ours - S).norm() / S.norm());
      grow(deviation.asymmetry, (ours - ours.transpose()).norm());
    }
  // twice: what one call keeps must not disturb the next
  for (unsigned int repetition = 0; repetition < 2; ++repetition)
    {
      const VectorXd r = random_vector(K.rows()), x_c = random_vector(c.size());
      VectorXd       condensed = r(c), x(K.rows()), shape(K.rows());
      x(c)                     = x_c;
      shape(c)                 = x_c;
      if (!i.empty())
        {
          VectorXd r_i = r(i), s_i = VectorXd::Zero(i.size());
          if (both)
            {
              condensed -= K_ci * inverse.solve(r_i);
              s_i = -K_ci.transpose() * x_c;
              r_i += s_i;
            }
          const VectorXd x_i = inverse.solve(r_i), shape_i = inverse.solve(s_i);
          x(i)     = x_i;
          shape(i) = shape_i;
        }
      if (c.empty()) // not even a message from BLAS
        grow(deviation.solve,
             double(condensation.schur_solve(x_c).size() +
                    condensation.schur_product(x_c).size()));
      else
        {
          grow(deviation.product,
               (condensation.schur_product(x_c) - S * x_c).norm() / x_c.norm());
          grow(deviation.solve,
               (condensation.schur_solve(S * x_c) - x_c).norm() / x_c.norm());
        }
      const auto     ours_of_r = condensation.forward(r);
      const VectorXd our_x     = condensation.backward(x_c, ours_of_r.interior);
      const VectorXd our_shape = condensation.backward(x_c, VectorXd());
      grow(deviation.forward,
           (ours_of_r.condensed - condensed).norm() / r.norm());
      grow(deviation.backward, (our_x - x).norm() / x.norm());
      if (!c.empty())
        grow(deviation.extend, (our_shape - shape).norm() / shape.norm());
      else
        grow(deviation.extend, our_shape.norm());
    }
}



void
check(const std::string &name, const MatrixXd &K)
{
  std::cout << name << std::endl;
  const int        n = K.rows();
  std::vector<int> one{n / 2}, few, many, scattered, all, none, shuffled;
  for (int k = 0; k < n; ++k)
    {
      if (k < n / 8)
        few.push_back(k);
      if (k % 6 != 0)
        many.push_back(k);
      if (k % 5 == 2)
        scattered.push_back(k);
      all.push_back(k);
    }
  shuffled = scattered;
  std::reverse(shuffled.begin(), shuffled.end());
  std::swap(shuffled[1], shuffled[shuffled.size() / 2]);

  Deviation deviation;
  for (const auto &c : {one, few, many, scattered, shuffled, all, none})
    compare(K, c, deviation);
  report("  Schur complement, relative deviation", deviation.S, 1e-13);
  report("  its asymmetry", deviation.asymmetry, 1e-13);
  report("  product with it, relative deviation", deviation.product, 1e-13);
  report("  solution with it, relative deviation", deviation.solve, 1e-12);
  report("  forward, relative deviation", deviation.forward, 1e-12);
  report("  backward, relative deviation", deviation.backward, 1e-12);
  report("  extend, relative deviation", deviation.extend, 1e-12);
}



/** Whether two threads, at the same time, find what one finds, to the last
 *  bit. */
bool
same_in_threads(const SymmetricSparseMatrix &K, const std::vector<int> &c)
{
  const auto complement = [&] {
    Condensation condensation;
    return condensation.factorise(K, c) ? condensation.schur_complement() :
                                          MatrixXd();
  };
  const MatrixXd   alone = complement();
  std::atomic<int> n_same{0};
  const int        n       = 30;
  const auto       several = [&] {
    for (int i = 0; i < n; ++i)
      n_same += complement() == alone;
  };
  std::thread one(several), other(several);
  one.join();
  other.join();
  return n_same == 2 * n;
}



int
main()
{
  const MatrixXd large = lattice(7);
  check("Lattice of 343 unknowns", large);
  check("Lattice of 27 unknowns", lattice(3));
  // more condensed unknowns than are solved for at a time
  check("Lattice of 729 unknowns", lattice(9));
  check("Web of 200 unknowns", web(200));
  MatrixXd single(1, 1);
  single << 3.;
  Deviation deviation;
  compare(single, {0}, deviation);
  compare(single, {}, deviation);
  report("One unknown, relative deviation",
         deviation.S + deviation.forward + deviation.backward +
           deviation.extend,
         1e-13);

  std::vector<int> face;
  for (int k = 0; k < 81; ++k)
    face.push_back(k);
  report("The same in two threads, to the last bit",
         same_in_threads(sparse(lattice(9)), face));

  std::cout << "Not positive definite" << std::endl;
  const std::vector<int> condensed{1, 2, 300, 340};
  for (const int place : {0, 100, 300, 342})
    {
      MatrixXd indefinite = large;
      indefinite(place, place) -= 20.;
      Condensation condensation;
      report("  refused",
             !condensation.factorise(sparse(indefinite), condensed));
      // and usable again
      report("  usable after that",
             condensation.factorise(sparse(large), condensed));
    }
  MatrixXd broken = large;
  broken(50, 50)  = std::nan("");
  report("  NaN refused", !Condensation().factorise(sparse(broken), condensed));
}
