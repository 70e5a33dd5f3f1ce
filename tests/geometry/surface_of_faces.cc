// A contact surface of the faces of a mesh, each turned as a file may have it:
// projections and steps along it go from face to face.
// - bilinear faces of a rectangle against the same surface as one patch;
// - faces around irregular corners, of degree 1 and 2, against the nearest of
//   the projections on each face by itself;
// - steps in a plane against the straight line.

#include <debond/geometry/surface_geometry.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "checks.h"
#include "rectangle_of.h"

using namespace Debond;
using Eigen::Vector2d;
using Eigen::Vector3d;

using Faces = std::vector<std::vector<unsigned int>>;

/** The control points of a face as seen from another corner. */
std::vector<unsigned int>
turned(const std::vector<unsigned int> &face, const unsigned int quarters)
{
  const int                 n = std::lround(std::sqrt(face.size()));
  std::vector<unsigned int> result;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      {
        int a = i, b = j;
        for (unsigned int k = 0; k < quarters; ++k)
          std::tie(a, b) = std::pair(n - 1 - b, a);
        result.push_back(face[a + n * b]);
      }
  return result;
}



/** n x n cells in each of the faces with these corners, of the degree p. */
struct Mesh
{
  Faces                 faces;
  std::vector<Vector3d> places;

  Mesh(const std::vector<std::array<Vector3d, 4>> &coarse,
       const int                                   n,
       const int                                   p)
  {
    unsigned int number = 0;
    for (const auto &corners : coarse)
      for (int e = 0; e < n * n; ++e)
        {
          std::vector<unsigned int> face;
          for (int j = 0; j <= p; ++j)
            for (int i = 0; i <= p; ++i)
              {
                const double s = double(p * (e % n) + i) / (p * n),
                             t = double(p * (e / n) + j) / (p * n);
                face.push_back(point(
                  (1 - s) * (1 - t) * corners[0] + s * (1 - t) * corners[1] +
                  (1 - s) * t * corners[2] + s * t * corners[3]));
              }
          faces.push_back(turned(face, number++ % 4));
        }
  }
  unsigned int
  point(const Vector3d &x)
  {
    const auto found =
      std::find_if(places.begin(), places.end(), [&](const auto &other) {
        return (other - x).norm() < 1e-9;
      });
    const unsigned int number = found - places.begin();
    if (found == places.end())
      places.push_back(x);
    return number;
  }
  NurbsSurface
  surface(const int p) const
  {
    ControlNet net(3, places.size());
    for (unsigned int k = 0; k < places.size(); ++k)
      net.col(k) = places[k];
    return NurbsSurface(p, faces, net);
  }
};



/** Around the origin as many rhombi as @p n says. */
std::vector<std::array<Vector3d, 4>>
star(const int n)
{
  const auto at = [&](const double k, const double r) {
    return Vector3d(r * std::cos(2 * M_PI * k / n),
                    r * std::sin(2 * M_PI * k / n),
                    0);
  };
  std::vector<std::array<Vector3d, 4>> result;
  for (int k = 0; k < n; ++k)
    result.push_back(
      {{Vector3d::Zero(), at(k, 1), at(k + 1, 1), at(k + 0.5, 1.5)}});
  return result;
}



ControlNet
bent(const ControlNet &X)
{
  ControlNet x = X;
  for (unsigned int k = 0; k < X.cols(); ++k)
    x.col(k) += Vector3d(0.05 * X(1, k) * X(1, k),
                         -0.1 * X(0, k),
                         0.2 * std::sin(2 * X(0, k)) * std::cos(X(1, k)));
  return x;
}



void
rectangle()
{
  std::cout << "a rectangle of 4 x 4 turned faces and as one patch"
            << std::endl;
  const auto         patch = rectangle_of(2, 2, 4, 4, 1);
  const Mesh         mesh({{{Vector3d(-1, -1, 0),
                             Vector3d(1, -1, 0),
                             Vector3d(-1, 1, 0),
                             Vector3d(1, 1, 0)}}},
                  4,
                  1);
  const NurbsSurface faces = mesh.surface(1);
  const ControlNet   x     = bent(patch.control_points()),
                   y       = bent(faces.control_points());
  double place = 0, flags = 0;
  for (unsigned int k = 0; k < 2000; ++k)
    {
      const Vector3d     p(random_number(-1.3, 1.3),
                       random_number(-1.3, 1.3),
                       random_number(-0.3, 0.3));
      const ClosestPoint a = closest_point(patch, x, p),
                         b = closest_point(faces, y, p);
      place                = std::max(place, std::abs(a.distance - b.distance));
      flags += a.is_orthogonal != b.is_orthogonal || !b.converged;
    }
  report("distances", place, 1e-12);
  report("points that face the one but not the other", flags, 0.5);
}



