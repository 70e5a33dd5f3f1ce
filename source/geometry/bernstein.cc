#include <debond/geometry/bernstein.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

namespace Debond
{
  namespace
  {
    /** Distinct knots closer than this are taken for a mistake: the span
     *  between them would be an element of the size of round-off. */
    constexpr double smallest_span = 1e-12;



    void
    check_knots(const unsigned int p, const std::vector<double> &U)
    {
      if (p < 1 || p > max_degree)
        throw std::invalid_argument("A knot vector has degree 1 or 2, not " +
                                    std::to_string(p) + ".");
      if (U.size() < 2 * (p + 1))
        throw std::invalid_argument(
          "A knot vector of degree p needs 2 (p+1) knots at least.");

      for (unsigned int i = 0; i <= p; ++i)
        if (U[i] != 0. || U[U.size() - 1 - i] != 1.)
          throw std::invalid_argument(
            "A knot vector must be open: p+1 zeros first, p+1 ones last.");

      for (unsigned int i = p; i + p + 1 < U.size(); ++i)
        if (!(U[i + 1] == U[i] || U[i + 1] - U[i] > smallest_span))
          throw std::invalid_argument(
            "Knots must not decrease, and must be equal or clearly distinct.");

      // p+1 equal knots inside would tear the surface apart.
      for (unsigned int i = 1; i + p + 1 < U.size(); ++i)
        if (U[i] == U[i + p] && U[i] != 0. && U[i] != 1.)
          throw std::invalid_argument(
            "An inner knot can be repeated p times at most.");
    }



    /**
     * Finishes the operator of the span [U[a], U[b]] whose right knot has
     * multiplicity @p mult: repeats this knot until the span is a Bezier
     * segment, and hands the part that overlaps to the next span.
     */
    void
    insert_right_knot(const unsigned int         p,
                      const std::vector<double> &U,
                      const unsigned int         a,
                      const unsigned int         b,
                      const unsigned int         mult,
                      Eigen::Matrix3d           &C,
                      Eigen::Matrix3d           &next)
    {
      std::array<double, max_degree + 1> alpha{};
      for (unsigned int j = p; j > mult; --j)
        alpha[j - mult - 1] = (U[b] - U[a]) / (U[a + j] - U[a]);

      const unsigned int n_insertions = p - mult;
      for (unsigned int j = 1; j <= n_insertions; ++j)
        {
          const unsigned int save = n_insertions - j;
          const unsigned int s    = mult + j;
          for (unsigned int k = p; k >= s; --k)
            C.col(k) =
              alpha[k - s] * C.col(k) + (1. - alpha[k - s]) * C.col(k - 1);
          next.block(save, save, j + 1, 1) = C.block(p - j, p, j + 1, 1);
        }
    }



    /** Unit matrix in the upper left (p+1)x(p+1) block. */
    Eigen::Matrix3d
    unit_block(const unsigned int p)
    {
      Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
      C.topLeftCorner(p + 1, p + 1).setIdentity();
      return C;
    }



    /** Algorithm 1 of Borden, Scott, Evans, Hughes (2011), with indices from
     *  zero: all operators in one sweep over the knots. */
    std::vector<Eigen::Matrix3d>
    extraction_operators(const unsigned int p, const std::vector<double> &U)
    {
      std::vector<Eigen::Matrix3d> operators(1, unit_block(p));
      const unsigned int           last = U.size() - 1;

      unsigned int a = p;     // last repetition of the span's left knot
      unsigned int b = p + 1; // will be the last repetition of its right knot
      while (true)
        {
          const unsigned int first = b;
          while (b < last && U[b + 1] == U[b])
            ++b;
          if (b == last)
            return operators;

          const unsigned int mult = b - first + 1;
          Eigen::Matrix3d    next = unit_block(p);
          if (mult < p)
            insert_right_knot(p, U, a, b, mult, operators.back(), next);
          operators.push_back(next);

          a = b;
          ++b;
        }
    }
  } // namespace



  BernsteinValues
  bernstein(const unsigned int degree, const double u)
  {
    assert(degree <= max_degree);
    const double v = 1. - u;
    switch (degree)
      {
        case 2:
          return {{{v * v, 2. * u * v, u * u}},
                  {{-2. * v, 2. * (v - u), 2. * u}},
                  {{2., -4., 2.}}};
        case 1:
          return {{{v, u, 0.}}, {{-1., 1., 0.}}, {{0., 0., 0.}}};
        default:
          return {{{1., 0., 0.}}, {{0., 0., 0.}}, {{0., 0., 0.}}};
      }
  }



  KnotVector::KnotVector(const unsigned int         degree,
                         const std::vector<double> &knots)
    : p(degree)
    , knot_values(knots)
  {
    check_knots(degree, knots);

    breaks.push_back(knots.front());
    for (unsigned int i = 0; i + 1 < knots.size(); ++i)
      if (knots[i + 1] > knots[i])
        {
          breaks.push_back(knots[i + 1]);
          first_function.push_back(i - p);
        }
    extraction = extraction_operators(p, knots);
    assert(extraction.size() == n_spans());
  }



  KnotVector
  KnotVector::uniform(const unsigned int degree, const unsigned int n_spans)
  {
    return graded(degree, n_spans, 1.);
  }



  KnotVector
  KnotVector::graded(const unsigned int degree,
                     const unsigned int n_spans,
                     const double       grading)
  {
    if (!(grading > 0.) || n_spans == 0)
      throw std::invalid_argument(
        "A knot vector needs a positive grading and one span at least.");
    std::vector<double> knots(degree + 1, 0.);
    for (unsigned int i = 1; i < n_spans; ++i)
      {
        const double s     = (2. * i - n_spans) / n_spans;
        const double power = 0.5 * std::pow(std::abs(s), grading);
        // equal spans without the rounding of the general formula
        knots.push_back(grading == 1. ? double(i) / n_spans :
                        s < 0.        ? 0.5 - power :
                                        0.5 + power);
      }
    knots.insert(knots.end(), degree + 1, 1.);
    return KnotVector(degree, knots);
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

    // Row by row C times Bernstein; what lies outside the (p+1)x(p+1) block is
    // zero, so the loops can have a length the compiler knows.
    const double   *C = extraction[span].data(); // columns are contiguous
    BernsteinValues N;
    for (unsigned int i = 0; i <= max_degree; ++i)
      {
        const double c0 = C[i], c1 = C[i + 3], c2 = C[i + 6];
        N.B[i]  = c0 * b.B[0] + c1 * b.B[1] + c2 * b.B[2];
        N.dB[i] = (c0 * b.dB[0] + c1 * b.dB[1] + c2 * b.dB[2]) * scale;
        N.ddB[i] =
          (c0 * b.ddB[0] + c1 * b.ddB[1] + c2 * b.ddB[2]) * (scale * scale);
      }
    return N;
  }
} // namespace Debond
