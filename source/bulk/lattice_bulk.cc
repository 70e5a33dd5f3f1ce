#include <debond/bulk/bulk_solvers.h>
#include <debond/bulk/neo_hookean.h>
#include <debond/support/input_error.h>
#include <debond/support/runtime.h>

#include <deal.II/base/exceptions.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <type_traits>

// The exact solver of a block of equal splines: sines and cosines across
// diagonalise its stiffness, and what is left along the depth is a banded
// matrix for each pair of wave numbers.
//
// The sides of the bone slide along themselves: they are mirrors. A function of
// quadratic splines over n equal spans that goes on even (slope zero at the
// sides) or odd (value zero) beyond both mirrors has n coefficients c_i, i = 0,
// ..., n-1. Along x they are those of the control points P_{i+1}; at the sides
// P_0 = P_1 and P_{n+1} = P_n in an even function, 0 in an odd one. In
//
//   c_i = cos(theta_p (i + 1/2)), even, or sin(theta_p (i + 1/2)), odd,
//   theta_p = p pi / n, p = 0, ..., n,
//
// all matrices of such a function are diagonal: on an endless lattice they are
// convolutions, and the Gauss points, two in each span, are mirror images, too.
// The displacement across a mirror is odd, those along it are even. So P_0 =
// P_1, no shear at the sides, is what a solution fulfils; condensed bulks,
// whose P_0 is free, find it in the limit of fine cells only.
//
// For wave numbers (p, q) the motions
//
//   u = U(z) sin cos, v = V(z) cos sin, w = W(z) cos cos
//
// are coupled with no other ones. U, V, W have a coefficient each at every
// level of control points but the last, which is held. Young's modulus may
// depend on the depth: it is a factor in the integrals along it.
extern "C"
{
  void
  dpbtrf_(const char *uplo,
          const int  *n,
          const int  *kd,
          double     *ab,
          const int  *ldab,
          int        *info);
  void
  dpbtrs_(const char   *uplo,
          const int    *n,
          const int    *kd,
          const int    *nrhs,
          const double *ab,
          const int    *ldab,
          double       *b,
          const int    *ldb,
          int          *info);
}



namespace Debond
{
  namespace
  {
    /** Integrals of products of functions over a length, by two Gauss points in
     *  each span, at which a factor may weigh them. */
    struct Integrals
    {
      Eigen::MatrixXd values;      ///< of N_a N_b
      Eigen::MatrixXd slopes;      ///< of N_a' N_b'
      Eigen::MatrixXd slope_value; ///< of N_a' N_b
    };



    Integrals
    integrals_of(const KnotVector                                  &splines,
                 const double                                       length,
                 const std::function<double(unsigned int, double)> &factor)
    {
      const unsigned int n = splines.n_basis_functions();
      Integrals          result;
      result.values = result.slopes = result.slope_value =
        Eigen::MatrixXd::Zero(n, n);
      for (unsigned int span = 0; span < splines.n_spans(); ++span)
        for (const double side : {-1., 1.})
          {
            const double begin = splines.breakpoints()[span],
                         width = splines.breakpoints()[span + 1] - begin;
            const auto N       = splines.evaluate(
              span, begin + 0.5 * width * (1. + side / std::sqrt(3.)));
            const double          weight = 0.5 * width * factor(span, side);
            const unsigned int    first  = splines.first_basis_function(span);
            const Eigen::Vector3d dN     = N.dB / length;
            result.values.block<3, 3>(first, first) +=
              weight * length * N.B * N.B.transpose();
            result.slopes.block<3, 3>(first, first) +=
              weight * length * dN * dN.transpose();
            result.slope_value.block<3, 3>(first, first) +=
              weight * length * dN * N.B.transpose();
          }
      return result;
    }



    /** The splines of one direction across in waves. */
    struct Waves
    {
      unsigned int    n;              ///< spans
      Eigen::MatrixXd cosines, sines; ///< orthonormal columns p = 0, ..., n
      /** Of waves p with themselves: integrals of values, of slopes, and of the
       *  slope of the sine with the cosine. */
      Eigen::ArrayXd values, slopes, slope_value;

