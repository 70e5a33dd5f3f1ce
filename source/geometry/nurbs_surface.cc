#include <debond/geometry/nurbs_surface.h>

#include <Eigen/LU>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

namespace Debond
{
  namespace
  {
    /**
     * Tensor product of two sets of univariate B-splines, first index fastest,
     * and, where there are weights, Eq. (34) of the paper: R_A = w_A N_A / W
     * with W = sum_B w_B N_B. The derivatives follow from those of R_A W = w_A
     * N_A. The degree is a template argument for the loops to be unrolled.
     */
    template <unsigned int p, bool second_derivatives>
    void
    fill_basis(const BernsteinValues     &first,
               const BernsteinValues     &second,
               const std::vector<double> *weights,
               SurfaceBasis              &basis)
    {
      constexpr unsigned int n = p + 1, size = n * n;
      basis.size = size;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int k = j * n + i;
            basis.N[k]           = first.B[i] * second.B[j];
            basis.N_1[k]         = first.dB[i] * second.B[j];
            basis.N_2[k]         = first.B[i] * second.dB[j];
            if (second_derivatives)
              {
                basis.N_11[k] = first.ddB[i] * second.B[j];
                basis.N_12[k] = first.dB[i] * second.dB[j];
                basis.N_22[k] = first.B[i] * second.ddB[j];
              }
          }
      if (weights == nullptr)
        return;

      double W = 0., W_1 = 0., W_2 = 0., W_11 = 0., W_12 = 0., W_22 = 0.;
      for (unsigned int k = 0; k < size; ++k)
        {
          const double w = (*weights)[basis.control_point[k]];
          W += basis.N[k] *= w;
          W_1 += basis.N_1[k] *= w;
          W_2 += basis.N_2[k] *= w;
          if (second_derivatives)
            {
              W_11 += basis.N_11[k] *= w;
              W_12 += basis.N_12[k] *= w;
              W_22 += basis.N_22[k] *= w;
            }
        }
      const double inverse_W = 1. / W;
      for (unsigned int k = 0; k < size; ++k)
        {
          const double R   = basis.N[k] *= inverse_W;
          const double R_1 = basis.N_1[k] =
            (basis.N_1[k] - R * W_1) * inverse_W;
          const double R_2 = basis.N_2[k] =
            (basis.N_2[k] - R * W_2) * inverse_W;
          if (!second_derivatives)
            continue;
          basis.N_11[k] =
            (basis.N_11[k] - 2. * R_1 * W_1 - R * W_11) * inverse_W;
          basis.N_12[k] =
            (basis.N_12[k] - R_1 * W_2 - R_2 * W_1 - R * W_12) * inverse_W;
          basis.N_22[k] =
            (basis.N_22[k] - 2. * R_2 * W_2 - R * W_22) * inverse_W;
        }
    }



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



  NurbsSurface::NurbsSurface(const KnotVector          &knots_1,
                             const KnotVector          &knots_2,
                             const ControlNet          &control_points,
                             const std::vector<double> &weights)
    : knot_vectors{{knots_1, knots_2}}
    , points(control_points)
    , weight(weights)
  {
    if (knots_1.n_spans() == 0 || knots_2.n_spans() == 0 ||
        knots_1.degree() != knots_2.degree())
      throw std::invalid_argument(
        "A surface needs two knot vectors of the same degree.");
    if (points.cols() != n_control_points() ||
        weight.size() != n_control_points())
      throw std::invalid_argument(
        "A surface needs one control point and one weight per basis function.");
    const Eigen::Map<const Eigen::ArrayXd> w(weight.data(), weight.size());
    if (!points.allFinite() || !w.allFinite() || !(w > 0.).all())
      throw std::invalid_argument(
        "Control points and weights must be finite, and weights positive.");
    is_rational = (w != 1.).any();
  }



  unsigned int
  NurbsSurface::element_of(const Eigen::Vector2d &xi) const
  {
    // span_of() returns the first or last span beyond the ends: clamped.
    return knot_vectors[1].span_of(xi[1]) * knot_vectors[0].n_spans() +
           knot_vectors[0].span_of(xi[0]);
  }



