#include <debond/bulk/condensation.h>
#include <debond/support/runtime.h>

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
    cholmod_factor *factor = nullptr;

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
    // From here on threads inside the dense algebra of a factorisation pay.
    constexpr unsigned int many_unknowns = 20000;



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
        L_cc.resize(0, 0);
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
    {
      const ThreadedBlas threads(n_total > many_unknowns);
      cholmod_factorize(&A, cholmod->factor, &cholmod->common);
    }
    if (cholmod->common.status != CHOLMOD_OK ||
        cholmod->factor->minor != cholmod->factor->n)
      return false;
    extract_trailing_block();
    return L_cc.allFinite(); // a matrix with NaN passes all pivots
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
  }



  Eigen::MatrixXd
  Condensation::schur_complement() const
  {
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n_c, n_c);
    if (n_c == 0)
      return S; // BLAS refuses empty matrices
    S.selfadjointView<Eigen::Lower>().rankUpdate(L_cc);
    S.triangularView<Eigen::StrictlyUpper>() = S.transpose();
    return S;
  }



  namespace
  {
    /** A dense part of the factor, columns @p stride apart. */
    using Block = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;



    Eigen::OuterStride<>
    stride_of(const Eigen::MatrixXd &L)
    {
      return Eigen::OuterStride<>(L.rows());
    }



    // x <- L^-1 x or L^-T x. Eigen would do this itself, but without the
    // processor's wide instructions.
    void
    solve_lower(const Block &L, const char *transposed, double *x)
    {
      const int n = L.cols(), stride = L.outerStride(), one = 1;
      if (n > 0)
        dtrsv_("L", transposed, "N", &n, L.data(), &stride, x, &one);
    }



    // Columns of a large triangle that are solved for at a time: small enough
    // for the cache, large enough for several threads to share the rest.
    constexpr int panel_width = 256;

    // The same for a large triangle L, panel by panel, in threads.
    void
    solve_large_lower(const Eigen::MatrixXd &L, Eigen::VectorXd &x)
    {
      const int n = L.rows();
      for (int first = 0; first < n; first += panel_width)
        {
          const int   width = std::min(panel_width, n - first);
          const int   next  = first + width;
          const Block triangle(&L(first, first), width, width, stride_of(L));
          solve_lower(triangle, "N", &x[first]);
          for_each_chunk(n - next,
                         [&](unsigned int, const int begin, const int end) {
                           x.segment(next + begin, end - begin).noalias() -=
                             L.block(next + begin, first, end - begin, width) *
                             x.segment(first, width);
                         });
        }
    }



    // x <- L^-T x.
    void
    solve_large_upper(const Eigen::MatrixXd &L, Eigen::VectorXd &x)
    {
      const int n = L.rows();
      for (int first = (n - 1) / panel_width * panel_width; first >= 0;
           first -= panel_width)
        {
          const int width = std::min(panel_width, n - first);
          const int next  = first + width;
          for_each_chunk(width,
                         [&](unsigned int, const int begin, const int end) {
                           x.segment(first + begin, end - begin).noalias() -=
                             L.block(next, first + begin, n - next, end - begin)
                               .transpose() *
                             x.tail(n - next);
                         });
          const Block triangle(&L(first, first), width, width, stride_of(L));
          solve_lower(triangle, "T", &x[first]);
        }
    }



    /** The columns of a supernode of the factor that are not condensed. */
    struct Supernode
    {
      Supernode(const cholmod_factor &L, const std::size_t s, const int n_i)
        : first(static_cast<int *>(L.super)[s])
        , n(std::min(static_cast<int *>(L.super)[s + 1], n_i) - first)
        , n_below(static_cast<int *>(L.pi)[s + 1] -
                  static_cast<int *>(L.pi)[s] - n)
        , rows_below(static_cast<int *>(L.s) + static_cast<int *>(L.pi)[s] + n)
        , diagonal(static_cast<double *>(L.x) + static_cast<int *>(L.px)[s],
                   n,
                   n,
                   Eigen::OuterStride<>(n + n_below))
        , below(diagonal.data() + n, n_below, n, diagonal.outerStride())
      {}

      int        first, n, n_below;
      const int *rows_below;
      Block      diagonal, below;
    };
  } // namespace



  Eigen::VectorXd
  Condensation::schur_product(const Eigen::VectorXd &x) const
  {
    if (n_c == 0)
      return x;
    Eigen::VectorXd y = L_cc.transpose().triangularView<Eigen::Upper>() * x;
    return L_cc.triangularView<Eigen::Lower>() * y;
  }



  Eigen::VectorXd
  Condensation::schur_solve(const Eigen::VectorXd &b) const
  {
    if (n_c == 0)
      return b;
    Eigen::VectorXd x = b;
    solve_large_lower(L_cc, x);
    solve_large_upper(L_cc, x);
    return x;
  }



  void
  Condensation::eliminate_interior(Eigen::VectorXd &x) const
  {
    const cholmod_factor &L   = *cholmod->factor;
    const int             n_i = n_total - n_c;
    Eigen::VectorXd       change;
    for (std::size_t s = 0;
         s < L.nsuper && static_cast<int *>(L.super)[s] < n_i;
         ++s)
      {
        const Supernode node(L, s, n_i);
        solve_lower(node.diagonal, "N", &x[node.first]);
        change.noalias() = node.below * x.segment(node.first, node.n);
        for (int k = 0; k < node.n_below; ++k)
          x[node.rows_below[k]] -= change[k];
      }
  }



  void
  Condensation::recover_interior(Eigen::VectorXd &x) const
  {
    const cholmod_factor &L   = *cholmod->factor;
    const int             n_i = n_total - n_c;
    Eigen::VectorXd       known;
    for (std::size_t s = L.nsuper; s-- > 0;)
      if (static_cast<int *>(L.super)[s] < n_i)
        {
          const Supernode node(L, s, n_i);
          known.resize(node.n_below);
          for (int k = 0; k < node.n_below; ++k)
            known[k] = x[node.rows_below[k]];
          x.segment(node.first, node.n).noalias() -=
            node.below.transpose() * known;
          solve_lower(node.diagonal, "T", &x[node.first]);
        }
  }



  // With P K P^T = L L^T the rows i of L y = P r give y_i = L_ii^-1 (P r)_i,
  // and what those above the condensed rows leave is
  //   r_c - L_ci y_i = r_c - K_ci K_ii^-1 r_i.
  Condensation::Condensed
  Condensation::forward(const Eigen::VectorXd &r) const
  {
    if (n_total == 0)
      return {r, r};
    Eigen::VectorXd x(n_total);
    for (unsigned int k = 0; k < n_total; ++k)
      x[k] = r[permutation[k]];
    eliminate_interior(x);
    return {x.tail(n_c), x.head(n_total - n_c)};
  }



  // L_ii^T x_i = y_i - L_ci^T x_c
  Eigen::VectorXd
  Condensation::backward(const Eigen::VectorXd &x_c,
                         const Eigen::VectorXd &interior) const
  {
    if (n_total == 0)
      return x_c;
    Eigen::VectorXd permuted       = Eigen::VectorXd::Zero(n_total);
    permuted.head(interior.size()) = interior;
    permuted.tail(n_c)             = x_c;
    recover_interior(permuted);
    Eigen::VectorXd x(n_total);
    for (unsigned int k = 0; k < n_total; ++k)
      x[permutation[k]] = permuted[k];
    return x;
  }
} // namespace Debond
