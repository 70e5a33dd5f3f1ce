#include <debond/bulk/condensation.h>
#include <debond/support/runtime.h>

#include <deal.II/base/exceptions.h>

#include <Eigen/CholmodSupport>

#include <algorithm>
#include <mutex>
#include <new>

// Static condensation by a sparse Cholesky factorisation: how a body of many
// unknowns becomes the small matrix S that the contact face feels, section 9 of
// doc/developers/walk.md.
//
// K [N/mm] is the stiffness of one body, i its interior unknowns and c those of
// the contact face. Gaussian elimination of a symmetric positive definite K, in
// an order with c last, writes
//
//   ( K_ii  K_ic )   ( L_ii       ) ( L_ii^T  L_ci^T )
//   ( K_ci  K_cc ) = ( L_ci  L_cc ) (         L_cc^T ),
//
// from which S = K_cc - K_ci K_ii^-1 K_ic = L_cc L_cc^T. So one factor serves
// for everything: L_cc for S and its inverse, L_ii and L_ci for what the
// interior has to do with them. The textbook's recipe, to solve with K_ii for
// each column of K_ic, would take n_c solves and the same memory for S.
//
// deal.II's SparseDirectUMFPACK could solve with K, but shows nobody its
// factor; so CHOLMOD is called directly.
namespace Debond
{
  /** CHOLMOD's workspace and factor, released with the object. */
  struct Condensation::Cholmod
  {
    cholmod_common  common;
    cholmod_factor *factor = nullptr;

    Cholmod()
    {
      // Supernodal: columns with the same pattern are stored and eliminated as
      // dense blocks, most of the work is done by BLAS, and the blocks can be
      // read below. One method of ordering only, since it is said below which.
      // A pivot that is not positive ends the factorisation, and it says so by
      // its status: messages of its own would go to the console.
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
      // A given ordering must stay as it is: the condensed unknowns are last
      // and the others are already postordered. Without one METIS finds it, by
      // nested dissection: it cuts the mesh into halves, numbers the cut last,
      // and goes on with the halves.
      // No copy: CHOLMOD reads Eigen's arrays, and of the matrix the lower
      // triangle.
      common.postorder = !given;
      auto A = Eigen::viewAsCholmod(K.selfadjointView<Eigen::Lower>());
      factor = cholmod_analyze_p(&A, given, nullptr, 0, &common);
      if (factor == nullptr) // or it has more entries than int can count
        throw std::bad_alloc();
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
    // They may round differently from one (doc/explanation/solution.md,
    // Threads), which is another reason to leave small systems alone.
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
            // Both numberings ascend, so that the lower triangle stays the
            // lower one and rows stay sorted, as insertBack() asks for.
            if (interior_index[k.row()] >= 0)
              B.insertBack(interior_index[k.row()], j) = k.value();
        }
      B.finalize();
      return B;
    }



    /** A dense part of the factor, columns some stride apart. */
    using Block = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;



    // x <- L^-1 x or L^-T x, in place. Eigen would do this itself, but without
    // the processor's wide instructions. BLAS works column by column with a
    // stride, so that blocks of the factor need no copy.
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
      // CHOLMOD's arrays, by supernode s: super, its first column; pi and px,
      // where its row numbers begin in s and its entries in x. The entries are
      // a dense matrix, column by column, the first rows of which are the
      // columns' own.
      //
      // The boundary between interior and contact may lie within a supernode,
      // as CHOLMOD does not know of it. n columns are interior ones, from none
      // to all of them; `diagonal` is their part of L_ii, and `below` what they
      // do to later rows, interior ones and contact ones alike.
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



    // Columns of a large triangle that are solved for at a time: small enough
    // for the cache, large enough for several threads to share the rest.
    constexpr int panel_width = 256;

    // x <- L^-1 x for a large triangle L, panel by panel, in threads. A
    // triangular solve is a chain in which each unknown waits for those before.
    // But only the triangle on the diagonal of a panel is one; the rows below
    // take their part of the panel's solution each by itself, in threads. As
    // every row is written by one thread, sums do not depend on how many there
    // are.
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



    // x <- L^-T x, from the last panel to the first. Columns of L are rows of
    // L^T: here each chunk of the panel's unknowns takes what those below
    // contribute before the triangle is solved for.
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



  // K_cc - K_ci K_ii^-1 K_ic is what Gaussian elimination of the interior
  // leaves of K_cc. So if the condensed unknowns are eliminated last, S never
  // has to be formed by solving with K_ii for each of its columns: its Cholesky
  // factor L_cc is the last block of that of K. All that takes is an ordering
  // in which they are last and the others as good as they can be.
  //
  // The price is that L_cc is dense: its memory, and the time of a solve with
  // it, grow with n_c^2, the time to form it with n_c^3. That is why only
  // control points which contact can reach are unknowns.
  bool
  Condensation::factorise(const SymmetricSparseMatrix &K,
                          const std::vector<int>      &condensed)
  {
    n_total = K.rows();
    n_c     = condensed.size();

    // The interior, in ascending order: interior_index leads from the numbers
    // of K to those of K_ii, -1 marks the contact unknowns.
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
    // METIS is asked about K_ii because it would not keep c last in K. The
    // symbolic factor is only needed for its permutation; it is released at the
    // end of the block.
    // METIS draws its random numbers from the one sequence of the C library,
    // which it begins anew: two threads would take numbers from each other.
    permutation.clear();
    if (!interior.empty())
      {
        static std::mutex                 one_at_a_time;
        const std::lock_guard<std::mutex> lock(one_at_a_time);
        Cholmod                           symbolic;
        symbolic.analyse(interior_block(K, interior_index, interior), nullptr);
        for (unsigned int k = 0; k < interior.size(); ++k)
          permutation.push_back(interior[symbolic.permutation()[k]]);
      }
    permutation.insert(permutation.end(), condensed.begin(), condensed.end());

    // P K P^T = L L^T in that order. Copies of this object share the factor,
    // which is not changed any more.
    // All that follows rests on the order. A library that improved on it would
    // give a wrong S without any other sign.
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
    // `minor` is the column at which a factorisation stopped, n if it did not.
    // Thin cells or a Poisson's ratio close to 0.5 may do that, or, with a
    // Neo-Hookean bulk, a state that is far from equilibrium.
    if (next->common.status != CHOLMOD_OK ||
        next->factor->minor != next->factor->n)
      return false;
    extract_trailing_block();
    return L_cc.allFinite(); // a matrix with NaN passes all pivots
  }