  std::array<Eigen::Vector2d, 2>
  NurbsSurface::element_bounds(const unsigned int element) const
  {
    assert(element < n_elements());
    const unsigned int n = knot_vectors[0].n_spans();
    const double      *u = knot_vectors[0].breakpoints().data() + element % n;
    const double      *v = knot_vectors[1].breakpoints().data() + element / n;
    return {{Eigen::Vector2d(u[0], v[0]), Eigen::Vector2d(u[1], v[1])}};
  }



  void
  NurbsSurface::evaluate(const Eigen::Vector2d &xi,
                         SurfaceBasis          &basis,
                         const bool             second_derivatives) const
  {
    const Eigen::Vector2d clamped(std::clamp(xi[0], 0., 1.),
                                  std::clamp(xi[1], 0., 1.));
    evaluate_in_element(element_of(clamped),
                        clamped,
                        basis,
                        second_derivatives);
  }



  void
  NurbsSurface::evaluate_in_element(const unsigned int     element,
                                    const Eigen::Vector2d &xi,
                                    SurfaceBasis          &basis,
                                    const bool second_derivatives) const
  {
    assert(element < n_elements());
    const unsigned int    n        = knot_vectors[0].n_spans();
    const unsigned int    span_1   = element % n;
    const unsigned int    span_2   = element / n;
    const BernsteinValues splines1 = knot_vectors[0].evaluate(span_1, xi[0]);
    const BernsteinValues splines2 = knot_vectors[1].evaluate(span_2, xi[1]);

    basis.element             = element;
    basis.control_point       = element_control_points(element);
    const auto *const weights = is_rational ? &weight : nullptr;
    if (second_derivatives)
      (degree() == 2 ? fill_basis<2, true> :
                       fill_basis<1, true>)(splines1, splines2, weights, basis);
    else
      (degree() == 2 ?
         fill_basis<2, false> :
         fill_basis<1, false>)(splines1, splines2, weights, basis);
  }



  std::array<unsigned int, SurfaceBasis::max_size>
  NurbsSurface::element_control_points(const unsigned int element) const
  {
    assert(element < n_elements());
    const unsigned int n = knot_vectors[0].n_spans();
    const unsigned int first_1 =
      knot_vectors[0].first_basis_function(element % n);
    const unsigned int first_2 =
      knot_vectors[1].first_basis_function(element / n);
    const unsigned int stride = knot_vectors[0].n_basis_functions();
    const unsigned int p      = degree();

    std::array<unsigned int, SurfaceBasis::max_size> result{};
    unsigned int                                     k = 0;
    for (unsigned int j = 0; j <= p; ++j)
      for (unsigned int i = 0; i <= p; ++i)
        result[k++] = (first_2 + j) * stride + first_1 + i;
    return result;
  }



  Eigen::Vector3d
  NurbsSurface::point(const Eigen::Vector2d &xi) const
  {
    SurfaceBasis basis;
    evaluate(xi, basis, false);
    return interpolate(basis, points);
  }



