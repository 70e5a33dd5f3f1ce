#include <debond/geometry/distance_minimum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// How the projection works. Inside one element the surface is smooth, so half
// the squared distance, f(xi) = |x - y(xi)|^2 / 2, is minimised there by
// Newton's method, with the element's borders as bounds. When the minimum of
// one element lies on its border, the elements beyond are asked whether they
// lead further down. This treats a smooth surface and one with ridges (degree
// 1) alike: on a ridge no neighbour leads further down, and the point on the
// ridge is the result.

namespace Debond
{
  namespace
  {
    constexpr double       eps        = std::numeric_limits<double>::epsilon();
    constexpr unsigned int max_newton = 60; // in one element
    constexpr unsigned int max_halvings  = 40;
    constexpr double       smallest_step = 1e-14;

    // Keeps a surface shrunk to a point from a 0/0; its square is a number too.
    constexpr double least_curvature = 1e-100;

    using Bounds = std::array<Eigen::Vector2d, 2>;
  } // namespace



  DistanceState
  evaluate_distance(const DistanceProblem &problem,
                    const unsigned int     element,
                    const Eigen::Vector2d &xi)
  {
    SurfaceBasis basis;
    problem.surface.evaluate_in_element(element, xi, basis, true);

    DistanceState s;
    s.xi = xi;
    contract(basis, problem.control_points, true, s.geometry);
    s.r = problem.x - s.geometry.y;
    s.f = 0.5 * s.r.squaredNorm();
    s.gradient =
      Eigen::Vector2d(-s.r.dot(s.geometry.a1), -s.r.dot(s.geometry.a2));
    const double magnitude = problem.x.norm() + s.geometry.y.norm();
    s.noise                = 4. * eps * magnitude *
              Eigen::Vector2d(s.geometry.a1.norm(), s.geometry.a2.norm());
    return s;
  }



  namespace
  {
    struct Quadratic
    {
      double h11, h12, h22;

      double
      determinant() const
      {
        return h11 * h22 - h12 * h12;
      }

      /** False also where the determinant is mere round-off. */
      bool
      is_positive() const
      {
        return h11 > 0. && h22 > 0. && determinant() > 1e-13 * h11 * h22;
      }

      double
      value(const Eigen::Vector2d &g, const Eigen::Vector2d &s) const
      {
        return g.dot(s) + 0.5 * (h11 * s[0] * s[0] + h22 * s[1] * s[1]) +
               h12 * s[0] * s[1];
      }
    };



    Quadratic
    hessian(const DistanceState &s)
    {
      const SurfaceGeometry &y = s.geometry;
      return {y.a1.dot(y.a1) - s.r.dot(y.a11),
              y.a1.dot(y.a2) - s.r.dot(y.a12),
              y.a2.dot(y.a2) - s.r.dot(y.a22)};
    }



    /**
     * Hessian H of f where it is positive definite, else |H| = (H H)^(1/2),
     * which turns negative eigenvalues round. (Gauss-Newton would keep only
     * a_alpha . a_beta: far from the surface this overshoots along an edge,
     * and the halved steps creep towards the bound.) The shift is for the
     * corners of the disk, where tangents are parallel.
     */
    Quadratic
    positive_model(const DistanceState &s)
    {
      const Quadratic H = hessian(s);
      if (H.is_positive())
        return H;

      const double shift =
        1e-8 * (s.geometry.a1.squaredNorm() + s.geometry.a2.squaredNorm()) +
        least_curvature;
      const double det = std::abs(H.determinant());
      const double m11 = H.h11 * H.h11 + H.h12 * H.h12;
      const double m22 = H.h22 * H.h22 + H.h12 * H.h12;
      const double m12 = H.h12 * (H.h11 + H.h22);
      // Square root of a 2 x 2 matrix, by the theorem of Cayley and Hamilton.
      const double scale = std::sqrt(m11 + m22 + 2. * det);
      if (!(scale > shift))
        return {shift, 0., shift};
      return {(m11 + det) / scale + shift,
              m12 / scale,
              (m22 + det) / scale + shift};
    }