      Waves(const unsigned int n_spans, const double length)
        : n(n_spans)
        , cosines(n, n + 1)
        , sines(n, n + 1)
      {
        for (unsigned int p = 0; p <= n; ++p)
          {
            const double unit =
              std::sqrt((p == 0 || p == n ? 1. : 2.) / double(n));
            for (unsigned int i = 0; i < n; ++i)
              {
                // whole turns taken away first, for the last digits
                const unsigned int turn  = p * (2 * i + 1) % (4 * n);
                const double       angle = turn * (0.5 * M_PI / n);
                cosines(i, p)            = p == n ? 0. : unit * std::cos(angle);
                sines(i, p)              = p == 0 ? 0. : unit * std::sin(angle);
              }
          }
        // a function far from the ends and its neighbours
        const Integrals common =
          integrals_of(KnotVector::graded(2, 7),
                       7. * length / n,
                       [](unsigned int, double) { return 1.; });
        const Eigen::ArrayXd theta = Eigen::ArrayXd::LinSpaced(n + 1, 0., M_PI);
        values.setConstant(n + 1, common.values(3, 3));
        slopes.setConstant(n + 1, common.slopes(3, 3));
        slope_value.setZero(n + 1);
        for (const int k : {1, 2})
          {
            values += 2. * common.values(3, 3 + k) * (k * theta).cos();
            slopes += 2. * common.slopes(3, 3 + k) * (k * theta).cos();
            slope_value -=
              2. * common.slope_value(3, 3 + k) * (k * theta).sin();
          }
      }
    };



    /** The three components of a motion of one level: a row for each
     *  coefficient or wave along x, a column along y. */
    using Level = std::array<Eigen::MatrixXd, 3>;
    /** A component of a vector over n_1 x n_2 control points, const or not. */
    template <typename Vector>
    auto
    component(Vector &x, const unsigned int c, const unsigned int n_1)
    {
      using Matrix = std::conditional_t<std::is_const_v<Vector>,
                                        const Eigen::MatrixXd,
                                        Eigen::MatrixXd>;
      using Stride = Eigen::Stride<Eigen::Dynamic, 3>;
      return Eigen::Map<Matrix, 0, Stride>(x.data() + c,
                                           n_1,
                                           x.size() / (3 * n_1),
                                           Stride(3 * n_1, 3));
    }
    /** A 3 x 3 matrix for each pair of waves. */
    using WaveMatrices = std::array<std::array<Eigen::ArrayXXd, 3>, 3>;



    class LatticeBulk : public CondensingBulk
    {
    public:
      LatticeBulk(const BulkSpace &mesh, EnrichedCells &&cells_of_mesh)
        : CondensingBulk(mesh, std::move(cells_of_mesh))
        , across{{Waves(mesh.parameters().cells[0], mesh.parameters().size[0]),
                  Waves(mesh.parameters().cells[1], mesh.parameters().size[1])}}
        , along_depth(
            integrals_of(mesh.depth(),
                         mesh.parameters().thickness(),
                         [&](const unsigned int span, const double side) {
                           return factor_of_layer(span, side < 0. ? 4 : 0);
                         }))
        , n_levels(mesh.depth().n_basis_functions() - 1)
        , at_rest(NeoHookean::from_young(mesh.parameters().young_modulus,
                                         mesh.parameters().poisson_ratio))
      {}

      // All coefficients of the face: what a wave displaces.
      std::vector<unsigned int>
      set_contact(const std::vector<bool> &control_points) override
      {
        const unsigned int n_1 = across[0].n + 2;
        unknowns.clear();
        for (unsigned int A = 0; A < control_points.size(); ++A)
          {
            const unsigned int i = A % n_1, j = A / n_1;
            const bool         is_at_side =
              i == 0 || i > across[0].n || j == 0 || j > across[1].n;
            if (is_at_side && control_points[A])
              throw EntryError("Expert / Bone / Solver",
                               "the implant comes to the side of the bone, "
                               "where this solver has no unknowns: expected "
                               "direct, or a wider Bone / Size");
            for (unsigned int c = 0; c < 3 && !is_at_side; ++c)
              unknowns.push_back(3 * mesh.control_point_node(A) + c);
          }
        return unknowns;
      }

