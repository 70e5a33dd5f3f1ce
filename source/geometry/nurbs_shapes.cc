#include <debond/geometry/nurbs_surface.h>

#include <Eigen/LU>

#include <algorithm>
#include <cassert>
#include <cmath>

// Refinement by knots, caps and rectangles.
namespace Debond
{
  namespace
  {
    /** The surface with weights 1 and the control points position(u_i, v_j).
     */
    template <typename Position>
    NurbsSurface
    unweighted(const KnotVector          &knots_1,
               const KnotVector          &knots_2,
               const std::vector<double> &u,
               const std::vector<double> &v,
               const Position            &position)
    {
      ControlNet net(3, u.size() * v.size());
      for (unsigned int j = 0; j < v.size(); ++j)
        for (unsigned int i = 0; i < u.size(); ++i)
          net.col(j * u.size() + i) = position(u[i], v[j]);
      return NurbsSurface(knots_1,
                          knots_2,
                          net,
                          std::vector<double>(net.cols(), 1.));
    }
  } // namespace



  NurbsSurface
  NurbsSurface::insert_knot(const unsigned int direction,
                            const double       knot) const
  {
    assert(direction <= 1 && knot > 0. && knot < 1.);

    const std::vector<double> &U = knot_vectors[direction].knots();
    std::vector<double>        refined(U);
    refined.insert(std::upper_bound(refined.begin(), refined.end(), knot),
                   knot);
    std::array<KnotVector, 2> new_knots = knot_vectors;
    new_knots[direction]                = KnotVector(degree(), refined);

    const unsigned int  old_n = knot_vectors[0].n_basis_functions();
    const unsigned int  n_1   = new_knots[0].n_basis_functions();
    const unsigned int  n_2   = new_knots[1].n_basis_functions();
    ControlNet          new_points(3, n_1 * n_2);
    std::vector<double> new_weights(n_1 * n_2);

    // Rational surfaces are B-splines in the coordinates (w x, w). Boehm's
    // ratio says where the new coefficient lies between two old ones, of which
    // the one with no share need not exist.
    for (unsigned int j = 0; j < n_2; ++j)
      for (unsigned int i = 0; i < n_1; ++i)
        {
          const unsigned int to = j * n_1 + i, d = direction == 0 ? i : j;
          const double       end     = U[d + degree()];
          const double       alpha   = end <= knot  ? 1. :
                                       U[d] >= knot ? 0. :
                                                      (knot - U[d]) / (end - U[d]);
          const unsigned int step    = (direction == 0 ? 1 : old_n);
          const unsigned int a       = j * old_n + i - (alpha < 1. ? step : 0);
          const unsigned int b       = j * old_n + i - (alpha > 0. ? 0 : step);
          const double       share_a = (1. - alpha) * weight[a];
          const double       share_b = alpha * weight[b];
          const double       w       = share_a + share_b;
          new_weights[to]            = w;
          new_points.col(to) =
            share_a / w * points.col(a) + share_b / w * points.col(b);
        }
    return NurbsSurface(new_knots[0], new_knots[1], new_points, new_weights);
  }



  double
  height_on_sphere(const double r, const double sphere_radius)
  {
    return r * r /
           (sphere_radius + std::sqrt(sphere_radius * sphere_radius - r * r));
  }



  namespace
  {
    /** Values of all functions of a direction at its Greville abscissae. */
    Eigen::MatrixXd
    collocation(const KnotVector &knots)
    {
      const std::vector<double> u = knots.greville_abscissae();
      Eigen::MatrixXd           B = Eigen::MatrixXd::Zero(u.size(), u.size());
      for (unsigned int i = 0; i < u.size(); ++i)
        {
          const unsigned int    span   = knots.span_of(u[i]);
          const BernsteinValues values = knots.evaluate(span, u[i]);
          for (unsigned int k = 0; k <= knots.degree(); ++k)
            B(i, knots.first_basis_function(span) + k) = values.B[k];
        }
      return B;
    }
  } // namespace



  // With W the sum of all w_A N_A, the products W x and W z are B-splines whose
  // coefficients are w_A x_A and w_A z_A: the interpolation is a tensor product
  // although the weights are none.
  NurbsSurface
  NurbsSurface::raised_to_sphere(const double radius) const
  {
    const std::array<Eigen::MatrixXd, 2> B{
      {collocation(knot_vectors[0]), collocation(knot_vectors[1])}};
    using Table      = Eigen::ArrayXXd; // of all control points or abscissae
    const auto table = [&B](const auto &row) -> Table {
      return row.reshaped(B[0].rows(), B[1].rows()).array();
    };
    const Table w = table(Eigen::VectorXd::Map(weight.data(), weight.size()));
    const auto  interpolant = [&B](const Table &coefficients) -> Table {
      return (B[0] * coefficients.matrix() * B[1].transpose()).array();
    };
    const Table W = interpolant(w);
    const Table r_squared =
      (interpolant(w * table(points.row(0))) / W).square() +
      (interpolant(w * table(points.row(1))) / W).square();
    const Table height = r_squared.unaryExpr([radius](const double r2) {
      return height_on_sphere(std::min(radius, std::sqrt(r2)), radius);
    });
    const Eigen::MatrixXd columns = B[0].lu().solve((W * height).matrix());
    const Table           z =
      B[1].lu().solve(columns.transpose()).transpose().array() / w;
    NurbsSurface result  = *this;
    result.points.row(2) = z.reshaped().transpose();
    return result;
  }



  NurbsSurface
  NurbsSurface::cap(const double       R,
                    const double       cap_radius,
                    const unsigned int n)
  {
    return disk(R, n).raised_to_sphere(cap_radius);
  }



  NurbsSurface
  NurbsSurface::rectangle(const double      lx,
                          const double      ly,
                          const KnotVector &knots_1,
                          const KnotVector &knots_2)
  {
    assert(lx > 0. && ly > 0.);

    return unweighted(knots_1,
                      knots_2,
                      knots_1.greville_abscissae(),
                      knots_2.greville_abscissae(),
                      [&](const double u, const double v) {
                        return Eigen::Vector3d((u - 0.5) * lx,
                                               (v - 0.5) * ly,
                                               0.);
                      });
  }



  NurbsSurface
  NurbsSurface::bilinear_interpolant() const
  {
    const auto &u = knot_vectors[0].breakpoints(),
               &v = knot_vectors[1].breakpoints();
    return unweighted(KnotVector::from_breakpoints(1, u),
                      KnotVector::from_breakpoints(1, v),
                      u,
                      v,
                      [&](const double u, const double v) {
                        return point(Eigen::Vector2d(u, v));
                      });
  }



  Eigen::Vector3d
  interpolate(const SurfaceBasis &basis, const ControlNet &control_points)
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (unsigned int a = 0; a < basis.size; ++a)
      sum += basis.N[a] * control_points.col(basis.control_point[a]);
    return sum;
  }
} // namespace Debond