    /** True if f is stationary at @p s but can be reduced along a direction
     *  of negative curvature that does not leave the patch. */
    bool
    is_saddle_or_maximum(const DistanceState &s)
    {
      const SurfaceGeometry &y   = s.geometry;
      const double           g11 = y.a1.squaredNorm(), g22 = y.a2.squaredNorm();
      const Quadratic        H = hessian(s);

      // A parameter held by a bound (or by a ridge) has a gradient.
      const Eigen::Vector2d small =
        1e-8 * s.r.norm() * Eigen::Vector2d(y.a1.norm(), y.a2.norm());
      const bool is_free_1 = std::abs(s.gradient[0]) <= small[0];
      const bool is_free_2 = std::abs(s.gradient[1]) <= small[1];
      if ((is_free_1 && H.h11 < -1e-8 * g11) ||
          (is_free_2 && H.h22 < -1e-8 * g22))
        return true;

      // From a corner only directions between the two edges stay in the patch.
      const bool in_corner =
        (s.xi[0] == 0. || s.xi[0] == 1.) && (s.xi[1] == 0. || s.xi[1] == 1.);
      if (in_corner && (s.xi[0] == s.xi[1]) == (H.h12 > 0.))
        return false;
      return is_free_1 && is_free_2 && H.determinant() < -1e-8 * g11 * g22;
    }



    /** Minimum of the positive definite model over steps that stay between the
     *  bounds: the free minimum if it does, else the best of the four sides. */
    Eigen::Vector2d
    bounded_minimum(const Quadratic       &H,
                    const Eigen::Vector2d &g,
                    const Eigen::Vector2d &lower,
                    const Eigen::Vector2d &upper)
    {
      const double          det = H.determinant();
      const Eigen::Vector2d free((H.h12 * g[1] - H.h22 * g[0]) / det,
                                 (H.h12 * g[0] - H.h11 * g[1]) / det);
      if ((free.array() >= lower.array()).all() &&
          (free.array() <= upper.array()).all())
        return free;

      Eigen::Vector2d best       = Eigen::Vector2d::Zero();
      double          best_value = std::numeric_limits<double>::infinity();
      for (unsigned int side = 0; side < 4; ++side)
        {
          const unsigned int c = side / 2, o = 1 - c;
          Eigen::Vector2d    step;
          step[c] = (side % 2 == 0 ? lower[c] : upper[c]);
          step[o] =
            std::clamp(-(g[o] + H.h12 * step[c]) / (o == 0 ? H.h11 : H.h22),
                       lower[o],
                       upper[o]);
          const double value = H.value(g, step);
          if (value < best_value)
            {
              best       = step;
              best_value = value;
            }
        }
      return best;
    }



    /**
     * Newton step within the box. A parameter that is held by a bound stays
     * out of it: along an edge f may be convex though it is not in the plane,
     * and only the exact second derivative converges fast.
     */
    Eigen::Vector2d
    bounded_step(const DistanceState &s, const Bounds &box)
    {
      const Eigen::Vector2d &g     = s.gradient;
      const Eigen::Vector2d  lower = box[0] - s.xi, upper = box[1] - s.xi;
      bool                   is_held[2];
      for (unsigned int c = 0; c < 2; ++c)
        is_held[c] =
          (lower[c] >= 0. && g[c] > 0.) || (upper[c] <= 0. && g[c] < 0.);
      if (!is_held[0] && !is_held[1])
        return bounded_minimum(positive_model(s), g, lower, upper);

      Eigen::Vector2d step = Eigen::Vector2d::Zero();
      for (unsigned int c = 0; c < 2; ++c)
        if (!is_held[c])
          {
            const Eigen::Vector3d &a = (c == 0 ? s.geometry.a1 : s.geometry.a2);
            const Eigen::Vector3d &aa =
              (c == 0 ? s.geometry.a11 : s.geometry.a22);
            const double first  = a.squaredNorm();
            const double newton = first - s.r.dot(aa);
            const double h =
              newton > 1e-8 * first ? newton : first + least_curvature;
            step[c] = std::clamp(-g[c] / h, lower[c], upper[c]);
          }
      return step;
    }



    /** Sum, with the result put exactly on a bound that it meets but for
     *  round-off: later decisions ask whether a parameter is on a bound. */
    Eigen::Vector2d
    step_in_box(const Eigen::Vector2d &xi,
                const Eigen::Vector2d &step,
                const Bounds          &box)
    {
      Eigen::Vector2d result = xi + step;
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int k = 0; k < 2; ++k)
          if (std::abs(result[c] - box[k][c]) <= 4. * eps)
            result[c] = box[k][c];
      return result.cwiseMax(box[0]).cwiseMin(box[1]);
    }



