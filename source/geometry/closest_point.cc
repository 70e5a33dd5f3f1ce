#include <debond/geometry/surface_geometry.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

// How the projection works. Inside one element the surface is smooth, so half
// the squared distance, f(xi) = |x - y(xi)|^2 / 2, is minimised there by
// Newton's method, with the element's borders as bounds. When the minimum of
// one element lies on its border, the elements beyond are asked whether they
// lead further down. This treats a smooth surface and one with ridges (degree
// 1) alike: on a ridge no neighbour leads further down, and the point on the
// ridge is the result.

namespace Debond
{
  using Eigen::Matrix2d;
  using Eigen::Vector2d;
  using Eigen::Vector3d;

  namespace
  {
    constexpr double       eps        = std::numeric_limits<double>::epsilon();
    constexpr double       infinity   = std::numeric_limits<double>::infinity();
    constexpr unsigned int max_newton = 60; // in one element
    constexpr unsigned int max_halvings    = 40;
    constexpr unsigned int max_starts      = 8;     // of the global search
    constexpr double       negligible_step = 1e-14; // of a parameter

    // Keeps a surface shrunk to a point from a 0/0; its square is a number too.
    constexpr double least_curvature = 1e-100;



    /** The point x and the deformed surface whose distance is minimised. */
    struct DistanceProblem
    {
      const NurbsSurface &surface;
      const ControlNet   &control_points;
      const Vector3d     &x;
      /** Where normals have to be towards, or none; a piece, or -1. */
      const Vector3d *towards = nullptr;
      int             piece   = -1;

      bool
      counts(const SurfaceGeometry &y) const
      {
        const Vector3d normal = y.a1.cross(y.a2);
        return towards == nullptr || normal.dot(*towards) > 0.5 * normal.norm();
      }
    };



    /** The distance function and its model at one point of an element. */
    struct DistanceState
    {
      /** At @p xi in @p element, which may lie on its sides. */
      DistanceState(const DistanceProblem &problem,
                    const unsigned int     element,
                    const Vector2d        &xi)
        : element(element)
        , xi(xi)
      {
        CurvedBasis basis;
        problem.surface.evaluate_in_element(element, xi, basis);
        contract(basis, problem.control_points, y);
        r         = problem.x - y.y;
        gradient  = Vector2d(-r.dot(y.a1), -r.dot(y.a2));
        lengths   = Vector2d(y.a1.norm(), y.a2.norm());
        magnitude = problem.x.norm() + y.y.norm();
      }

      /** Of f. */
      Matrix2d
      hessian() const
      {
        Matrix2d H;
        H(0, 0) = y.a1.dot(y.a1) - r.dot(y.a11);
        H(1, 1) = y.a2.dot(y.a2) - r.dot(y.a22);
        H(0, 1) = H(1, 0) = y.a1.dot(y.a2) - r.dot(y.a12);
        return H;
      }

      /** Whether @p step would change the parameters by round-off only, or the
       *  gradient is no more than that. */
      bool
      is_negligible(const Vector2d &step) const
      {
        const Vector2d noise = 4. * eps * magnitude * lengths;
        return step.lpNorm<Eigen::Infinity>() <=
                 negligible_step * std::max(1., xi.maxCoeff()) ||
               (gradient.cwiseAbs() - noise).maxCoeff() <= 0.;
      }

      unsigned int    element;
      Vector2d        xi;
      SurfaceGeometry y;
      Vector3d        r;         ///< x - y
      Vector2d        gradient;  ///< of f
      Vector2d        lengths;   ///< of the tangents
      double          magnitude; ///< of positions, for round-off
    };



