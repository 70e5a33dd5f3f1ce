#include <debond/geometry/closest_point.h>
#include <debond/geometry/distance_minimum.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace Debond
{
  namespace
  {
    constexpr unsigned int max_starts = 8; // of the global search



    /**
     * Unit normal, also where the tangents are parallel as in the corners of
     * the disk: there a_1 x a_2 vanishes, and its derivative towards the
     * inside of the patch has the direction of the limit. Zero if there is no
     * normal at all.
     */
    Eigen::Vector3d
    unit_normal(const DistanceState &s)
    {
      const SurfaceGeometry &y      = s.geometry;
      Eigen::Vector3d        normal = y.a1.cross(y.a2);
      const double           scale  = y.a1.norm() * y.a2.norm();
      if (!(normal.norm() > 1e-8 * scale))
        {
          const double in_1 = (s.xi[0] < 0.5 ? 1. : -1.);
          const double in_2 = (s.xi[1] < 0.5 ? 1. : -1.);
          normal            = (in_1 * y.a11 + in_2 * y.a12).cross(y.a2) +
                   y.a1.cross(in_1 * y.a12 + in_2 * y.a22);
        }
      const double length = normal.norm();
      return length > 0. ? Eigen::Vector3d(normal / length) :
                           Eigen::Vector3d::Zero();
    }



    /** Whether x - y is normal to the surface; on a border of the patch only
     *  the direction across it is asked, the other one having been minimised
     *  (and being undefined on a ridge). */
    bool
    is_orthogonal(const DistanceState &s)
    {
      const SurfaceGeometry &y  = s.geometry;
      const double           l1 = y.a1.norm(), l2 = y.a2.norm();
      const bool             on_1 = (s.xi[0] <= 0. || s.xi[0] >= 1.);
      const bool             on_2 = (s.xi[1] <= 0. || s.xi[1] >= 1.);
      // Closer to a singular corner than this, the minimum is so flat that
      // round-off decides whether it is on the border, and the normal has
      // fewer digits.
      const bool is_singular = y.a1.cross(y.a2).norm() <= 1e-6 * l1 * l2;
      if (!on_1 && !on_2 && !is_singular)
        return true;

      const double size      = std::max(l1, l2);
      const double tolerance = is_singular ? 1e-7 * s.r.norm() + 1e-9 * size :
                                             1e-10 * s.r.norm() + 1e-13 * size;

      const Eigen::Vector3d normal = unit_normal(s);
      if (normal.squaredNorm() == 0.)
        return s.r.norm() <= tolerance;
      if (on_1 == on_2)
        return (s.r - s.r.dot(normal) * normal).norm() <= tolerance;

      const Eigen::Vector3d along = (on_1 ? y.a2 : y.a1).normalized();
      return std::abs(s.r.dot(normal.cross(along))) <= tolerance;
    }



    ClosestPoint
    result_of(const DistanceState &s, const bool converged)
    {
      ClosestPoint result;
      result.xi            = s.xi;
      result.distance      = s.r.norm();
      result.converged     = converged;
      result.is_orthogonal = converged && is_orthogonal(s);
      return result;
    }



    /** A place where the global search may start Newton's method. */
    struct Candidate
    {
      unsigned int    element;
      double          bound;    ///< squared distance: no point is nearer
      double          distance; ///< squared, of the nearest sample
      Eigen::Vector2d xi;       ///< of this sample
    };



    /** Squared distance of the box around the control points of an element;
     *  weights are positive, so the element lies inside. */
    double
    squared_distance_bound(const DistanceProblem &problem,
                           const unsigned int     element)
    {
      const auto indices   = problem.surface.element_control_points(element);
      const unsigned int p = problem.surface.degree();
      const unsigned int n = (p + 1) * (p + 1);
      Eigen::Vector3d    lower = problem.control_points.col(indices[0]);
      Eigen::Vector3d    upper = lower;
      for (unsigned int k = 1; k < n; ++k)
        {
          lower = lower.cwiseMin(problem.control_points.col(indices[k]));
          upper = upper.cwiseMax(problem.control_points.col(indices[k]));
        }
      const Eigen::Vector3d inside = problem.x.cwiseMax(lower).cwiseMin(upper);
      return (problem.x - inside).squaredNorm();
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
      SurfaceGeometry          geometry;
      for (unsigned int k = 0; k < 9; ++k)
        {
          const Eigen::Vector2d t(0.02 + 0.48 * (k % 3), 0.02 + 0.48 * (k / 3));
          const Eigen::Vector2d xi = box[0] + t.cwiseProduct(box[1] - box[0]);
          problem.surface.evaluate_in_element(element, xi, basis, false);
          contract(basis, problem.control_points, false, geometry);
          samples[k] = {element,
                        bound,
                        (problem.x - geometry.y).squaredNorm(),
                        xi};
        }

      for (unsigned int k = 0; k < 9; ++k)
        {
          const double d = samples[k].distance;
          if ((k % 3 == 0 || d <= samples[k - 1].distance) &&
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
      std::vector<double> bounds(problem.surface.n_elements());
      for (unsigned int e = 0; e < bounds.size(); ++e)
        bounds[e] = squared_distance_bound(problem, e);

      // The element with the least bound comes first and rules out most.
      const unsigned int first =
        std::min_element(bounds.begin(), bounds.end()) - bounds.begin();
      double                 nearest = std::numeric_limits<double>::infinity();
      std::vector<Candidate> result;
      for (unsigned int k = 0; k < bounds.size(); ++k)
        {
          const unsigned int e        = (k == 0 ? first : k == first ? 0 : k);
          const auto         n_before = result.size();
          if (bounds[e] <= nearest)
            sample(problem, e, bounds[e], result);
          for (auto i = n_before; i < result.size(); ++i)
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
      ClosestPoint best;
      best.distance  = std::numeric_limits<double>::infinity();
      unsigned int n = 0;
      for (const Candidate &candidate : starting_points(problem))
        {
          const double to_beat = best.distance * (1. - 1e-12);
          if (best.converged && candidate.bound >= to_beat * to_beat)
            continue;
          if (n++ == max_starts)
            break;

          unsigned int  element = candidate.element;
          DistanceState s = evaluate_distance(problem, element, candidate.xi);
          const bool    converged      = minimise_distance(problem, element, s);
          const ClosestPoint found     = result_of(s, converged);
          const bool         is_nearer = found.distance < to_beat;
          if ((found.converged && !best.converged) ||
              (found.converged == best.converged && is_nearer))
            best = found;
        }
      return best;
    }
  } // namespace



  ClosestPoint
  closest_point(const NurbsSurface    &surface,
                const ControlNet      &control_points,
                const Eigen::Vector3d &x,
                const Eigen::Vector2d *guess)
  {
    if (control_points.cols() != surface.n_control_points())
      throw std::invalid_argument(
        "The control net does not belong to this surface.");

    const DistanceProblem problem{surface, control_points, x};
    if (guess != nullptr && guess->allFinite())
      {
        const Eigen::Vector2d xi      = guess->cwiseMax(0.).cwiseMin(1.);
        unsigned int          element = surface.element_of(xi);
        DistanceState         s       = evaluate_distance(problem, element, xi);
        const bool         converged  = minimise_distance(problem, element, s);
        const ClosestPoint result     = result_of(s, converged);
        // A minimum on the border may be a local one: the search from the
        // guess slid off along the edge. It would open the contact, so make
        // sure.
        if (result.is_orthogonal)
          return result;
      }
    return search_globally(problem);
  }
} // namespace Debond
