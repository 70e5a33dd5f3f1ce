// A rigid wedge lies on an incline under a vertical force G and is pushed up
// horizontally, then let down: once it slides the horizontal force is
// F = G (tan a +- mu)/(1 -+ mu tan a), whatever the penalties. Two NURBS
// rectangles, inclined and turned in the plane; the contact law at the
// quadrature points of the wedge; the height of the wedge from the balance of
// the vertical force.

#include <debond/geometry/surface_geometry.h>
#include <debond/interface/contact_point.h>
#include <debond/interface/modified_coulomb.h>

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Geometry>

#include <stdexcept>
#include <vector>

#include "checks.h"
#include "rectangle_of.h"

using namespace Debond;
using Eigen::Vector3d;

/** Horizontal force per vertical force that pushes a rigid wedge up an incline.
 *  Negative @p mu: the force at which it slides down. */
double
wedge_force_ratio(const double slope, const double mu)
{
  return (slope + mu) / (1. - mu * slope);
}



class Wedge
{
public:
  Wedge(const double slope, const ContactPointLaw &law, const double G)
    : slope(slope)
    , law(law)
    , G(G)
    , rotation(Eigen::AngleAxisd(0.7, Vector3d::UnitZ()) *
               Eigen::AngleAxisd(-std::atan(slope), Vector3d::UnitY()))
    , push(Eigen::AngleAxisd(0.7, Vector3d::UnitZ()) * Vector3d::UnitX())
    , incline(rectangle_of(10, 9, 7, 4))
    , incline_positions(rotation * incline.control_points())
    , master{&incline, &incline_positions, 1.}
  {
    const NurbsSurface      face   = rectangle_of(4, 5, 2, 3);
    const ControlNet        placed = rotation * face.control_points();
    const dealii::QGauss<2> gauss(3);
    SurfaceBasis            basis;
    SurfaceGeometry         geometry;
    for (unsigned int element = 0; element < face.n_elements(); ++element)
      {
        const auto            bounds = face.element_bounds(element);
        const Eigen::Vector2d size   = bounds[1] - bounds[0];
        for (unsigned int k = 0; k < gauss.size(); ++k)
          {
            const Eigen::Vector2d xi(bounds[0][0] + size[0] * gauss.point(k)[0],
                                     bounds[0][1] +
                                       size[1] * gauss.point(k)[1]);
            face.evaluate_in_element(element, xi, basis);
            contract(basis, placed, geometry);
            Point point;
            point.X  = geometry.y;
            point.dA = geometry.a1.cross(geometry.a2).norm() * size.prod() *
                       gauss.weight(k);
            const Projection projection = project(master, point.X, nullptr);
            point.state.xi              = projection.xi;
            point.state.has_partner     = projection.faces;
            area += point.dA;
            points.push_back(point);
          }
      }
    height = -G / (law.joint->stiffness * area);
  }

  /** Moves by @p distance, finds the height, accepts the states. */
  void
  move(const double distance)
  {
    pushed += distance;
    height += slope * distance; // else it could lose contact
    constexpr unsigned int max_iterations = 30;
    for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
      {
        Vector3d traction  = Vector3d::Zero();
        double   stiffness = 0;
        for (Point &point : points)
          {
            update_contact_point(law,
                                 point.state,
                                 1.,
                                 point.X + pushed * push +
                                   height * Vector3d::UnitZ(),
                                 master,
                                 ContactPointMode(),
                                 point.result);
            traction += point.dA * point.result.traction;
            for (const int gap : {W::gap, W::trial_gap})
              stiffness += point.dA * point.result.dt(2, gap + 2);
          }
        // tractions enter the residual of the wedge: they are what pushes it
        force = traction;
        if (std::abs(force[2] + G) < 1e-11 * G)
          {
            for (Point &point : points)
              point.state = point.result.state;
            return;
          }
        height -= (force[2] + G) / stiffness;
      }
    throw std::runtime_error("the height of the wedge does not converge");
  }

  double
  force_ratio() const
  {
    return force.dot(push) / G;
  }

  /** Force across the direction of the push. */
  double
  side_force_ratio() const
  {
    return force.dot(Vector3d::UnitZ().cross(push)) / G;
  }

  bool
  all(const PointStatus status) const
  {
    for (const Point &point : points)
      if (point.result.failed || point.state.status != status)
        return false;
    return true;
  }

  /** Sliding distance of one of the points; all of them should have slid as
   *  far: grows @p spread by the differences. */
  double
  slip(double &spread) const
  {
    for (const Point &point : points)
      grow(spread, std::abs(point.state.slip - points[0].state.slip));
    return points[0].state.slip;
  }