    /**
     * Hessian H of f where it is positive definite, also but for round-off;
     * else |H|, which turns negative eigenvalues round. (Gauss-Newton would
     * keep only a_alpha . a_beta: far from the surface this overshoots along an
     * edge, and the halved steps creep towards the bound.) The shift is for the
     * corners of the disk, where tangents are parallel.
     */
    Matrix2d
    positive_model(const DistanceState &s)
    {
      const Matrix2d H = s.hessian();
      if (H(0, 0) > 0. && H(1, 1) > 0. &&
          H.determinant() > 1e-13 * H(0, 0) * H(1, 1))
        return H;
      const double shift = 1e-8 * s.lengths.squaredNorm() + least_curvature;
      // |H| is the root of H^2; P^2 - tr(P) P + det(P) I = 0 for P = |H|
      const double   det   = std::abs(H.determinant());
      const double   trace = std::sqrt(H.squaredNorm() + 2. * det);
      const Matrix2d I     = Matrix2d::Identity();
      return (H * H + det * I) / std::max(trace, least_curvature) + shift * I;
    }



    /** True if f is stationary at @p s but can be reduced along a direction
     *  of negative curvature that does not leave the surface. */
    bool
    is_saddle_or_maximum(const NurbsSurface &surface, const DistanceState &s)
    {
      const Vector2d g = s.lengths.cwiseAbs2();
      const Matrix2d H = s.hessian();

      // A parameter held by a bound (or by a ridge) has a gradient.
      bool is_free[2];
      for (unsigned int c = 0; c < 2; ++c)
        {
          is_free[c] =
            std::abs(s.gradient[c]) <= 1e-8 * s.r.norm() * s.lengths[c];
          if (is_free[c] && H(c, c) < -1e-8 * g[c])
            return true;
        }

      // From a corner only directions between the two edges stay in it.
      const auto end = surface.end_of_surface(s.element, s.xi);
      if (end[0] != 0 && end[1] != 0 && (end[0] == end[1]) == (H(0, 1) > 0.))
        return false;
      return is_free[0] && is_free[1] && H.determinant() < -1e-8 * g.prod();
    }



    /** Minimum of the positive definite model over steps that stay between the
     *  bounds: the free minimum if it does, else the best of the four sides. */
    Vector2d
    bounded_minimum(const Matrix2d &H,
                    const Vector2d &g,
                    const Vector2d &lower,
                    const Vector2d &upper)
    {
      const Vector2d free = -H.inverse() * g;
      if ((free.array() >= lower.array()).all() &&
          (free.array() <= upper.array()).all())
        return free;

      Vector2d best       = Vector2d::Zero();
      double   best_value = infinity;
      for (unsigned int side = 0; side < 4; ++side)
        {
          const unsigned int c = side / 2, o = 1 - c;
          Vector2d           step;
          step[c]            = (side % 2 == 0 ? lower[c] : upper[c]);
          step[o]            = std::clamp(-(g[o] + H(0, 1) * step[c]) / H(o, o),
                               lower[o],
                               upper[o]);
          const double value = g.dot(step) + 0.5 * step.dot(H * step);
          if (value < best_value)
            {
              best       = step;
              best_value = value;
            }
        }
      return best;
    }



    /** The descent of a point from element to element. */
    struct Descent
    {
      Descent(const DistanceProblem &problem,
              const unsigned int     element,
              const Vector2d        &xi)
        : problem(&problem)
        , element(element)
        , box(problem.surface.element_bounds(element))
        , s(problem, element, on_bounds(xi))
      {}

      /** Exactly on a bound that is met but for round-off: later decisions ask
       *  whether a parameter is on one, and what is a negligible step away
       *  would stop there. */
      Vector2d
      on_bounds(Vector2d xi) const
      {
        for (const Vector2d &bound : box)
          xi = ((xi - bound).array().abs() <=
                negligible_step * std::max(1., xi.maxCoeff()))
                 .select(bound, xi);
        return xi;
      }

      /** Goes to the minimum of the distance over the patch that is reached
       *  from here. Returns whether it was found. */
      bool
      minimise()
      {
        // Every passage leads down, so none is needed twice; the cap is for
        // what round-off may do.
        const double n_across = std::sqrt(problem->surface.n_elements());
        for (unsigned int k = 0; k < 50 + 16. * n_across; ++k)
          {
            if (!minimise_in_element())
              return false;
            if (!pass_on())
              return true;
          }
        return false;
      }

