#include <debond/geometry/surface_geometry.h>
#include <debond/interface/bilinear_bond.h>
#include <debond/interface/cohesive_share.h>
#include <debond/interface/slip_problem.h>

namespace Debond
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  // The gap to the place where it bonded, x - y(xi), has a part along the
  // normal there and one along the face. What bears is all of it where it
  // opens, and the part along the face where it is pressed: the pressure is
  // that of the whole area, and acts at xi_hat.
  void
  CohesiveShare::update(const InterfaceLaw  &law,
                        const PointStart    &start,
                        const Vector3d      &x,
                        const MasterSurface &master)
  {
    // No iteration: the place xi does not move over the master, so that
    // traction and damage follow from positions alone, as those of a point that
    // sticks.
    damage = start.history.damage;
    holds  = start.history.joined && start.phi_0 > 0. && damage < 1.;
    energy = pressure = 0.;
    bears = traction = normal = Vector3d::Zero();
    if (!holds)
      return;
    SurfaceGeometry geometry;
    master.surface->evaluate(xi, basis);
    contract(basis, *master.positions, geometry);
    const MasterNormal of_master(geometry, master.outward_sign);
    const Vector3d    &n = of_master.n;
    // bone that has been crushed lies deeper
    const double   crushed   = start.history.crushed;
    const Vector3d whole     = x - geometry.y + crushed * n;
    const double   g_n       = n.dot(whole);
    const Vector3d along     = whole - g_n * n;
    const double   length    = along.norm();
    const Vector3d direction = length > 0. ? Vector3d(along / length) : along;
    // The bond knows the gap by two numbers, across and along [mm], and so has
    // no preferred direction in the face.
    const CohesiveResponse response = law.cohesion->hold(start, g_n, length);
    const bool             opens    = g_n > 0.;

    normal              = n;
    damage              = response.damage;
    stiffness_by_damage = response.stiffness_by_damage;
    bears               = opens ? whole : along;
    traction            = response.stiffness * bears;
    energy              = 0.5 * response.stiffness * bears.squaredNorm();
    pressure            = opens ? -response.stiffness * g_n : 0.;

    // dg_n = n . dg + g . dn,   d|delta_t| = tau . (dg - g_n dn)
    const Eigen::Matrix<double, 3, 6> dn = of_master.derivative();
    ddamage << response.damage_by_normal * n.transpose() +
                 response.damage_by_tangential * direction.transpose(),
      (response.damage_by_normal * whole.transpose() -
       response.damage_by_tangential * (g_n - crushed) *
         direction.transpose()) *
        dn;
    // The gap that bears, by g, a_1 and a_2: all of g, or its part in the
    // tangent plane, (1 - n n^T) g, which changes as the normal turns. Then t =
    // k bears with the k of the damage: rank one is added by domega.
    Eigen::Matrix<double, 3, 9> dbears;
    dbears << Matrix3d::Identity(), crushed * dn;
    if (!opens)
      {
        dbears.leftCols<3>() -= n * n.transpose();
        dbears.rightCols<6>() -=
          (n * whole.transpose() + g_n * Matrix3d::Identity()) * dn;
      }
    dt = response.stiffness * dbears +
         response.stiffness_by_damage * bears * ddamage;
  }



  // Integral of K phi_0 delta^2/2 over the damage, in parts of the way.
  double
  CohesiveShare::damage_work(const InterfaceLaw &law,
                             PointStart          start,
                             const Vector3d     &before) const
  {
    // Trapezoids in delta^2: on a way that is not straight from the origin the
    // mixture of modes changes from part to part.
    constexpr unsigned int n       = 50;
    double                 work    = 0.;
    double                 squared = before.squaredNorm();
    for (unsigned int i = 1; i <= n; ++i)
      {
        const Vector3d gap = before + (bears - before) * i / n;
        const double g_n = normal.dot(gap), along = (gap - g_n * normal).norm(),
                     next = law.cohesion->hold(start, g_n, along).damage;
        work -= 0.25 * stiffness_by_damage * (next - start.history.damage) *
                (squared + gap.squaredNorm());
        start.history.damage = next;
        squared              = gap.squaredNorm();
      }
    return work;
  }
} // namespace Debond