      // The stiffness stays that at rest, whatever the displacement and
      // whatever is in contact: that of a linear body, and a frozen tangent of
      // a Neo-Hookean one.
      bool
      linearise(const Eigen::VectorXd &) override
      {
        if (stiffness[0][0].size() > 0)
          return true;
        WaveMatrices S;
        for (WaveMatrices *const matrices : {&S, &flexibility})
          for (auto &row : *matrices)
            for (Eigen::ArrayXXd &entry : row)
              entry.resize(across[0].n + 1, across[1].n + 1);
        const bool is_positive =
          for_each_wave([&](const auto p, const auto q, const Column &factor) {
            // the face is eliminated last: its part of the factor is that of S
            const unsigned int first = 3 * (n_levels - 1);
            Eigen::Matrix3d    L     = Eigen::Matrix3d::Zero();
            for (unsigned int j = 0; j < 3; ++j)
              for (unsigned int i = j; i < 3; ++i)
                L(i, j) = factor(i - j, first + j);
            const Eigen::Matrix3d S_pq = L * L.transpose(),
                                  F_pq = S_pq.inverse();
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                {
                  S[i][j](p, q)           = S_pq(i, j);
                  flexibility[i][j](p, q) = F_pq(i, j);
                }
          });
        if (is_positive)
          stiffness = std::move(S);
        return is_positive;
      }

      Eigen::VectorXd
      product(const Eigen::VectorXd &x) const override
      {
        return multiplied(stiffness, x);
      }
      Eigen::VectorXd
      solve(const Eigen::VectorXd &b) const override
      {
        return multiplied(flexibility, b);
      }
      // Nearly all of its entries would be there, of thousands of unknowns.
      bool
      is_dense() const override
      {
        return false;
      }
      Eigen::MatrixXd
      dense_stiffness() const override
      {
        AssertThrow(false, dealii::ExcInternalError());
        return {};
      }

      // With y = K^-1 r it is S y_c.
      Bulk::Residual
      condense(const Eigen::VectorXd &r) const override
      {
        Bulk::Residual     result;
        std::vector<Level> levels;
        for (unsigned int level = 0; level < n_levels; ++level)
          {
            levels.push_back(zero_level());
            for_each_dof(level,
                         levels.back(),
                         [&](const unsigned int dof, double &sum) {
                           sum += r[dof];
                         });
            for (const Eigen::MatrixXd &component : levels.back())
              {
                result.norm_squared += component.squaredNorm();
                if (level > 0)
                  result.interior_squared += component.squaredNorm();
              }
          }
        result.interior  = solved(levels);
        result.condensed = product(result.interior(unknowns));
        return result;
      }

      // dv_i = -K_ii^-1 (r_i + K_ic dv_c) is what -y and forces S (dv_c + y_c)
      // on the face make of it.
      Eigen::VectorXd
      correction(const Eigen::VectorXd &dv_c, const Residual &r) const override
      {
        Eigen::VectorXd at_face = dv_c;
        if (r.interior.size() > 0)
          at_face += r.interior(unknowns);
        std::vector<Level>    levels(n_levels, zero_level());
        const Eigen::VectorXd forces = product(at_face);
        for (unsigned int c = 0; c < 3; ++c)
          levels[0][c] = component(forces, c, across[0].n);
        Eigen::VectorXd dv = solved(levels);
        if (r.interior.size() > 0)
          dv -= r.interior;
        dv(unknowns) = dv_c; // to the last bit
        return dv;
      }

    private:
      /** The stiffness of a pair of waves, U, V, W level by level with the face
       *  last, or its Cholesky factor, as LAPACK stores a band: entry (i, j),
       *  i >= j, in row i - j of column j. Three levels are coupled. */
      static constexpr int half_band = 8;
      using Column = Eigen::Matrix<double, half_band + 1, Eigen::Dynamic>;