  // L_cc, which begins within a supernode: the columns that are not interior
  // ones. It is copied into an ordinary matrix, since the triangular solves
  // with it are most of the time of the linear solver, and go through memory in
  // one piece then. Only its lower triangle is filled.
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
        // Entry by entry: the rows of a supernode are numbers, which need not
        // be neighbours. All of them belong to contact unknowns, since nothing
        // comes after c.
        for (int j = node.n; j < node.columns.cols(); ++j)
          for (int k = j; k < node.columns.rows(); ++k)
            L_cc(node.rows[k] - n_i, node.first + j - n_i) = node.columns(k, j);
      }
  }



  // S = L_cc L_cc^T, as a full symmetric matrix, for a system that has to be
  // assembled (CoupledTangent::assemble). It is not kept, as it is as large as
  // L_cc.
  Eigen::MatrixXd
  Condensation::schur_complement() const
  {
    // A symmetric product: one half is computed and mirrored.
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n_c, n_c);
    if (n_c == 0)
      return S; // BLAS refuses empty matrices
    S.selfadjointView<Eigen::Lower>().rankUpdate(L_cc);
    S.triangularView<Eigen::StrictlyUpper>() = S.transpose();
    return S;
  }



  // S x = L_cc (L_cc^T x), without S: a product with two triangles costs as
  // much as one with S, and there is no S to be stored.
  Eigen::VectorXd
  Condensation::schur_product(const Eigen::VectorXd &x) const
  {
    if (n_c == 0)
      return x;
    Eigen::VectorXd y = L_cc.transpose().triangularView<Eigen::Upper>() * x;
    return L_cc.triangularView<Eigen::Lower>() * y;
  }



  // S^-1 b = L_cc^-T (L_cc^-1 b): in every iteration of the linear solver, and
  // most of its time. It is the compliance of the body [mm/N]: where the face
  // goes under the nodal forces b.
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
  //
  //   r_c - L_ci y_i = r_c - K_ci K_ii^-1 r_i.
  //
  // For a Neo-Hookean body r are the true forces, and the interior's imbalance
  // r_i is handed on to the face that way: as if the interior, held at the
  // face, gave in to it. y_i is kept, so that the second half of the solve does
  // not begin anew.
  Condensation::Condensed
  Condensation::forward(const Eigen::VectorXd &r) const
  {
    Eigen::VectorXd x   = r(permutation), change;
    const int       n_i = n_total - n_c;
    for (std::size_t s = 0; n_total > 0 && s < cholmod->factor->nsuper; ++s)
      {
        const Supernode node(*cholmod->factor, s, n_i);
        // Supernodes from here on are condensed unknowns altogether.
        if (node.n == 0)
          break;
        // The columns' own part of L y = P r, and what it takes from the rows
        // further down. These are not neighbours, so the product goes through a
        // vector of its own.
        solve_lower(node.diagonal, "N", &x[node.first]);
        if (node.n_below == 0)
          continue; // BLAS refuses empty matrices
        change.noalias() = node.below * x.segment(node.first, node.n);
        for (int k = 0; k < node.n_below; ++k)
          x[node.rows[node.n + k]] -= change[k];
      }
    // The end of x has been reduced by all interior columns and by none of the
    // contact ones: it is the condensed vector.
    return {x.tail(n_c), x.head(n_i)};
  }



  // L_ii^T x_i = y_i - L_ci^T x_c, from the last supernode to the first: the
  // rows below a supernode are known when its turn comes. That is x_i = K_ii^-1
  // (r_i - K_ic x_c), how the interior follows the face. The interior of a
  // linear body is recovered when somebody looks at it, and not in every
  // iteration; that of a Neo-Hookean one with every correction. An empty
  // interior stands for r_i = 0.
  Eigen::VectorXd
  Condensation::backward(const Eigen::VectorXd &x_c,
                         const Eigen::VectorXd &interior) const
  {
    Eigen::VectorXd x       = Eigen::VectorXd::Zero(n_total), known;
    x.head(interior.size()) = interior;
    x.tail(n_c)             = x_c;
    for (std::size_t s = n_total > 0 ? cholmod->factor->nsuper : 0; s-- > 0;)
      {
        // Rows further down have been solved for already, or are the given x_c:
        // their part goes to the right-hand side.
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
    // Back from the order of the factor to that of K.
    Eigen::VectorXd result(n_total);
    result(permutation) = x;
    return result;
  }
} // namespace Debond