      /**
       * Newton step within the box. A parameter that is held by a bound stays
       * out of it: along an edge f may be convex though it is not in the plane,
       * and only the exact second derivative converges fast.
       */
      Vector2d
      bounded_step() const
      {
        const Vector2d &g     = s.gradient;
        const Vector2d  lower = box[0] - s.xi, upper = box[1] - s.xi;
        bool            is_held[2];
        for (unsigned int c = 0; c < 2; ++c)
          is_held[c] =
            (lower[c] >= 0. && g[c] > 0.) || (upper[c] <= 0. && g[c] < 0.);
        if (!is_held[0] && !is_held[1])
          return bounded_minimum(positive_model(s), g, lower, upper);

        const Matrix2d H    = s.hessian();
        Vector2d       step = Vector2d::Zero();
        for (unsigned int c = 0; c < 2; ++c)
          if (!is_held[c])
            {
              const double first = s.lengths[c] * s.lengths[c];
              const double h =
                H(c, c) > 1e-8 * first ? H(c, c) : first + least_curvature;
              step[c] = std::clamp(-g[c] / h, lower[c], upper[c]);
            }
        return step;
      }

      /** One step with line search (Armijo). Returns false if the distance
       *  cannot be reduced any more. */
      bool
      descend(const Vector2d &step)
      {
        // Close to the minimum the change of f drowns in round-off long before
        // the parameters are accurate; the full step is trusted there.
        const double round_off = eps * s.magnitude;
        double       slack     = 8. * round_off * (s.r.norm() + round_off);
        double       length    = 1.;
        for (unsigned int i = 0; i <= max_halvings; ++i, length *= 0.5)
          {
            const Vector2d      xi = on_bounds(s.xi + length * step);
            const DistanceState next(*problem,
                                     element,
                                     xi.cwiseMax(box[0]).cwiseMin(box[1]));
            // As a product the difference keeps its digits.
            const double change = 0.5 * (next.r - s.r).dot(next.r + s.r);
            if (change <= 1e-4 * length * s.gradient.dot(step) + slack)
              {
                s = next;
                return true;
              }
            slack = 0.;
          }
        return false;
      }

      bool
      minimise_in_element()
      {
        for (unsigned int iteration = 0; iteration < max_newton; ++iteration)
          {
            if (!s.r.allFinite() || !s.gradient.allFinite())
              return false;
            const Vector2d step = bounded_step();
            if (s.is_negligible(step))
              return !is_saddle_or_maximum(problem->surface, s);
            if (!descend(step))
              return false;
          }
        return false;
      }

      /** Goes on in an element beside, if the point lies on a side and that
       *  leads further down. The one across a vertex of a patch need not be
       *  asked: if f grows along its two sides there, which the others share,
       *  it grows in between. */
      bool
      pass_on()
      {
        if ((s.xi.array() != box[0].array()).all() &&
            (s.xi.array() != box[1].array()).all())
          return false;
        for (const auto &[beside, xi] :
             problem->surface.places_beside(element, s.xi))
          {
            Descent        there(*problem, beside, xi);
            const Vector2d step = there.bounded_step();
            if (step.lpNorm<Eigen::Infinity>() > 1e-13 &&
                !there.s.is_negligible(step) && there.descend(step) &&
                there.s.xi != xi)
              {
                *this = there;
                return true;
              }
          }
        return false;
      }

      const DistanceProblem  *problem;
      unsigned int            element;
      std::array<Vector2d, 2> box; ///< bounds of the element
      DistanceState           s;
    };



