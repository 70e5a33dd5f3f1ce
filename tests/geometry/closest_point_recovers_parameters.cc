// The closest point projection recovers the parameters of points set off along
// the normal, tells points beyond the edge, finds ridges and always ends.

#include <debond/geometry/surface_geometry.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "checks.h"
#include "rectangle_of.h"

using namespace Debond;
using Eigen::Vector2d;
using Eigen::Vector3d;

double
random_number(const double from, const double to)
{
  static std::mt19937 generator; // its numbers are the same on all machines
  return from + (to - from) * (generator() / 4294967295.);
}



/** A smooth motion of the control points: stretched, turned, bent and waved.
 *  For surfaces of size one; radii of curvature are 0.5 and more. */
ControlNet
deformed(const NurbsSurface &surface)
{
  ControlNet              net = surface.control_points();
  const Eigen::AngleAxisd turn(0.4, Vector3d(1, 2, 3).normalized());
  for (unsigned int k = 0; k < net.cols(); ++k)
    {
      const double   x = net(0, k), y = net(1, k);
      const Vector3d bent(1.1 * x + 0.05 * y,
                          0.9 * y - 0.04 * x * x,
                          0.3 * x * x - 0.2 * x * y +
                            0.02 * std::sin(5 * x + 3 * y));
      net.col(k) = turn * bent + Vector3d(3, -1, 2);
    }
  return net;
}



SurfaceGeometry
geometry_at(const NurbsSurface &surface,
            const ControlNet   &net,
            const Vector2d     &xi)
{
  CurvedBasis     basis;
  SurfaceGeometry geometry;
  surface.evaluate(xi, basis);
  contract(basis, net, geometry);
  return geometry;
}



struct Check
{
  double parameters = 0, distance = 0;
  bool   all_converged = true, all_orthogonal = true;
};



/** Sets off @p xi along the normal and projects it back, from several guesses
 *  and from none. */
void
recover(const NurbsSurface &surface,
        const ControlNet   &net,
        const Vector2d     &xi,
        const double        offset,
        Check              &check)
{
  const SurfaceGeometry y = geometry_at(surface, net, xi);
  const Vector3d        x = y.y + offset * y.a1.cross(y.a2).normalized();

  const Vector2d guesses[] = {xi,
                              xi + Vector2d(0.01, -0.02),
                              xi + Vector2d(-0.15, 0.1),
                              Vector2d(0.5, 0.5)};
  for (unsigned int k = 0; k < 5; ++k)
    {
      const ClosestPoint result =
        closest_point(surface, net, x, k < 4 ? &guesses[k] : nullptr);
      grow(check.parameters, (result.xi - xi).lpNorm<Eigen::Infinity>());
      grow(check.distance, std::abs(result.distance - std::abs(offset)));
      check.all_converged  = check.all_converged && result.converged;
      check.all_orthogonal = check.all_orthogonal && result.is_orthogonal;
    }
}



void
report_check(const Check &check, const double limit)
{
  report("  deviation of parameters", check.parameters, limit);
  report("  deviation of distance", check.distance, 1e-13);
  report("  all converged", check.all_converged);
  report("  all orthogonal", check.all_orthogonal);
}



/** Parameters in the inside, on knots, near and on the edges. */
std::vector<Vector2d>
test_points(const double margin)
{
  std::vector<Vector2d> points;
  for (unsigned int k = 0; k < 60; ++k)
    points.emplace_back(random_number(0.05, 0.95), random_number(0.05, 0.95));
  for (const double t : {0.25, 0.5, 0.3, 0.71})
    for (const double s : {0.5, 0.25, margin, 1. - margin, 0.13})
      {
        points.emplace_back(s, t);
        points.emplace_back(t, s);
      }
  return points;
}



void
check_recovery(const std::string  &name,
               const NurbsSurface &surface,
               const ControlNet   &net)
{
  std::cout << name << std::endl;
  for (const double margin : {0., 1e-9, 1e-3})
    {
      Check check;
      for (const Vector2d &xi : test_points(margin))
        for (const double offset : {0., 1e-7, 0.05, -0.2})
          recover(surface, net, xi, offset, check);
      std::cout << " including points at " << margin << " from the edges"
                << std::endl;
      report_check(check, 2e-13);
    }
}



/** Facets are warped and meet in ridges and valleys, so the offset is small
 *  and the points keep away from the borders of the facets. */
