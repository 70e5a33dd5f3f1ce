#include <debond/condensation.h>

#include <deal.II/base/exceptions.h>

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <utility>

namespace Debond
{
  /** CHOLMOD's workspace and factor, released with the object. */
  struct Condensation::Cholmod
  {
    cholmod_common  common;
    cholmod_factor *factor   = nullptr;
    cholmod_dense  *solution = nullptr, *work_1 = nullptr, *work_2 = nullptr;

    Cholmod()
    {
      cholmod_start(&common);
      common.supernodal = CHOLMOD_SUPERNODAL;
      // The given ordering must stay as it is: the condensed unknowns are last
      // and the others are already postordered.
      common.postorder                  = 0;
      common.nmethods                   = 1;
      common.method[0].ordering         = CHOLMOD_GIVEN;
      common.quick_return_if_not_posdef = 1;
      common.print                      = 0;
      common.error_handler              = nullptr;
    }
    Cholmod(const Cholmod &) = delete;
    Cholmod &
    operator=(const Cholmod &) = delete;
    ~Cholmod()
    {
      cholmod_free_dense(&solution, &common);
      cholmod_free_dense(&work_1, &common);
      cholmod_free_dense(&work_2, &common);
      cholmod_free_factor(&factor, &common);
      cholmod_finish(&common);
    }
  };

  Condensation::Condensation()                = default;
  Condensation::~Condensation()               = default;
  Condensation::Condensation(Condensation &&) = default;
  Condensation &
  Condensation::operator=(Condensation &&) = default;

  namespace
  {
    // CHOLMOD's view on a matrix that is stored elsewhere.
    cholmod_sparse
    view(const SymmetricSparseMatrix &K)
    {
      cholmod_sparse A{};
      A.nrow = A.ncol = K.n;
      A.nzmax         = K.row.size();
      A.p             = const_cast<int *>(K.column_start.data());
      A.i             = const_cast<int *>(K.row.data());
      A.x             = const_cast<double *>(K.value.data());
      A.stype         = -1;
      A.itype         = CHOLMOD_INT;
      A.xtype         = CHOLMOD_REAL;
      A.dtype         = CHOLMOD_DOUBLE;
      A.sorted        = 1;
      A.packed        = 1;
      return A;
    }



    // The rows and columns of K that are not condensed.
    SymmetricSparseMatrix
    interior_block(const SymmetricSparseMatrix &K,
                   const std::vector<int>      &interior_index,
                   const std::vector<int>      &interior)
    {
      SymmetricSparseMatrix B;
      B.n = interior.size();
      B.column_start.push_back(0);
      for (const int column : interior)
        {
          for (int k = K.column_start[column]; k < K.column_start[column + 1];
               ++k)
            if (interior_index[K.row[k]] >= 0)
              {
                B.row.push_back(interior_index[K.row[k]]);
                B.value.push_back(K.value[k]);
              }
          B.column_start.push_back(B.row.size());
        }
      return B;
    }



    // A fill-reducing, postordered permutation (new -> old).
    std::vector<int>
    fill_reducing_order(const SymmetricSparseMatrix &B)
    {
      std::vector<int> order(B.n);
      if (B.n == 0)
        return order;
      cholmod_common common;
      cholmod_start(&common);
      common.print              = 0;
      common.nmethods           = 1;
      common.method[0].ordering = CHOLMOD_METIS;
      common.postorder          = 1;
      cholmod_sparse  A         = view(B);
      cholmod_factor *symbolic  = cholmod_analyze(&A, &common);
      AssertThrow(symbolic != nullptr,
                  dealii::ExcMessage("CHOLMOD's analysis failed"));
      std::copy_n(static_cast<int *>(symbolic->Perm), B.n, order.begin());
      cholmod_free_factor(&symbolic, &common);
      cholmod_finish(&common);
      return order;
    }
  } // namespace