    /**
     * Unit normal, also where the tangents are parallel as in the corners of
     * the disk: there a_1 x a_2 vanishes, and its derivative towards the
     * inside of the patch has the direction of the limit. Zero if there is no
     * normal at all.
     */
    Vector3d
    unit_normal(const NurbsSurface &surface, const DistanceState &s)
    {
      const SurfaceGeometry &y      = s.y;
      Vector3d               normal = y.a1.cross(y.a2);
      if (!(normal.norm() > 1e-8 * s.lengths.prod()))
        {
          const auto     box    = surface.element_bounds(s.element);
          const Vector2d middle = 0.5 * (box[0] + box[1]);
          const double   in_1   = (s.xi[0] < middle[0] ? 1. : -1.);
          const double   in_2   = (s.xi[1] < middle[1] ? 1. : -1.);
          normal                = (in_1 * y.a11 + in_2 * y.a12).cross(y.a2) +
                   y.a1.cross(in_1 * y.a12 + in_2 * y.a22);
        }
      return normal.normalized();
    }



    /** Whether x - y is normal to the surface; on its border only the direction
     *  across it is asked, the other one having been minimised (and being
     *  undefined on a ridge). */
    bool
    is_orthogonal(const NurbsSurface &surface, const DistanceState &s)
    {
      const auto end  = surface.end_of_surface(s.element, s.xi);
      const bool on_1 = end[0] != 0, on_2 = end[1] != 0;
      // Closer to a singular corner than this, the minimum is so flat that
      // round-off decides whether it is on the border, and the normal has
      // fewer digits.
      const bool is_singular =
        s.y.a1.cross(s.y.a2).norm() <= 1e-6 * s.lengths.prod();
      if (!on_1 && !on_2 && !is_singular)
        return true;

      const double tolerance =
        (is_singular ? 1e-7 : 1e-10) * s.r.norm() +
        (is_singular ? 1e-9 : 1e-13) * s.lengths.maxCoeff();

      // zero where there is no normal: then nothing but y itself is
      const Vector3d normal = unit_normal(surface, s);
      if (on_1 == on_2 || normal.isZero(0.))
        return (s.r - s.r.dot(normal) * normal).norm() <= tolerance;

      const Vector3d along = (on_1 ? s.y.a2 : s.y.a1).normalized();
      return std::abs(s.r.dot(normal.cross(along))) <= tolerance;
    }



    ClosestPoint
    minimise_from(const DistanceProblem &problem,
                  const unsigned int     element,
                  const Vector2d        &xi)
    {
      Descent              descent(problem, element, xi);
      const bool           converged = descent.minimise();
      const DistanceState &s         = descent.s;
      // on a fillet it may have slid to where the surface does not count
      const bool is_found = converged && problem.counts(s.y);
      return {s.xi,
              s.r.norm(),
              is_found && is_orthogonal(problem.surface, s),
              is_found};
    }



    /** A place where the global search may start Newton's method. */
    struct Candidate
    {
      unsigned int element;
      double       bound;    ///< squared distance: no point is nearer
      double       distance; ///< squared, of the nearest sample
      Vector2d     xi;       ///< of this sample
    };



    /** Squared distance of the box around the control points of an element;
     *  weights are positive, so the element lies inside. Of a triangle those of
     *  Bernstein polynomials, which its nodes determine. */
    double
    squared_distance_bound(const DistanceProblem &problem,
                           const unsigned int     element)
    {
      const auto indices      = problem.surface.element_control_points(element);
      const unsigned int n    = problem.surface.n_control_points_of_element();
      const auto         node = [&](const unsigned int k) {
        return problem.control_points.col(indices[k]);
      };
      constexpr unsigned int ends[3][2] = {{0, 1}, {0, 2}, {1, 2}};
      Vector3d               lower = node(0), upper = lower;
      for (unsigned int k = 1; k < n; ++k)
        {
          Vector3d point = node(k);
          if (problem.surface.has_triangles() && k > 2)
            point =
              2. * point - 0.5 * (node(ends[k - 3][0]) + node(ends[k - 3][1]));
          lower = lower.cwiseMin(point);
          upper = upper.cwiseMax(point);
        }
      return (problem.x - problem.x.cwiseMax(lower).cwiseMin(upper))
        .squaredNorm();
    }



