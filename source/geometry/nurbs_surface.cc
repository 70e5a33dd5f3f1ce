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
     * Tensor product of two sets of univariate B-splines, first index fastest.
     * The degree is a template argument for the loops to be unrolled.
     */
    template <unsigned int p>
    void
    tensor_product(const BernsteinValues &first,
                   const BernsteinValues &second,
                   const bool             second_derivatives,
                   SurfaceBasis          &basis)
    {
      constexpr unsigned int n = p + 1;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int k = j * n + i;
            basis.N[k]           = first.B[i] * second.B[j];
            basis.N_1[k]         = first.dB[i] * second.B[j];
            basis.N_2[k]         = first.B[i] * second.dB[j];
          }
      if (second_derivatives)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < n; ++i)
            {
              const unsigned int k = j * n + i;
              basis.N_11[k]        = first.ddB[i] * second.B[j];
              basis.N_12[k]        = first.dB[i] * second.dB[j];
              basis.N_22[k]        = first.B[i] * second.ddB[j];
            }
    }



    template <std::size_t size>
    double
    sum(const std::array<double, SurfaceBasis::max_size> &values)
    {
      double result = 0.;
      for (std::size_t k = 0; k < size; ++k)
        result += values[k];
      return result;
    }



    /**
     * Eq. (34) of the paper: R_A = w_A N_A / W with W = sum_B w_B N_B. The
     * derivatives follow from those of R_A W = w_A N_A.
     */
    template <unsigned int p>
    void
    make_rational(const std::vector<double> &weights,
                  const bool                 second_derivatives,
                  SurfaceBasis              &basis)
    {
      constexpr unsigned int size = (p + 1) * (p + 1);
      for (unsigned int k = 0; k < size; ++k)
        {
          const double w = weights[basis.control_point[k]];
          basis.N[k] *= w;
          basis.N_1[k] *= w;
          basis.N_2[k] *= w;
          if (second_derivatives)
            {
              basis.N_11[k] *= w;
              basis.N_12[k] *= w;
              basis.N_22[k] *= w;
            }
        }

      const double inverse_W = 1. / sum<size>(basis.N);
      const double W_1 = sum<size>(basis.N_1), W_2 = sum<size>(basis.N_2);
      for (unsigned int k = 0; k < size; ++k)
        {
          basis.N[k] *= inverse_W;
          basis.N_1[k] = (basis.N_1[k] - basis.N[k] * W_1) * inverse_W;
          basis.N_2[k] = (basis.N_2[k] - basis.N[k] * W_2) * inverse_W;
        }
      if (!second_derivatives)
        return;

      const double W_11 = sum<size>(basis.N_11), W_12 = sum<size>(basis.N_12),
                   W_22 = sum<size>(basis.N_22);
      for (unsigned int k = 0; k < size; ++k)
        {
          const double R = basis.N[k], R_1 = basis.N_1[k], R_2 = basis.N_2[k];
          basis.N_11[k] =
            (basis.N_11[k] - 2. * R_1 * W_1 - R * W_11) * inverse_W;
          basis.N_12[k] =
            (basis.N_12[k] - R_1 * W_2 - R_2 * W_1 - R * W_12) * inverse_W;
          basis.N_22[k] =
            (basis.N_22[k] - 2. * R_2 * W_2 - R * W_22) * inverse_W;
        }
    }



    /** Greville abscissae: with these as control values, weights 1, the
     *  B-splines reproduce the parameter itself. */
    std::vector<double>
    greville_abscissae(const KnotVector &knots)
    {
      const unsigned int  p = knots.degree();
      std::vector<double> result(knots.n_basis_functions(), 0.);
      for (unsigned int i = 0; i < result.size(); ++i)
        {
          for (unsigned int j = 1; j <= p; ++j)
            result[i] += knots.knots()[i + j];
          result[i] /= p;
        }
      return result;
    }



    /** Boehm's ratio: on insertion of @p knot the new coefficient i lies
     *  between the old ones i-1 (ratio 0) and i (ratio 1). */
    double
    boehm_ratio(const std::vector<double> &U,
                const unsigned int         p,
                const double               knot,
                const unsigned int         i)
    {
      if (U[i + p] <= knot)
        return 1.;
      if (U[i] >= knot)
        return 0.;
      return (knot - U[i]) / (U[i + p] - U[i]);
    }
  } // namespace



  NurbsSurface::NurbsSurface(const KnotVector          &knots_1,
                             const KnotVector          &knots_2,
                             const ControlNet          &control_points,
                             const std::vector<double> &weights)
    : knot_vectors{{knots_1, knots_2}}
    , points(control_points)
    , weight(weights)
    , is_rational(std::any_of(weights.begin(),
                              weights.end(),
                              [](const double w) { return w != 1.; }))
  {
    if (knots_1.n_spans() == 0 || knots_2.n_spans() == 0 ||
        knots_1.degree() != knots_2.degree())
      throw std::invalid_argument(
        "A surface needs two knot vectors of the same degree.");
    if (points.cols() != n_control_points() ||
        weight.size() != n_control_points())
      throw std::invalid_argument(
        "A surface needs one control point and one weight per basis function.");
    if (!points.allFinite())
      throw std::invalid_argument("Control points must be finite.");
    if (!std::all_of(weight.begin(), weight.end(), [](const double w) {
          return w > 0. && std::isfinite(w);
        }))
      throw std::invalid_argument("Weights must be positive and finite.");
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

    basis.element       = element;
    basis.control_point = element_control_points(element);
    if (degree() == 2)
      {
        basis.size = 9;
        tensor_product<2>(splines1, splines2, second_derivatives, basis);
        if (is_rational)
          make_rational<2>(weight, second_derivatives, basis);
      }
    else
      {
        basis.size = 4;
        tensor_product<1>(splines1, splines2, second_derivatives, basis);
        if (is_rational)
          make_rational<1>(weight, second_derivatives, basis);
      }
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
    const unsigned int  step  = (direction == 0 ? 1 : old_n);
    ControlNet          new_points(3, n_1 * n_2);
    std::vector<double> new_weights(n_1 * n_2);

    // Rational surfaces are B-splines in the coordinates (w x, w). Old points
    // are read only where their share is not zero: elsewhere they need not
    // exist.
    for (unsigned int j = 0; j < n_2; ++j)
      for (unsigned int i = 0; i < n_1; ++i)
        {
          const unsigned int to = j * n_1 + i, from = j * old_n + i;
          const double       alpha =
            boehm_ratio(U, degree(), knot, direction == 0 ? i : j);
          if (alpha == 0. || alpha == 1.)
            {
              const unsigned int old = (alpha == 1. ? from : from - step);
              new_weights[to]        = weight[old];
              new_points.col(to)     = points.col(old);
              continue;
            }
          const double w_a = weight[from - step], w_b = weight[from];
          const double w  = w_a + alpha * (w_b - w_a);
          new_weights[to] = w;
          new_points.col(to) =
            ((1. - alpha) * w_a / w) * points.col(from - step) +
            (alpha * w_b / w) * points.col(from);
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
    for (unsigned int i = 1; i < n1; ++i)
      result = result.insert_knot(0, static_cast<double>(i) / n1);
    for (unsigned int i = 1; i < n2; ++i)
      result = result.insert_knot(1, static_cast<double>(i) / n2);
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

    const KnotVector one_span = KnotVector::uniform(2, 1);
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
    const std::vector<double> u      = greville_abscissae(knots);
    const unsigned int        size   = u.size();
    Eigen::MatrixXd           B      = Eigen::MatrixXd::Zero(size, size);
    for (unsigned int i = 0; i < size; ++i)
      {
        const unsigned int    span   = knots.span_of(u[i]);
        const BernsteinValues values = knots.evaluate(span, u[i]);
        for (unsigned int k = 0; k <= knots.degree(); ++k)
          B(i, knots.first_basis_function(span) + k) = values.B[k];
      }

    Eigen::MatrixXd w(size, size), w_x(size, size), w_y(size, size);
    for (unsigned int A = 0; A < result.n_control_points(); ++A)
      {
        w(A % size, A / size)   = result.weight[A];
        w_x(A % size, A / size) = result.weight[A] * result.points(0, A);
        w_y(A % size, A / size) = result.weight[A] * result.points(1, A);
      }
    const Eigen::ArrayXXd W = B * w * B.transpose();
    const Eigen::ArrayXXd x = (B * w_x * B.transpose()).array() / W;
    const Eigen::ArrayXXd y = (B * w_y * B.transpose()).array() / W;
    Eigen::MatrixXd       W_z(size, size);
    for (unsigned int j = 0; j < size; ++j)
      for (unsigned int i = 0; i < size; ++i)
        W_z(i, j) =
          W(i, j) * height_on_sphere(std::min(R, std::hypot(x(i, j), y(i, j))),
                                     cap_radius);
    const Eigen::PartialPivLU<Eigen::MatrixXd> solver(B);
    const Eigen::MatrixXd                      columns = solver.solve(W_z);
    const Eigen::MatrixXd w_z = solver.solve(columns.transpose()).transpose();
    for (unsigned int A = 0; A < result.n_control_points(); ++A)
      result.points(2, A) = w_z(A % size, A / size) / result.weight[A];
    return result;
  }



  NurbsSurface
  NurbsSurface::rectangle(const double       lx,
                          const double       ly,
                          const unsigned int n1,
                          const unsigned int n2,
                          const unsigned int degree,
                          const double       grading)
  {
    if (!(lx > 0. && ly > 0. && std::isfinite(lx) && std::isfinite(ly)))
      throw std::invalid_argument("A rectangle needs positive edge lengths.");

    const KnotVector knots_1 = KnotVector::graded(degree, n1, grading);
    const KnotVector knots_2 = KnotVector::graded(degree, n2, grading);
    const auto       u       = greville_abscissae(knots_1);
    const auto       v       = greville_abscissae(knots_2);
    ControlNet       net(3, u.size() * v.size());
    for (unsigned int j = 0; j < v.size(); ++j)
      for (unsigned int i = 0; i < u.size(); ++i)
        net.col(j * u.size() + i) =
          Eigen::Vector3d((u[i] - 0.5) * lx, (v[j] - 0.5) * ly, 0.);
    return NurbsSurface(knots_1,
                        knots_2,
                        net,
                        std::vector<double>(net.cols(), 1.));
  }



  NurbsSurface
  NurbsSurface::bilinear_interpolant() const
  {
    std::array<KnotVector, 2> new_knots;
    for (unsigned int d = 0; d < 2; ++d)
      {
        std::vector<double> values = knot_vectors[d].breakpoints();
        values.insert(values.begin(), 0.);
        values.push_back(1.);
        new_knots[d] = KnotVector(1, values);
      }

    const std::vector<double> &u = knot_vectors[0].breakpoints();
    const std::vector<double> &v = knot_vectors[1].breakpoints();
    ControlNet                 net(3, u.size() * v.size());
    for (unsigned int j = 0; j < v.size(); ++j)
      for (unsigned int i = 0; i < u.size(); ++i)
        net.col(j * u.size() + i) = point(Eigen::Vector2d(u[i], v[j]));
    return NurbsSurface(new_knots[0],
                        new_knots[1],
                        net,
                        std::vector<double>(net.cols(), 1.));
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