    /** True if @p step would change the parameters by round-off only. */
    bool
    is_negligible(const DistanceState &s, const Eigen::Vector2d &step)
    {
      if (step.lpNorm<Eigen::Infinity>() <= smallest_step)
        return true;
      return (s.gradient.cwiseAbs().array() <= s.noise.array()).all();
    }



    /** One step with line search (Armijo). @return false if the distance
     *  cannot be reduced any more. */
    bool
    descend(const DistanceProblem &problem,
            const unsigned int     element,
            const Bounds          &box,
            const Eigen::Vector2d &step,
            DistanceState         &s)
    {
      const double slope = s.gradient.dot(step);
      // Close to the minimum the change of f drowns in round-off long before
      // the parameters are accurate; the full step is trusted there.
      const double magnitude = problem.x.norm() + s.geometry.y.norm();
      const double slack =
        8. * eps * magnitude * (s.r.norm() + eps * magnitude);

      double length = 1.;
      for (unsigned int i = 0; i <= max_halvings; ++i, length *= 0.5)
        {
          const DistanceState next =
            evaluate_distance(problem,
                              element,
                              step_in_box(s.xi, length * step, box));
          // As a product the difference keeps its digits.
          const double change = 0.5 * (next.r - s.r).dot(next.r + s.r);
          if (change <= 1e-4 * length * slope + (i == 0 ? slack : 0.))
            {
              s = next;
              return true;
            }
        }
      return false;
    }



    /** Minimum in one element from @p s; @return whether it was found. */
    bool
    minimise_in_element(const DistanceProblem &problem,
                        const unsigned int     element,
                        DistanceState         &s)
    {
      const Bounds box = problem.surface.element_bounds(element);
      for (unsigned int iteration = 0; iteration < max_newton; ++iteration)
        {
          if (!std::isfinite(s.f) || !s.gradient.allFinite())
            return false;
          const Eigen::Vector2d step = bounded_step(s, box);
          if (is_negligible(s, step))
            return !is_saddle_or_maximum(s);

          if (!descend(problem, element, box, step, s))
            return false;
        }
      return false;
    }



    /** The elements (two at most) beyond the sides of @p element on which
     *  @p xi lies. The one across a vertex need not be asked: if f grows along
     *  its two sides there, which the others share, it grows in between. */
    unsigned int
    neighbours(const NurbsSurface          &surface,
               const unsigned int           element,
               const Eigen::Vector2d       &xi,
               std::array<unsigned int, 2> &result)
    {
      const auto         n         = surface.n_elements_per_direction();
      const Bounds       box       = surface.element_bounds(element);
      const unsigned int index[2]  = {element % n[0], element / n[0]};
      const unsigned int stride[2] = {1, n[0]};

      unsigned int size = 0;
      for (unsigned int c = 0; c < 2; ++c)
        if (xi[c] == box[0][c] && index[c] > 0)
          result[size++] = element - stride[c];
        else if (xi[c] == box[1][c] && index[c] + 1 < n[c])
          result[size++] = element + stride[c];
      return size;
    }
  } // namespace



  bool
  minimise_distance(const DistanceProblem &problem,
                    unsigned int          &element,
                    DistanceState         &s)
  {
    const auto n = problem.surface.n_elements_per_direction();
    // Every passage leads down, so none is needed twice; the cap is for
    // what round-off may do.
    for (unsigned int passage = 0; passage < 10 + 4 * (n[0] + n[1]); ++passage)
      {
        if (!minimise_in_element(problem, element, s))
          return false;

        std::array<unsigned int, 2> candidates;
        const unsigned int          n_candidates =
          neighbours(problem.surface, element, s.xi, candidates);
        bool leads_further = false;
        for (unsigned int k = 0; k < n_candidates && !leads_further; ++k)
          {
            DistanceState there =
              evaluate_distance(problem, candidates[k], s.xi);
            const Bounds box = problem.surface.element_bounds(candidates[k]);
            const Eigen::Vector2d step = bounded_step(there, box);
            if (step.lpNorm<Eigen::Infinity>() > 1e-13 &&
                !is_negligible(there, step) &&
                descend(problem, candidates[k], box, step, there) &&
                there.xi != s.xi)
              {
                element       = candidates[k];
                s             = there;
                leads_further = true;
              }
          }
        if (!leads_further)
          return true;
      }
    return false;
  }
} // namespace Debond
