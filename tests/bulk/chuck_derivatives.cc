// The chuck's velocities and second derivatives agree with central differences
// of the motion at small, moderate and large angles, its frame is a rotation,
// and that rotation is the exponential of the rotation vector times the spin.

#include <debond/bulk/chuck.h>

#include <Eigen/Geometry>

#include <string>
#include <vector>

#include "checks.h"

using namespace Debond;
using Eigen::Vector3d;

/** Six loaded components: all of them can be set. */
Chuck
free_chuck()
{
  ChuckParameters parameters;
  for (auto &component : parameters.component)
    component.loaded = true;
  return Chuck(parameters, Vector3d(0, 0, 3), 2.5);
}

void
set(Chuck &chuck, const Chuck::Vector6 &q)
{
  for (unsigned int k = 0; k < 6; ++k)
    chuck.correct(k, q[k] - chuck.position()[k]);
}



void
check(const std::string &name,
      const double       a_x,
      const double       a_y,
      const double       spin)
{
  std::cout << name << std::endl;
  Chuck          chuck = free_chuck();
  Chuck::Vector6 q;
  q << 0.3, -0.2, 0.1, a_x, a_y, spin;
  set(chuck, q);

  const Eigen::Matrix3d Q = chuck.rotation();
  report("  frame is orthogonal",
         (Q * Q.transpose() - Eigen::Matrix3d::Identity()).norm(),
         1e-14);
  report("  and keeps its hand, deviation",
         std::abs(Q.determinant() - 1.),
         1e-14);
  const double    angle = std::hypot(a_x, a_y);
  Eigen::Matrix3d expected =
    Eigen::AngleAxisd(spin, Vector3d::UnitZ()).toRotationMatrix();
  if (angle > 0.)
    expected =
      Eigen::AngleAxisd(angle, Vector3d(a_x, a_y, 0.) / angle) * expected;
  report("  frame is tilt times spin, deviation", (Q - expected).norm(), 1e-14);

  const Vector3d X(1.7, -0.9, 0.2), v(0.02, -0.01, 0.03), d(0.3, 0.8, -0.4);
  const Vector3d x      = chuck.map(X, v);
  const Vector3d turned = Q * d;
  report(
    "  position of a point, deviation",
    (x - (Vector3d(0.3, -0.2, 3.1) + Q * (X - Vector3d(0, 0, 3) + v))).norm(),
    1e-14);

  const double step  = 1e-5;
  double       first = 0, direction = 0, second = 0;
  for (unsigned int k = 0; k < 6; ++k)
    {
      const Vector3d velocity = chuck.velocity(k, x);
      // a direction carried along
      const Vector3d          rate = is_rotation(k) ?
                                       Vector3d(chuck.axis(k).cross(turned)) :
                                       Vector3d(Vector3d::Zero());
      std::array<Vector3d, 6> derivatives;
      for (unsigned int l = 0; l < 6; ++l)
        derivatives[l] = chuck.second_derivative(k, l, x);

      chuck.correct(k, step);
      const Vector3d after        = chuck.map(X, v),
                     turned_after = chuck.rotation() * d;
      std::array<Vector3d, 6> velocities_after, velocities_before;
      for (unsigned int l = 0; l < 6; ++l)
        velocities_after[l] = chuck.velocity(l, after);
      chuck.correct(k, -2. * step);
      const Vector3d before        = chuck.map(X, v),
                     turned_before = chuck.rotation() * d;
      for (unsigned int l = 0; l < 6; ++l)
        velocities_before[l] = chuck.velocity(l, before);
      set(chuck, q);

      grow(first, (velocity - (after - before) / (2. * step)).norm());
      grow(direction,
           (rate - (turned_after - turned_before) / (2. * step)).norm());
      // d/dq_k of dx/dq_l, which is symmetric
      for (unsigned int l = 0; l < 6; ++l)
        {
          const Vector3d difference =
            (velocities_after[l] - velocities_before[l]) / (2. * step);
          grow(second, (derivatives[l] - difference).norm());
          grow(second, (chuck.second_derivative(l, k, x) - difference).norm());
        }
    }
  report("  deviation of velocities", first, 1e-9);
  report("  deviation of velocities of directions", direction, 1e-9);
  report("  deviation of second derivatives", second, 1e-9);
}



int
main()
{
  check("Not turned", 0., 0., 0.);
  check("Tiny angles", 1e-9, -2e-9, 1e-8);
  check("As in the tests", 1e-3, 2e-3, 0.17);
  check("Below the switch to closed forms", 0.7, -0.71, 1.);
  check("Above it", 0.7, -0.72, 1.);
  check("A quarter turn", 1.1, 1.1, M_PI / 2.);
  check("Large angles", -2., 1.5, 7.);
  check("Tilted only", 0.7, 0., 0.);
}