void
check_facets(const NurbsSurface &surface, const ControlNet &net)
{
  Check check;
  for (unsigned int element = 0; element < surface.n_elements(); ++element)
    {
      const auto     bounds = surface.element_bounds(element);
      const Vector2d t(random_number(0.3, 0.7), random_number(0.3, 0.7));
      const Vector2d xi = bounds[0] + t.cwiseProduct(bounds[1] - bounds[0]);
      for (const double offset : {0., 1e-7, 0.005, -0.005})
        recover(surface, net, xi, offset, check);
    }
  std::cout << "Deformed disk, degree 1" << std::endl;
  report_check(check, 2e-13);
}



/** In the corners the tangents are parallel, and parameters are determined
 *  less sharply the closer the corner is; distances are not affected. */
void
check_singular_corners(const NurbsSurface &disk, const double sign)
{
  for (const double distance : {1e-1, 1e-2, 1e-3})
    {
      Check check;
      for (unsigned int corner = 0; corner < 4; ++corner)
        for (const double ratio : {0., 0.4, 1.})
          {
            Vector2d xi(distance, ratio * distance);
            for (unsigned int c = 0; c < 2; ++c)
              if ((corner >> c) % 2 == 1)
                xi[c] = 1. - xi[c];
            recover(disk, disk.control_points(), xi, sign * 0.1, check);
          }
      std::cout << " at " << distance << " from a corner" << std::endl;
      report_check(check, 1e-14 / (distance * distance * distance));
    }
}



/** The normal is a limit there, and known: that of the plane. The disk is
 *  turned, for round-off in a_1 x a_2 not to have this direction by chance. */
void
check_above_corners(const NurbsSurface &disk)
{
  bool   all_converged = true, all_orthogonal = true;
  double position = 0;
  for (unsigned int k = 0; k < 20; ++k)
    for (const Vector2d &xi :
         {Vector2d(0, 0), Vector2d(1, 0), Vector2d(0, 1), Vector2d(1, 1)})
      for (const double h : {0., 1e-3, 0.1, -0.3, 2.})
        {
          const Eigen::AngleAxisd turn(0.1 + k, Vector3d(3, 1, 2).normalized());
          const ControlNet        net =
            turn.toRotationMatrix() * disk.control_points();
          const Vector3d corner = turn * disk.point(xi);
          const Vector3d x      = corner + h * (turn * Vector3d::UnitZ());

          const ClosestPoint result =
            closest_point(disk, net, x, k % 2 == 0 ? &xi : nullptr);
          all_converged  = all_converged && result.converged;
          all_orthogonal = all_orthogonal && result.is_orthogonal;
          grow(position, (turn * disk.point(result.xi) - corner).norm());
        }
  std::cout << "Above the corners of the turned disk" << std::endl;
  report("  deviation of positions", position, 1e-7);
  report("  all converged", all_converged);
  report("  all orthogonal", all_orthogonal);
}



void
check_beyond_rectangle(const unsigned int degree)
{
  const NurbsSurface surface    = rectangle_of(2, 1, 5, 4, degree);
  double             parameters = 0, distance = 0;
  bool               all_converged = true, none_orthogonal = true;
  for (const double beyond : {1e-8, 0.01, 3.})
    for (const double t : {-0.6, -0.31, 0., 0.25, 0.5, 0.6})
      for (unsigned int edge = 0; edge < 4; ++edge)
        {
          const unsigned int c = edge / 2, o = 1 - c;
          const double       sign      = (edge % 2 == 0 ? -1. : 1.);
          const double       length[2] = {2., 1.};
          Vector3d           x(0, 0, 0.02);
          x[c] = sign * (0.5 * length[c] + beyond);
          x[o] = t * length[o];

          Vector2d exact;
          exact[c] = (sign < 0. ? 0. : 1.);
          exact[o] = std::clamp(0.5 + t, 0., 1.);

          const Vector2d guess(0.4, 0.6);
          for (const Vector2d *start : {&guess, (const Vector2d *)nullptr})
            {
              const ClosestPoint result =
                closest_point(surface, surface.control_points(), x, start);
              grow(parameters, (result.xi - exact).norm());
              grow(distance,
                   std::abs(result.distance -
                            (x - surface.point(exact)).norm()));
              all_converged   = all_converged && result.converged;
              none_orthogonal = none_orthogonal && !result.is_orthogonal;
            }
        }
  std::cout << "Beyond the edges and corners of the rectangle, degree "
            << degree << std::endl;
  report("  deviation of parameters", parameters, 1e-14);
  report("  deviation of distance", distance, 1e-14);
  report("  all converged", all_converged);
  report("  none orthogonal", none_orthogonal);
}