      /** Of Young's modulus, the mean over the Gauss points of a layer from
       *  @p q to q + 3, which are at the same depth. */
      double
      factor_of_layer(const unsigned int layer, const unsigned int q) const
      {
        double sum = 0.;
        for (unsigned int cell = 0; cell < cells.n_cells(); ++cell)
          if (mesh.cells()[cell].layer == layer)
            sum += cells.stiffness_factors(cell).segment<4>(q).mean();
        return sum / (across[0].n * across[1].n);
      }

      Level
      zero_level() const
      {
        const Eigen::MatrixXd zero =
          Eigen::MatrixXd::Zero(across[0].n, across[1].n);
        return {{zero, zero, zero}};
      }

      /** The functions of component c along x (0) or y (1). */
      const Eigen::MatrixXd &
      waves(const unsigned int c, const unsigned int direction) const
      {
        return c == direction ? across[direction].sines :
                                across[direction].cosines;
      }
      /** work(component), in threads. */
      template <typename Work>
      static void
      for_each_component(const Work &work)
      {
        for_each_chunk(3, [&](unsigned int, unsigned int c, const auto end) {
          for (; c < end; ++c)
            work(c);
        });
      }
      void
      to_waves(Level &level) const
      {
        for_each_component([&](const unsigned int c) {
          level[c] = waves(c, 0).transpose() * (level[c] * waves(c, 1));
        });
      }
      void
      from_waves(Level &level) const
      {
        for_each_component([&](const unsigned int c) {
          level[c] = waves(c, 0) * (level[c] * waves(c, 1).transpose());
        });
      }

      /** A product with a matrix for each pair of waves. */
      Eigen::VectorXd
      multiplied(const WaveMatrices &matrices, const Eigen::VectorXd &x) const
      {
        Level           level, product;
        Eigen::VectorXd result(x.size());
        for (unsigned int c = 0; c < 3; ++c)
          level[c] = component(x, c, across[0].n);
        to_waves(level);
        for (unsigned int c = 0; c < 3; ++c)
          product[c] = matrices[c][0] * level[0].array() +
                       matrices[c][1] * level[1].array() +
                       matrices[c][2] * level[2].array();
        from_waves(product);
        for (unsigned int c = 0; c < 3; ++c)
          component(result, c, across[0].n) = product[c];
        return result;
      }

      /** work(degree of freedom, entry of its motion). That of the sides is
       *  that of their neighbours. */
      template <typename Work>
      void
      for_each_dof(const unsigned int level,
                   Level             &motion,
                   const Work        &work) const
      {
        const unsigned int n_1 = across[0].n, n_2 = across[1].n;
        const unsigned int first =
          level == 0 ? mesh.control_point_node(0) :
                       (level - 1) * mesh.surface().n_control_points();
        for (unsigned int j = 0; j < n_2 + 2; ++j)
          for (unsigned int i = 0; i < n_1 + 2; ++i)
            for (unsigned int c = 0; c < 3; ++c)
              {
                const unsigned int node = first + i + (n_1 + 2) * j;
                if (!mesh.is_fixed(node, c))
                  work(3 * node + c,
                       motion[c](std::clamp(i, 1u, n_1) - 1,
                                 std::clamp(j, 1u, n_2) - 1));
              }
      }

      /** K^-1 b over all nodes, b by levels. */
      Eigen::VectorXd
      solved(std::vector<Level> &b) const
      {
        for (Level &level : b)
          to_waves(level);
        for_each_wave([&](const auto p, const auto q, const Column &factor) {
          const int       n = 3 * n_levels, one = 1, rows = half_band + 1;
          int             info;
          Eigen::VectorXd x(n);
          for (int k = 0; k < n; ++k)
            x[k] = b[n_levels - 1 - k / 3][k % 3](p, q);
          dpbtrs_("L",
                  &n,
                  &half_band,
                  &one,
                  factor.data(),
                  &rows,
                  x.data(),
                  &n,
                  &info);
          for (int k = 0; k < n; ++k)
            b[n_levels - 1 - k / 3][k % 3](p, q) = x[k];
        });
        Eigen::VectorXd v = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
        for (unsigned int level = 0; level < n_levels; ++level)
          {
            from_waves(b[level]);
            for_each_dof(level,
                         b[level],
                         [&](const unsigned int dof, const double motion) {
                           v[dof] = motion;
                         });
          }
        return v;
      }

