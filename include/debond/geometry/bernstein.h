#pragma once

#include <Eigen/Core>

#include <cassert>
#include <vector>

namespace Debond
{
  /** Largest polynomial degree of a contact surface. */
  constexpr unsigned int max_degree = 2;

  /** Values and first two derivatives, with respect to u, of p+1 polynomials;
   *  the others are zero. */
  struct BernsteinValues
  {
    Eigen::Vector3d B, dB, ddB;
  };

  /**
   * An open knot vector over [0,1] and the Bezier extraction operators of its
   * knot spans (Borden, Scott, Evans, Hughes 2011).
   */
  class KnotVector
  {
  public:
    KnotVector() = default;
    /** @p knots: non-decreasing, first and last repeated degree+1 times. */
    KnotVector(unsigned int degree, const std::vector<double> &knots);
    /** Simple inner knots: all of @p breakpoints, from 0 to 1, but the ends. */
    static KnotVector
    from_breakpoints(unsigned int               degree,
                     const std::vector<double> &breakpoints);
    /** Simple inner knots (1 + sign(s) |s|^g)/2 with g = @p grading and s
     *  equally spaced in [-1,1]: g > 1 makes the spans in the middle short. */
    static KnotVector
    graded(unsigned int degree, unsigned int n_spans, double grading = 1);

    unsigned int
    degree() const
    {
      return p;
    }
    const std::vector<double> &
    knots() const
    {
      return knot_values;
    }
    unsigned int
    n_basis_functions() const
    {
      return knot_values.empty() ? 0 : knot_values.size() - p - 1;
    }
    /** Number of spans of positive length. */
    unsigned int
    n_spans() const
    {
      return first_function.size();
    }
    /** The n_spans()+1 distinct knots. */
    const std::vector<double> &
    breakpoints() const
    {
      return breaks;
    }
    /** Span (numbering only those of positive length) that contains u. */
    unsigned int
    span_of(double u) const;
    /** With these as control values the B-splines reproduce the parameter. */
    std::vector<double>
    greville_abscissae() const;
    /** Index of the first basis function that lives on a span. */
    unsigned int
    first_basis_function(const unsigned int span) const
    {
      assert(span < n_spans());
      return first_function[span];
    }
    /** B-spline values and derivatives (with respect to the knot parameter) on
     *  a span; u need not lie inside the span. */
    BernsteinValues
    evaluate(unsigned int span, double u) const;

  private:
    unsigned int              p = 0;
    std::vector<double>       knot_values, breaks;
    std::vector<unsigned int> first_function;
    /** C of Eq.\ (35): B-splines on the span = C * Bernstein, in the upper left
     *  (p+1) x (p+1) block; zero elsewhere. */
    std::vector<Eigen::Matrix3d> extraction;
  };
} // namespace Debond