  bool
  Condensation::factorise(const SymmetricSparseMatrix &K,
                          const std::vector<int>      &condensed)
  {
    n_total = K.n;
    n_c     = condensed.size();

    std::vector<int> interior_index(n_total, 0), interior;
    for (const int c : condensed)
      interior_index[c] = -1;
    for (unsigned int i = 0; i < n_total; ++i)
      if (interior_index[i] == 0)
        {
          interior_index[i] = interior.size();
          interior.push_back(i);
        }
    permutation.clear();
    for (const int i :
         fill_reducing_order(interior_block(K, interior_index, interior)))
      permutation.push_back(interior[i]);
    permutation.insert(permutation.end(), condensed.begin(), condensed.end());

    cholmod = std::make_unique<Cholmod>();
    if (n_total == 0)
      {
        S.resize(0, 0);
        return true;
      }
    cholmod_sparse A = view(K);
    cholmod->factor =
      cholmod_analyze_p(&A, permutation.data(), nullptr, 0, &cholmod->common);
    AssertThrow(cholmod->factor != nullptr,
                dealii::ExcMessage("CHOLMOD's analysis failed"));
    AssertThrow(std::equal(permutation.begin(),
                           permutation.end(),
                           static_cast<int *>(cholmod->factor->Perm)),
                dealii::ExcMessage("CHOLMOD did not keep the given order"));
    cholmod_factorize(&A, cholmod->factor, &cholmod->common);
    if (cholmod->common.status != CHOLMOD_OK ||
        cholmod->factor->minor != cholmod->factor->n)
      return false;
    extract_trailing_block();
    return S.allFinite(); // a matrix with NaN passes all pivots
  }



  void
  Condensation::extract_trailing_block()
  {
    const cholmod_factor &L = *cholmod->factor;
    AssertThrow(L.is_super && L.is_ll, dealii::ExcInternalError());
    const int *super = static_cast<int *>(L.super),
              *row   = static_cast<int *>(L.s);
    const int    *pi = static_cast<int *>(L.pi), *px = static_cast<int *>(L.px);
    const double *x   = static_cast<double *>(L.x);
    const int     n_i = n_total - n_c;

    L_cc.setZero(n_c, n_c);
    for (std::size_t s = 0; s < L.nsuper; ++s)
      for (int column = std::max(super[s], n_i); column < super[s + 1];
           ++column)
        {
          const int     n_rows = pi[s + 1] - pi[s];
          const double *values =
            x + px[s] + std::size_t(column - super[s]) * n_rows;
          for (int k = column - super[s]; k < n_rows; ++k)
            L_cc(row[pi[s] + k] - n_i, column - n_i) = values[k];
        }
    S.setZero(n_c, n_c);
    if (n_c == 0)
      return; // BLAS refuses empty matrices
    S.selfadjointView<Eigen::Lower>().rankUpdate(L_cc);
    S.triangularView<Eigen::StrictlyUpper>() = S.transpose();
  }



  Eigen::VectorXd
  Condensation::solve_triangular(const bool             transposed,
                                 const Eigen::VectorXd &b)
  {
    cholmod_dense right_hand_side{};
    right_hand_side.nrow = right_hand_side.d = right_hand_side.nzmax = n_total;
    right_hand_side.ncol                                             = 1;
    right_hand_side.x     = const_cast<double *>(b.data());
    right_hand_side.xtype = CHOLMOD_REAL;
    right_hand_side.dtype = CHOLMOD_DOUBLE;
    const int ok          = cholmod_solve2(transposed ? CHOLMOD_Lt : CHOLMOD_L,
                                  cholmod->factor,
                                  &right_hand_side,
                                  nullptr,
                                  &cholmod->solution,
                                  nullptr,
                                  &cholmod->work_1,
                                  &cholmod->work_2,
                                  &cholmod->common);
    AssertThrow(ok, dealii::ExcMessage("CHOLMOD's triangular solve failed"));
    return Eigen::Map<Eigen::VectorXd>(
      static_cast<double *>(cholmod->solution->x), n_total);
  }



  Eigen::VectorXd
  Condensation::forward(const Eigen::VectorXd &r)
  {
    if (n_total == 0)
      return r;
    Eigen::VectorXd permuted(n_total);
    for (unsigned int k = 0; k < n_total; ++k)
      permuted[k] = r[permutation[k]];
    forward_part = solve_triangular(false, permuted);
    if (n_c == 0)
      return Eigen::VectorXd();
    return L_cc.triangularView<Eigen::Lower>() * forward_part.tail(n_c);
  }



  Eigen::VectorXd
  Condensation::backward(const Eigen::VectorXd &x_c)
  {
    if (n_total == 0)
      return x_c;
    Eigen::VectorXd b = forward_part;
    if (n_c > 0)
      b.tail(n_c) = L_cc.transpose().triangularView<Eigen::Upper>() * x_c;
    const Eigen::VectorXd permuted = solve_triangular(true, b);
    Eigen::VectorXd       x(n_total);
    for (unsigned int k = 0; k < n_total; ++k)
      x[permutation[k]] = permuted[k];
    return x;
  }



  Eigen::VectorXd
  Condensation::extend(const Eigen::VectorXd &x_c)
  {
    forward_part.setZero(n_total);
    return backward(x_c);
  }
} // namespace Debond