      /** work(p, q, Cholesky factor) for all pairs of waves, in threads. False
       *  if a matrix is not positive definite. */
      template <typename Work>
      bool
      for_each_wave(const Work &work) const
      {
        std::atomic<bool> is_positive{true};
        for_each_chunk(
          across[0].n + 1,
          [&](unsigned int, unsigned int p, const unsigned int end) {
            const int n = 3 * n_levels, rows = half_band + 1;
            int       info;
            Column    matrix;
            for (; p < end; ++p)
              for (unsigned int q = 0; q <= across[1].n && is_positive; ++q)
                {
                  assemble(p, q, matrix);
                  dpbtrf_("L", &n, &half_band, matrix.data(), &rows, &info);
                  if (info == 0)
                    work(p, q, matrix);
                  else
                    is_positive = false;
                }
          });
        return is_positive;
      }

      // K of a pair of waves from the integrals of each direction: in
      //
      //   int Lambda N_a,i N_b,k + G N_a,k N_b,i + G d_ik grad N_a . grad N_b
      //
      // a derivative turns a sine into a cosine and a cosine into minus a sine.
      void
      assemble(const unsigned int p, const unsigned int q, Column &K) const
      {
        const auto [G, Lambda] = at_rest;
        const double m_x = across[0].values[p], m_y = across[1].values[q],
                     a_x = across[0].slopes[p] * m_y,
                     a_y = across[1].slopes[q] * m_x,
                     d_x = across[0].slope_value[p],
                     d_y = across[1].slope_value[q], m = m_x * m_y;
        // the depth goes the other way than z in the bone
        const double    sign = -mesh.outward_sign();
        Eigen::Matrix3d block;
        K.setZero(half_band + 1, 3 * n_levels);
        for (unsigned int a = 0; a < n_levels; ++a)
          for (unsigned int b = a; b < std::min(a + 3, n_levels); ++b)
            {
              // rows of level a, which is nearer to the face, columns of b
              const double M    = along_depth.values(a, b),
                           A    = along_depth.slopes(a, b),
                           D_ab = sign * along_depth.slope_value(a, b),
                           D_ba = sign * along_depth.slope_value(b, a);
              block(0, 0) = ((Lambda + 2 * G) * a_x + G * a_y) * M + G * m * A;
              block(1, 1) = ((Lambda + 2 * G) * a_y + G * a_x) * M + G * m * A;
              block(2, 2) = G * (a_x + a_y) * M + (Lambda + 2 * G) * m * A;
              block(0, 1) = block(1, 0) = (Lambda + G) * d_x * d_y * M;
              block(0, 2) = d_x * m_y * (Lambda * D_ba - G * D_ab);
              block(2, 0) = d_x * m_y * (Lambda * D_ab - G * D_ba);
              block(1, 2) = d_y * m_x * (Lambda * D_ba - G * D_ab);
              block(2, 1) = d_y * m_x * (Lambda * D_ab - G * D_ba);
              for (unsigned int i = 0; i < 3; ++i)
                for (unsigned int j = 0; j < 3; ++j)
                  {
                    const int row    = 3 * (n_levels - 1 - a) + i,
                              column = 3 * (n_levels - 1 - b) + j;
                    if (row >= column)
                      K(row - column, column) = block(i, j);
                  }
            }
      }

      const std::array<Waves, 2> across;
      const Integrals            along_depth;
      const unsigned int         n_levels; ///< that are not held
      const NeoHookean           at_rest;  ///< as any isotropic material
      WaveMatrices               stiffness, flexibility;
      std::vector<unsigned int>  unknowns; ///< degrees of freedom
    };
  } // namespace



  std::unique_ptr<CondensingBulk>
  make_lattice_bulk(const BulkSpace &mesh, EnrichedCells &&cells)
  {
    return std::make_unique<LatticeBulk>(mesh, std::move(cells));
  }
} // namespace Debond