void
check_beyond_disk(const NurbsSurface &disk, const double R)
{
  double distance      = 0;
  bool   all_converged = true, none_orthogonal = true;
  for (const double beyond : {1e-6, 0.01, 2.})
    for (const double h : {0., 0.03})
      for (unsigned int degrees = 0; degrees < 360; degrees += 9) // 45 too
        {
          const double       angle = degrees * M_PI / 180.;
          const Vector3d     x((R + beyond) * std::cos(angle),
                           (R + beyond) * std::sin(angle),
                           h);
          const ClosestPoint result =
            closest_point(disk, disk.control_points(), x);
          grow(distance, std::abs(result.distance - std::hypot(beyond, h)));
          all_converged   = all_converged && result.converged;
          none_orthogonal = none_orthogonal && !result.is_orthogonal;
        }
  std::cout << "Beyond the edge of the disk, corners included" << std::endl;
  report("  deviation of distance", distance, 1e-13);
  report("  all converged", all_converged);
  report("  none orthogonal", none_orthogonal);
}



/** Two faces that meet at x = 0 in a roof of slope 0.5, two elements each. */
void
check_ridge()
{
  const NurbsSurface surface = rectangle_of(2, 1, 4, 3, 1);
  ControlNet         roof    = surface.control_points();
  for (unsigned int k = 0; k < roof.cols(); ++k)
    roof(2, k) = -0.5 * std::abs(roof(0, k));

  double deviation = 0;
  bool   all_good  = true;
  for (const double tilt : {0., 0.3, -0.45}) // x is nearest to the ridge
    for (const double y : {-0.5, -0.2, 1. / 6., 0.4})
      for (const Vector2d &guess :
           {Vector2d(0.1, 0.1), Vector2d(0.9, 0.5), Vector2d(0.5, 0.9)})
        {
          const Vector3d     x(0.3 * tilt, y, 0.3);
          const ClosestPoint result = closest_point(surface, roof, x, &guess);
          grow(deviation, (result.xi - Vector2d(0.5, y + 0.5)).norm());
          grow(deviation,
               std::abs(result.distance -
                        x.cwiseProduct(Vector3d(1, 0, 1)).norm()));
          all_good = all_good && result.converged && result.is_orthogonal;
        }
  std::cout << "Points over a ridge" << std::endl;
  report("  deviation of parameters and distance", deviation, 1e-13);
  report("  all converged and orthogonal", all_good);

  // Below the ridge the nearest points are on the two faces, as in a valley.
  deviation = 0;
  all_good  = true;
  for (const Vector2d &guess :
       {Vector2d(0.1, 0.1), Vector2d(0.9, 0.5), Vector2d(0.5, 0.3)})
    {
      const Vector3d     x(0, 0.1, -0.4);
      const ClosestPoint result = closest_point(surface, roof, x, &guess);
      grow(deviation, std::abs(result.distance - 0.4 / std::sqrt(1.25)));
      grow(deviation, std::abs(std::abs(result.xi[0] - 0.5) - 0.08));
      all_good = all_good && result.converged && result.is_orthogonal;
    }
  std::cout << "Points in a valley" << std::endl;
  report("  deviation of parameters and distance", deviation, 1e-13);
  report("  all converged and orthogonal", all_good);
}



/** No sample of a fine grid may be nearer than the global search's result. */
void
check_against_samples(const std::string  &name,
                      const NurbsSurface &surface,
                      const ControlNet   &net)
{
  const unsigned int    n = 80;
  std::vector<Vector3d> samples;
  for (unsigned int i = 0; i <= n; ++i)
    for (unsigned int j = 0; j <= n; ++j)
      samples.push_back(
        geometry_at(surface, net, Vector2d(1. * i / n, 1. * j / n)).y);

  unsigned int n_beaten = 0, n_failed = 0;
  double       inconsistency = 0;
  for (unsigned int k = 0; k < 300; ++k)
    {
      const Vector3d     x = samples[0] + Vector3d(random_number(-1.5, 1.5),
                                               random_number(-1.5, 1.5),
                                               random_number(-1.5, 1.5));
      const ClosestPoint result  = closest_point(surface, net, x);
      double             nearest = std::numeric_limits<double>::max();
      for (const Vector3d &sample : samples)
        nearest = std::min(nearest, (x - sample).norm());
      n_beaten += !(result.distance <= nearest + 1e-14);
      n_failed += !result.converged;
      grow(inconsistency,
           std::abs((x - geometry_at(surface, net, result.xi).y).norm() -
                    result.distance));
    }
  std::cout << name << ", 300 random points" << std::endl
            << "  beaten by samples: " << n_beaten << std::endl
            << "  not converged: " << n_failed << std::endl;
  report("  distance and parameters differ", inconsistency, 1e-14);
}



/** A surface with many hills: the nearest sample need not be in the element
 *  of the nearest point, and distances have many maxima and saddles. */