  /** Path along the incline. */
  double
  path() const
  {
    const Vector3d up = rotation * Vector3d::UnitX();
    return up.dot(pushed * push + height * Vector3d::UnitZ());
  }

private:
  struct Point
  {
    Vector3d           X;
    double             dA = 0;
    ContactPointState  state;
    ContactPointResult result;
  };

  const double          slope;
  const ContactPointLaw law;
  const double          G;
  const Eigen::Matrix3d rotation;
  const Vector3d        push;
  const NurbsSurface    incline;
  const ControlNet      incline_positions;
  const MasterSurface   master;

  std::vector<Point> points;
  double             area = 0, pushed = 0, height = 0;
  Vector3d           force = Vector3d::Zero();
};



/** Up, back and up again, with many penalties. */
void
check_constant_friction()
{
  const double mu = 0.3, G = 12.;
  double       first = 0, up = 0, down = 0, side = 0, distance = 0, spread = 0;
  bool         begins_with_stick = true, slides = true;
  for (const double slope : {0.1, 0.5, -0.2})
    for (const auto &[eps_n, eps_t] : {std::array<double, 2>{{600, 600}},
                                       std::array<double, 2>{{600, 1e4}},
                                       std::array<double, 2>{{1e4, 200}}})
      {
        ContactPointLaw law;
        law.joint = friction_under_pressure(eps_n, modified_coulomb({mu, mu}));
        law.tangential_penalty = eps_t;
        Wedge wedge(slope, law, G);

        if (slope > 0 && eps_t / eps_n * slope < mu)
          {
            // what sinking in leaves of tangential traction is below the limit
            wedge.move(1e-12);
            begins_with_stick =
              begins_with_stick && wedge.all(PointStatus::stick);
          }
        for (unsigned int step = 0; step < 8; ++step)
          wedge.move(0.01);
        slides = slides && wedge.all(PointStatus::slip);
        grow(up, std::abs(wedge.force_ratio() - wedge_force_ratio(slope, mu)));
        if (slope == 0.1)
          grow(first, std::abs(wedge.force_ratio() - 0.412371));

        const double slid = wedge.slip(spread), path = wedge.path();
        wedge.move(0.3);
        grow(distance,
             std::abs(wedge.slip(spread) - slid - (wedge.path() - path)));

        for (unsigned int step = 0; step < 8; ++step)
          wedge.move(-0.02);
        slides = slides && wedge.all(PointStatus::slip);
        grow(down,
             std::abs(wedge.force_ratio() - wedge_force_ratio(slope, -mu)));

        for (unsigned int step = 0; step < 3; ++step)
          wedge.move(0.1);
        grow(up, std::abs(wedge.force_ratio() - wedge_force_ratio(slope, mu)));
        grow(side, std::abs(wedge.side_force_ratio()));
      }
  report("sticks at first where it should", begins_with_stick);
  report("slides everywhere", slides);
  report("F/G at tan a = 0.1, mu = 0.3 against 0.412371", first, 1e-6);
  report("F/G uphill against (tan a + mu)/(1 - mu tan a)", up, 1e-9);
  report("F/G downhill against (tan a - mu)/(1 + mu tan a)", down, 1e-9);
  report("force across", side, 1e-9);
  report("sliding distance against the path along the incline [mm]",
         distance,
         1e-12);
  report("difference of the sliding distance between points [mm]",
         spread,
         1e-12);
}



/** The coefficient falls as the wedge slides. */
void
check_falling_friction()
{
  ContactPointLaw law;
  law.joint              = friction_under_pressure(600, modified_coulomb());
  law.tangential_penalty = 600;
  Wedge  wedge(0.1, law, 12.);
  double deviation = 0, spread = 0, largest = 0, smallest = 1;
  for (unsigned int step = 0; step < 20; ++step)
    {
      wedge.move(0.005);
      if (!wedge.all(PointStatus::slip))
        continue;
      const double mu =
        law.joint->friction->coefficient({1., {wedge.slip(spread)}}, 0.).mu;
      grow(deviation,
           std::abs(wedge.force_ratio() - wedge_force_ratio(0.1, mu)));
      largest  = std::max(largest, mu);
      smallest = std::min(smallest, mu);
    }
  report("falls from its unbroken to its broken value",
         largest == ModifiedCoulombParameters().mu_unbroken &&
           smallest == ModifiedCoulombParameters().mu_broken);
  report("F/G with mu at the sliding distance", deviation, 1e-9);
}



int
main()
{
  check_constant_friction();
  check_falling_friction();
}