  NurbsSurface
  NurbsSurface::insert_knot(const unsigned int direction,
                            const double       knot) const
  {
    if (direction > 1 || !(knot > 0. && knot < 1.))
      throw std::invalid_argument(
        "A knot is inserted in direction 0 or 1, strictly between 0 and 1.");

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



  NurbsSurface
  NurbsSurface::refine_uniformly(const unsigned int n1,
                                 const unsigned int n2) const
  {
    if (n_elements() != 1 || n1 == 0 || n2 == 0)
      throw std::invalid_argument(
        "Uniform refinement starts from one element and makes one at least.");

    NurbsSurface result = *this;
    for (const auto &[direction, n] : {std::pair(0U, n1), std::pair(1U, n2)})
      for (unsigned int i = 1; i < n; ++i)
        result = result.insert_knot(direction, static_cast<double>(i) / n);
    return result;
  }



  NurbsSurface
  NurbsSurface::disk(const double R, const unsigned int n)
  {
    if (!(R > 0. && std::isfinite(R)) || n == 0)
      throw std::invalid_argument(
        "A disk needs a positive radius and one element at least.");

    // Each edge is a quarter circle: middle weight cos(45 degrees), middle
    // control point where the tangents of its ends meet.
    const double s = std::sqrt(0.5), c = R * s, t = R / s;
    ControlNet   net(3, 9);
    net.row(0) << -c, 0, c, -t, 0, t, -c, 0, c;
    net.row(1) << -c, -t, -c, 0, 0, 0, c, t, c;
    net.row(2).setZero();
    const std::vector<double> w = {1, s, 1, s, 1, s, 1, s, 1};

    const KnotVector one_span = KnotVector::graded(2, 1);
    return NurbsSurface(one_span, one_span, net, w).refine_uniformly(n, n);
  }



  double
  height_on_sphere(const double r, const double sphere_radius)
  {
    return r * r /
           (sphere_radius + std::sqrt(sphere_radius * sphere_radius - r * r));
  }



  // With W the sum of all w_A N_A, the products W x and W z are B-splines whose
  // coefficients are w_A x_A and w_A z_A: the interpolation is a tensor product
  // although the weights are none.
  NurbsSurface
  NurbsSurface::cap(const double       R,
                    const double       cap_radius,
                    const unsigned int n)
  {
    if (!(cap_radius > R && std::isfinite(cap_radius)))
      throw std::invalid_argument("A cap is part of a larger sphere.");

    NurbsSurface              result = disk(R, n);
    const KnotVector         &knots  = result.knot_vectors[0];
    const std::vector<double> u      = knots.greville_abscissae();
    const unsigned int        size   = u.size();
    Eigen::MatrixXd           B      = Eigen::MatrixXd::Zero(size, size);
    for (unsigned int i = 0; i < size; ++i)
      {
        const unsigned int    span   = knots.span_of(u[i]);
        const BernsteinValues values = knots.evaluate(span, u[i]);
        for (unsigned int k = 0; k <= knots.degree(); ++k)
          B(i, knots.first_basis_function(span) + k) = values.B[k];
      }

    using Table = Eigen::ArrayXXd; // of all control points or abscissae
    using Map   = Eigen::Map<const Table>;
    const Map  w(result.weight.data(), size, size);
    const auto interpolant = [&B](const Table &coefficients) -> Table {
      return (B * coefficients.matrix() * B.transpose()).array();
    };
    const Eigen::VectorXd x = result.points.row(0), y = result.points.row(1);
    const Table           W = interpolant(w);
    const Table           r_squared =
      (interpolant(w * Map(x.data(), size, size)) / W).square() +
      (interpolant(w * Map(y.data(), size, size)) / W).square();
    const Table height = r_squared.unaryExpr([&](const double r2) {
      return height_on_sphere(std::min(R, std::sqrt(r2)), cap_radius);
    });
    const Eigen::PartialPivLU<Eigen::MatrixXd> solver(B);
    const Eigen::MatrixXd columns = solver.solve((W * height).matrix());
    const Table z = solver.solve(columns.transpose()).transpose().array() / w;
    result.points.row(2) = z.reshaped().transpose();
    return result;
  }



  NurbsSurface
  NurbsSurface::rectangle(const double      lx,
                          const double      ly,
                          const KnotVector &knots_1,
                          const KnotVector &knots_2)
  {
    if (!(lx > 0. && ly > 0. && std::isfinite(lx) && std::isfinite(ly)))
      throw std::invalid_argument("A rectangle needs positive edge lengths.");

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
  NurbsSurface::rectangle(const double       lx,
                          const double       ly,
                          const unsigned int n1,
                          const unsigned int n2,
                          const unsigned int degree,
                          const double       grading)
  {
    return rectangle(lx,
                     ly,
                     KnotVector::graded(degree, n1, grading),
                     KnotVector::graded(degree, n2, grading));
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