ControlNet
hilly(const NurbsSurface &surface)
{
  ControlNet net = surface.control_points();
  for (unsigned int k = 0; k < net.cols(); ++k)
    net(2, k) = random_number(-0.2, 0.2);
  return net;
}



/** Cases in which Newton's method has nothing to hold on to. */
void
check_that_it_ends()
{
  const NurbsSurface disk = NurbsSurface::disk(1., 6);
  ControlNet         cap  = disk.control_points();
  for (unsigned int k = 0; k < cap.cols(); ++k)
    cap(2, k) = 0.5 * cap.col(k).head<2>().squaredNorm();

  std::cout << "Hard cases" << std::endl;
  const Vector2d centre(0.5, 0.5), corner(0., 0.);

  // Beyond the centre of curvature the vertex is a maximum of the distance.
  const Vector3d     high(0, 0, 1.8);
  const ClosestPoint from_maximum = closest_point(disk, cap, high, &centre);
  report("  a maximum is left", from_maximum.distance < 1.75);
  report("  and a minimum found", from_maximum.converged);

  // In the centre of curvature the second derivative vanishes, and Newton's
  // method creeps.
  const SurfaceGeometry vertex    = geometry_at(disk, cap, centre);
  const double          radius    = vertex.a1.squaredNorm() / vertex.a11[2];
  const Vector3d        curvature = vertex.y + Vector3d(0, 0, radius);
  const ClosestPoint    focus     = closest_point(disk, cap, curvature);
  report("  centre of curvature: distance",
         std::abs(focus.distance - radius),
         1e-9);
  report("  converged there", focus.converged);

  const ClosestPoint from_corner =
    closest_point(disk, disk.control_points(), Vector3d(0, 0, 0.2), &corner);
  report("  from a singular corner to the centre",
         (from_corner.xi - centre).norm(),
         1e-13);

  // An element begins at 0.5; what misses it by rounding gets beyond, also
  // where there is nothing to be gained along the side.
  const Vector2d        by_rounding(0.5 - 3e-15, 0.3);
  const SurfaceGeometry side =
    geometry_at(disk, disk.control_points(), by_rounding);
  const Vector3d across =
    side.a1 - side.a1.dot(side.a2) / side.a2.squaredNorm() * side.a2;
  const Vector3d beyond = side.y + 0.1 * across;
  report(
    "  from a side but for rounding",
    closest_point(disk, disk.control_points(), beyond, &by_rounding).distance,
    1e-13);

  const ControlNet   point     = ControlNet::Zero(3, disk.n_control_points());
  const ClosestPoint collapsed = closest_point(disk, point, Vector3d(3, 4, 0));
  report("  surface shrunk to a point: distance",
         std::abs(collapsed.distance - 5.),
         1e-14);

  const double       nan = std::nan("");
  const ClosestPoint lost =
    closest_point(disk, cap, Vector3d(nan, 0, 0), &centre);
  report("  NaN does not converge", !lost.converged && !lost.is_orthogonal);
}



int
main()
{
  const NurbsSurface rectangle = rectangle_of(1, 1, 8, 4);
  const NurbsSurface disk      = NurbsSurface::disk(0.6, 8);
  const NurbsSurface linear    = rectangle_of(1, 1, 4, 4, 1);
  const NurbsSurface faceted   = disk.bilinear_interpolant();

  check_recovery("Flat rectangle", rectangle, rectangle.control_points());
  check_recovery("Deformed rectangle", rectangle, deformed(rectangle));
  check_recovery("Flat disk", disk, disk.control_points());
  check_recovery("Deformed disk", disk, deformed(disk));
  check_recovery("Flat rectangle, degree 1", linear, linear.control_points());
  check_facets(faceted, deformed(faceted));

  std::cout << "Disk near its corners" << std::endl;
  check_singular_corners(disk, 1.);
  std::cout << "Disk near its corners, from below" << std::endl;
  check_singular_corners(disk, -1.);

  check_above_corners(disk);
  check_beyond_rectangle(2);
  check_beyond_rectangle(1);
  check_beyond_disk(disk, 0.6);
  check_ridge();

  check_against_samples("Deformed rectangle", rectangle, deformed(rectangle));
  check_against_samples("Deformed disk", disk, deformed(disk));
  check_against_samples("Deformed disk, degree 1", faceted, deformed(faceted));
  check_against_samples("Hilly rectangle", rectangle, hilly(rectangle));
  check_against_samples("Hilly disk, degree 1", faceted, hilly(faceted));
  const NurbsSurface element = rectangle_of(1, 1, 1, 1);
  check_against_samples("One hilly element", element, hilly(element));
  check_that_it_ends();
}