void
irregular(const unsigned int n, const unsigned int p)
{
  std::cout << n << " faces around a corner, degree " << p << std::endl;
  const Mesh         mesh(star(n), 2, p);
  const NurbsSurface surface  = mesh.surface(p);
  const ControlNet   x        = bent(surface.control_points());
  double             distance = 0, not_converged = 0, not_ends = 0;
  for (unsigned int k = 0; k < 1000; ++k)
    {
      const Vector3d q(random_number(-1.5, 1.5),
                       random_number(-1.5, 1.5),
                       random_number(-0.3, 0.3));
      double         nearest = 1e300;
      for (const auto &face : mesh.faces)
        {
          ControlNet own(3, face.size());
          for (unsigned int a = 0; a < face.size(); ++a)
            own.col(a) = x.col(face[a]);
          const KnotVector   knots = KnotVector::graded(p, 1);
          const NurbsSurface one(knots,
                                 knots,
                                 own,
                                 std::vector<double>(own.cols(), 1.));
          nearest = std::min(nearest, closest_point(one, own, q).distance);
        }
      Vector2d guess =
        surface.clamped({random_number(0, 8), random_number(0, 8)});
      const ClosestPoint found =
        closest_point(surface, x, q, k % 2 == 1 ? &guess : nullptr);
      // a search from a guess may end in another minimum, where x - y is
      // normal, too
      if (k % 2 == 0 || !found.is_orthogonal)
        distance = std::max(distance, std::abs(found.distance - nearest));
      else
        not_ends += found.distance < nearest - 1e-12;
      not_converged += !found.converged;
    }
  report("distance", distance, 1e-12);
  report("points that are nearer than the nearest", not_ends, 0.5);
  report("searches without an end", not_converged, 0.5);
}



void
steps()
{
  std::cout << "steps in a plane of 6 x 6 turned faces" << std::endl;
  const Mesh         mesh({{{Vector3d(-1, -1, 0),
                             Vector3d(1, -1, 0),
                             Vector3d(-1, 1, 0),
                             Vector3d(1, 1, 0)}}},
                  6,
                  2);
  const NurbsSurface surface = mesh.surface(2);
  double             error = 0, beyond = 0;
  for (unsigned int k = 0; k < 1000; ++k)
    {
      const auto     box = surface.element_bounds(k % surface.n_elements());
      const Vector2d xi  = box[0] +
                          Vector2d(random_number(0, 1), random_number(0, 1)),
                     step(random_number(-6, 6), random_number(-6, 6));
      SurfaceBasis    basis;
      SurfaceGeometry y;
      surface.evaluate(xi, basis);
      contract(basis, surface.control_points(), y);
      const Vector3d target = y.y + step[0] * y.a1 + step[1] * y.a2,
                     there  = surface.point(surface.moved(xi, step));
      // slid along the border where the line leaves the plane
      const Vector3d inside  = target.cwiseMax(-1).cwiseMin(1);
      error                  = std::max(error, (there - inside).norm());
      const Vector2d bounded = surface.bounded_step(xi, step);
      beyond =
        std::max(beyond,
                 (surface.point(surface.moved(xi, bounded)) - inside).norm());
    }
  report("from the straight line", error, 1e-13);
  report("of bounded steps", beyond, 1e-13);
}



int
main()
{
  rectangle();
  for (const unsigned int p : {1, 2})
    for (const unsigned int n : {3, 4, 5, 6})
      irregular(n, p);
  steps();
  try
    {
      NurbsSurface(1,
                   {{0, 1, 2, 3}, {0, 1, 4, 5}, {0, 1, 6, 7}},
                   ControlNet::Zero(3, 8));
      std::cout << "three faces at a side: taken" << std::endl;
    }
  catch (const std::invalid_argument &error)
    {
      std::cout << "three faces at a side: " << error.what() << std::endl;
    }
}
