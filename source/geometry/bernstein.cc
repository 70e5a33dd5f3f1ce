#include <debond/geometry/bernstein.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace Debond
{
  namespace
  {
    /** Distinct knots closer than this are taken for a mistake: the span
     *  between them would be an element of the size of round-off. */
    constexpr double smallest_span = 1e-12;



    bool
    is_open_knot_vector(const unsigned int p, const std::vector<double> &U)
    {
      if (p < 1 || p > max_degree || U.size() < 2 * (p + 1))
        return false;
      bool result = true;
      for (unsigned int i = 0; i <= p; ++i)
        result = result && U[i] == 0. && U[U.size() - 1 - i] == 1.;
      for (unsigned int i = p; i + p + 1 < U.size(); ++i)
        result =
          result && (U[i + 1] == U[i] || U[i + 1] - U[i] > smallest_span);
      // p+1 equal knots inside would tear the surface apart.
      for (unsigned int i = 1; i + p + 1 < U.size(); ++i)
        result = result && (U[i] != U[i + p] || U[i] == 0. || U[i] == 1.);
      return result;
    }



    /** The operator of the span between the knots @p m and m+1: column k has
     *  the Bezier coefficients k of the splines that live there. They are the
     *  values of the splines' polar forms at p-k times the left knot and k
     *  times the right one, by de Boor's recursion; the same numbers as by
     *  Algorithm 1 of Borden, Scott, Evans, Hughes (2011). */
    Eigen::Matrix3d
    extraction_operator(const unsigned int         p,
                        const std::vector<double> &U,
                        const unsigned int         m)
    {
      Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
      for (unsigned int k = 0; k <= p; ++k)
        {
          Eigen::Matrix3d d = Eigen::Matrix3d::Identity();
          for (unsigned int r = 1; r <= p; ++r)
            for (unsigned int j = p; j >= r; --j)
              {
                const double left = U[m + j - p], right = U[m + 1 + j - r];
                const double u     = U[r + k > p ? m + 1 : m];
                const double alpha = (u - left) / (right - left);
                d.col(j) = (1. - alpha) * d.col(j - 1) + alpha * d.col(j);
              }
          C.col(k).head(p + 1) = d.col(p).head(p + 1);
        }
      return C;
    }



    /** The p+1 Bernstein polynomials of degree p at u in [0,1]. */
    BernsteinValues
    bernstein(const unsigned int p, const double u)
    {
      using Eigen::Vector3d;
      const double v = 1. - u;
      if (p == 1)
        return {Vector3d(v, u, 0.), Vector3d(-1., 1., 0.), Vector3d::Zero()};
      return {Vector3d(v * v, 2. * u * v, u * u),
              Vector3d(-2. * v, 2. * (v - u), 2. * u),
              Vector3d(2., -4., 2.)};
    }
  } // namespace



  KnotVector::KnotVector(const unsigned int         degree,
                         const std::vector<double> &knots)
    : p(degree)
    , knot_values(knots)
  {
    if (!is_open_knot_vector(degree, knots))
      throw std::invalid_argument(
        "A knot vector has degree p = 1 or 2, p+1 zeros first and p+1 ones "
        "last; its knots do not decrease, are equal or clearly distinct, and "
        "inside at most p times the same.");

    breaks.push_back(knots.front());
    for (unsigned int i = 0; i + 1 < knots.size(); ++i)
      if (knots[i + 1] > knots[i])
        {
          breaks.push_back(knots[i + 1]);
          first_function.push_back(i - p);
          extraction.push_back(extraction_operator(p, knots, i));
        }
  }



  KnotVector
  KnotVector::from_breakpoints(const unsigned int         degree,
                               const std::vector<double> &breakpoints)
  {
    std::vector<double> knots = breakpoints;
    knots.insert(knots.begin(), degree, breakpoints.front());
    knots.insert(knots.end(), degree, breakpoints.back());
    return KnotVector(degree, knots);
  }



  KnotVector
  KnotVector::graded(const unsigned int degree,
                     const unsigned int n_spans,
                     const double       grading)
  {
    assert(grading > 0. && n_spans > 0);
    std::vector<double> breakpoints{0.};
    for (unsigned int i = 1; i < n_spans; ++i)
      {
        const double s     = (2. * i - n_spans) / n_spans;
        const double power = 0.5 * std::pow(std::abs(s), grading);
        // equal spans without the rounding of the general formula
        breakpoints.push_back(grading == 1. ? double(i) / n_spans :
                              s < 0.        ? 0.5 - power :
                                              0.5 + power);
      }
    breakpoints.push_back(1.);
    return from_breakpoints(degree, breakpoints);
  }



  std::vector<double>
  KnotVector::greville_abscissae() const
  {
    std::vector<double> result(n_basis_functions(), 0.);
    for (unsigned int i = 0; i < result.size(); ++i)
      {
        for (unsigned int j = 1; j <= p; ++j)
          result[i] += knot_values[i + j];
        result[i] /= p;
      }
    return result;
  }



  unsigned int
  KnotVector::span_of(const double u) const
  {
    assert(n_spans() > 0);
    // Only inner breakpoints are searched: whatever u, the span exists.
    const auto inner_begin = breaks.begin() + 1, inner_end = breaks.end() - 1;
    return std::upper_bound(inner_begin, inner_end, u) - inner_begin;
  }



  BernsteinValues
  KnotVector::evaluate(const unsigned int span, const double u) const
  {
    assert(span < n_spans());
    const double left = breaks[span], scale = 1. / (breaks[span + 1] - left);
    const BernsteinValues b = bernstein(p, (u - left) * scale);
    // what lies outside the (p+1) x (p+1) block is zero
    const Eigen::Matrix3d &C = extraction[span];
    return {C * b.B, scale * (C * b.dB), scale * scale * (C * b.ddB)};
  }
} // namespace Debond
