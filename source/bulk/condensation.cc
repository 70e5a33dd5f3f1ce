#include <debond/bulk/condensation.h>
#include <debond/support/runtime.h>

#include <deal.II/base/exceptions.h>

#include <Eigen/CholmodSupport>

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
      common.supernodal                 = CHOLMOD_SUPERNODAL;
      common.nmethods                   = 1;
      common.quick_return_if_not_posdef = 1;
      common.print                      = 0;
      common.error_handler              = nullptr;
    }
    Cholmod(const Cholmod &) = delete;
    ~Cholmod()
    {
      cholmod_free_factor(&factor, &common);
      cholmod_finish(&common);
    }

    /** The symbolic factor of K with the @p given permutation (new -> old) or,
     *  without one, with a postordered one that reduces fill. */
    void
    analyse(const SymmetricSparseMatrix &K, int *given)
    {
      common.method[0].ordering = given ? CHOLMOD_GIVEN : CHOLMOD_METIS;
      // a given ordering must stay as it is: the condensed unknowns are last
      // and the others are already postordered
      common.postorder = !given;
      auto A = Eigen::viewAsCholmod(K.selfadjointView<Eigen::Lower>());
      factor = cholmod_analyze_p(&A, given, nullptr, 0, &common);
      AssertThrow(factor != nullptr,
                  dealii::ExcMessage("CHOLMOD's analysis failed"));
    }

    const int *
    permutation() const
    {
      return static_cast<const int *>(factor->Perm);
    }
  };



  namespace
  {
    // From here on threads inside the dense algebra of a factorisation pay.
    constexpr unsigned int many_unknowns = 20000;



    // The rows and columns of K that are not condensed.
    SymmetricSparseMatrix
    interior_block(const SymmetricSparseMatrix &K,
                   const std::vector<int>      &interior_index,
                   const std::vector<int>      &interior)
    {
      SymmetricSparseMatrix B(interior.size(), interior.size());
      B.reserve(K.nonZeros());
      for (unsigned int j = 0; j < interior.size(); ++j)
        {
          B.startVec(j);
          for (SymmetricSparseMatrix::InnerIterator k(K, interior[j]); k; ++k)
            if (interior_index[k.row()] >= 0)
              B.insertBack(interior_index[k.row()], j) = k.value();
        }
      B.finalize();
      return B;
    }



    /** A dense part of the factor, columns some stride apart. */
    using Block = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;



    // x <- L^-1 x or L^-T x. Eigen would do this itself, but without the
    // processor's wide instructions.
    void
    solve_lower(const Block &L, const char *transposed, double *x)
    {
      const int n = L.cols(), stride = L.outerStride(), one = 1;
      if (n > 0)
        dtrsv_("L", transposed, "N", &n, L.data(), &stride, x, &one);
    }



    /** A supernode of the factor: neighbouring columns with the same rows that
     *  are not zero. */
    struct Supernode
    {
      /** @p n_i: number of columns of the factor that are not condensed. */
      Supernode(const cholmod_factor &L, const std::size_t s, const int n_i)
        : first(static_cast<int *>(L.super)[s])
        , rows(static_cast<int *>(L.s) + static_cast<int *>(L.pi)[s])
        , columns(Eigen::Map<const Eigen::MatrixXd>(
            static_cast<double *>(L.x) + static_cast<int *>(L.px)[s],
            static_cast<int *>(L.pi)[s + 1] - static_cast<int *>(L.pi)[s],
            static_cast<int *>(L.super)[s + 1] - first))
        , n(std::clamp<int>(n_i - first, 0, columns.cols()))
        , n_below(columns.rows() - n)
        , diagonal(columns.topLeftCorner(n, n))
        , below(columns.bottomLeftCorner(n_below, n))
      {}

      int        first;
      const int *rows;
      Block      columns;
      int        n, n_below; ///< columns that are not condensed, rows below
      Block      diagonal, below;
    };
  } // namespace



  // K_cc - K_ci K_ii^-1 K_ic is what Gaussian elimination of the interior
  // leaves of K_cc. So if the condensed unknowns are eliminated last, S never
  // has to be formed by solving with K_ii for each of its columns: its Cholesky
  // factor L_cc is the last block of that of K. All that takes is an ordering
  // in which they are last and the others as good as they can be.
  bool
  Condensation::factorise(const SymmetricSparseMatrix &K,
                          const std::vector<int>      &condensed)
  {
    n_total = K.rows();
    n_c     = condensed.size();

    // The interior, in ascending order.
    std::vector<int> interior_index(n_total, 0), interior;
    for (const int c : condensed)
      interior_index[c] = -1;
    for (unsigned int i = 0; i < n_total; ++i)
      if (interior_index[i] == 0)
        {
          interior_index[i] = interior.size();
          interior.push_back(i);
        }
    // Nested dissection of the interior alone, then the condensed unknowns.
    permutation.clear();
    if (!interior.empty())
      {
        Cholmod symbolic;
        symbolic.analyse(interior_block(K, interior_index, interior), nullptr);
        for (unsigned int k = 0; k < interior.size(); ++k)
          permutation.push_back(interior[symbolic.permutation()[k]]);
      }
    permutation.insert(permutation.end(), condensed.begin(), condensed.end());

    // P K P^T = L L^T in that order.
    const auto next = std::make_shared<Cholmod>();
    cholmod         = next;
    L_cc.resize(0, 0);
    if (n_total == 0)
      return true;
    next->analyse(K, permutation.data());
    AssertThrow(std::equal(permutation.begin(),
                           permutation.end(),
                           next->permutation()),
                dealii::ExcMessage("CHOLMOD did not keep the given order"));
    auto A = Eigen::viewAsCholmod(K.selfadjointView<Eigen::Lower>());
    thread_blas(n_total > many_unknowns);
    cholmod_factorize(&A, next->factor, &next->common);
    thread_blas(false);
    if (next->common.status != CHOLMOD_OK ||
        next->factor->minor != next->factor->n)
      return false;
    extract_trailing_block();
    return L_cc.allFinite(); // a matrix with NaN passes all pivots
  }



  // L_cc, which begins within a supernode.
  void
  Condensation::extract_trailing_block()
  {
    const cholmod_factor &L = *cholmod->factor;
    AssertThrow(L.is_super && L.is_ll, dealii::ExcInternalError());
    const int n_i = n_total - n_c;
    L_cc.setZero(n_c, n_c);
    for (std::size_t s = 0; s < L.nsuper; ++s)
      {
        const Supernode node(L, s, n_i);
        for (int j = node.n; j < node.columns.cols(); ++j)
          for (int k = j; k < node.columns.rows(); ++k)
            L_cc(node.rows[k] - n_i, node.first + j - n_i) = node.columns(k, j);
      }
  }



  // S = L_cc L_cc^T
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
          const int width = std::min(panel_width, n - first);
          const int next  = first + width;
          solve_lower(L.block(first, first, width, width), "N", &x[first]);
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
          solve_lower(L.block(first, first, width, width), "T", &x[first]);
        }
    }
  } // namespace



  // S x = L_cc (L_cc^T x), without S
  Eigen::VectorXd
  Condensation::schur_product(const Eigen::VectorXd &x) const
  {
    if (n_c == 0)
      return x;
    Eigen::VectorXd y = L_cc.transpose().triangularView<Eigen::Upper>() * x;
    return L_cc.triangularView<Eigen::Lower>() * y;
  }



  // S^-1 b = L_cc^-T (L_cc^-1 b): in every iteration of the linear solver, and
  // most of its time.
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



  // With P K P^T = L L^T the rows i of L y = P r give y_i = L_ii^-1 (P r)_i,
  // and what those above the condensed rows leave is
  //   r_c - L_ci y_i = r_c - K_ci K_ii^-1 r_i.
  Condensation::Condensed
  Condensation::forward(const Eigen::VectorXd &r) const
  {
    Eigen::VectorXd x   = r(permutation), change;
    const int       n_i = n_total - n_c;
    for (std::size_t s = 0; n_total > 0 && s < cholmod->factor->nsuper; ++s)
      {
        const Supernode node(*cholmod->factor, s, n_i);
        if (node.n == 0)
          break;
        solve_lower(node.diagonal, "N", &x[node.first]);
        if (node.n_below == 0)
          continue; // BLAS refuses empty matrices
        change.noalias() = node.below * x.segment(node.first, node.n);
        for (int k = 0; k < node.n_below; ++k)
          x[node.rows[node.n + k]] -= change[k];
      }
    return {x.tail(n_c), x.head(n_i)};
  }



  // L_ii^T x_i = y_i - L_ci^T x_c, from the last supernode to the first: the
  // rows below a supernode are known when its turn comes.
  Eigen::VectorXd
  Condensation::backward(const Eigen::VectorXd &x_c,
                         const Eigen::VectorXd &interior) const
  {
    Eigen::VectorXd x       = Eigen::VectorXd::Zero(n_total), known;
    x.head(interior.size()) = interior;
    x.tail(n_c)             = x_c;
    for (std::size_t s = n_total > 0 ? cholmod->factor->nsuper : 0; s-- > 0;)
      {
        const Supernode node(*cholmod->factor, s, n_total - n_c);
        if (node.n == 0)
          continue; // all of it is condensed
        known.resize(node.n_below);
        for (int k = 0; k < node.n_below; ++k)
          known[k] = x[node.rows[node.n + k]];
        if (node.n_below > 0)
          x.segment(node.first, node.n).noalias() -=
            node.below.transpose() * known;
        solve_lower(node.diagonal, "T", &x[node.first]);
      }
    Eigen::VectorXd result(n_total);
    result(permutation) = x;
    return result;
  }
} // namespace Debond