    /** Appends those of 3 x 3 samples of an element that are nearer than
     *  their neighbours: an element may hold several local minima. Samples
     *  close to the sides find those on the border of the patch. */
    void
    sample(const DistanceProblem  &problem,
           const unsigned int      element,
           const double            bound,
           std::vector<Candidate> &result)
    {
      const auto               box = problem.surface.element_bounds(element);
      std::array<Candidate, 9> samples;
      SurfaceBasis             basis;
      for (unsigned int k = 0; k < 9; ++k)
        {
          const Vector2d t(0.02 + 0.48 * (k % 3), 0.02 + 0.48 * (k / 3));
          const Vector2d xi = box[0] + t.cwiseProduct(box[1] - box[0]);
          problem.surface.evaluate_in_element(element, xi, basis);
          SurfaceGeometry y;
          contract(basis, problem.control_points, y);
          samples[k] = {element,
                        bound,
                        problem.counts(y) ? (problem.x - y.y).squaredNorm() :
                                            infinity,
                        xi};
        }

      for (unsigned int k = 0; k < 9; ++k)
        {
          const double d = samples[k].distance;
          if (d < infinity && (k % 3 == 0 || d <= samples[k - 1].distance) &&
              (k % 3 == 2 || d < samples[k + 1].distance) &&
              (k < 3 || d <= samples[k - 3].distance) &&
              (k > 5 || d < samples[k + 3].distance))
            result.push_back(samples[k]);
        }
    }



    /** Samples of all elements that can still win, nearest first. */
    std::vector<Candidate>
    starting_points(const DistanceProblem &problem)
    {
      std::vector<std::pair<double, unsigned int>> elements;
      for (unsigned int e = 0; e < problem.surface.n_elements(); ++e)
        if (problem.piece < 0 || int(problem.surface.piece(e)) == problem.piece)
          elements.emplace_back(squared_distance_bound(problem, e), e);
      // The element with the least bound comes first and rules out most.
      std::iter_swap(elements.begin(),
                     std::min_element(elements.begin(), elements.end()));
      double                 nearest = infinity;
      std::vector<Candidate> result;
      for (const auto &[bound, element] : elements)
        {
          auto i = result.size();
          if (bound <= nearest)
            sample(problem, element, bound, result);
          for (; i < result.size(); ++i)
            nearest = std::min(nearest, result[i].distance);
        }
      std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) {
        return a.distance < b.distance;
      });
      return result;
    }



    /** Newton from the nearest sample, then from those of elements whose bound
     *  says that they might hold a nearer point (@p max_starts at most). */
    ClosestPoint
    search_globally(const DistanceProblem &problem)
    {
      ClosestPoint best{Vector2d::Zero(), infinity, false, false};
      unsigned int n = 0;
      for (const Candidate &candidate : starting_points(problem))
        {
          const double to_beat = best.distance * (1. - 1e-12);
          if (best.converged && candidate.bound >= to_beat * to_beat)
            continue;
          if (n++ == max_starts)
            break;
          const ClosestPoint found =
            minimise_from(problem, candidate.element, candidate.xi);
          if (found.converged != best.converged ? found.converged :
                                                  found.distance < to_beat)
            best = found;
        }
      return best;
    }
  } // namespace



  ClosestPoint
  closest_point(const NurbsSurface &surface,
                const ControlNet   &control_points,
                const Vector3d     &x,
                const Vector2d     *guess,
                const Vector3d     *towards)
  {
    assert(control_points.cols() == surface.n_control_points());

    DistanceProblem problem{surface, control_points, x};
    // of one patch every side is the near one
    if (!surface.is_one_patch())
      problem.towards = towards;
    if (surface.n_pieces() > 1 && guess != nullptr && towards == nullptr)
      problem.piece = surface.piece(surface.element_of(*guess));
    if (guess != nullptr && guess->allFinite())
      {
        const Vector2d     xi = surface.clamped(*guess);
        const ClosestPoint result =
          minimise_from(problem, surface.element_of(xi), xi);
        // A minimum on the border may be a local one: the search from the
        // guess slid off along the edge. It would open the contact, so make
        // sure.
        if (result.is_orthogonal)
          return result;
      }
    return search_globally(problem);
  }
} // namespace Debond
