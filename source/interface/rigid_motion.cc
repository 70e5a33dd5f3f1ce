#include <debond/bulk/chuck.h>
#include <debond/interface/rigid_motion.h>

#include <Eigen/Geometry>

#include <cmath>

namespace Debond
{
  using Eigen::Vector3d;

  Place
  Place::of_implant(const InterfaceConfiguration &configuration)
  {
    return {configuration.side[Side::implant].frame,
            configuration.chuck->centre()};
  }



  RigidMotion::RigidMotion(const Place &old_place, const Place &place)
    : turn(place.frame * old_place.frame.transpose())
    , old_centre(old_place.centre)
    , centre(place.centre)
    , implant_axis(place.frame.col(2))
  {
    const Eigen::AngleAxisd rotation(turn);
    axis = rotation.angle() * rotation.axis();
  }



  RigidMotion::Way
  RigidMotion::way(const Vector3d &x, const Side slave) const
  {
    const auto velocity = [&](const Vector3d &r) {
      return Vector3d(centre - old_centre + axis.cross(r));
    };
    const Vector3d r     = x - old_centre;
    const Vector3d first = velocity(r);
    if (slave == Side::implant)
      return {Vector3d::UnitZ(), first, velocity(turn * r)};
    // it stays, and is seen from the implant
    return {-implant_axis, turn * first, velocity(x - centre)};
  }



  double
  RigidMotion::turn_of_way(const Vector3d &x, const Side slave) const
  {
    const auto [n, first, last] = way(x, slave);
    // along the axis alone it goes nowhere over the master, but for rounding
    const double sine   = n.dot(first.cross(last)),
                 cosine = first.dot(last) - n.dot(first) * n.dot(last);
    return std::hypot(sine, cosine) > 1e-12 * first.norm() * last.norm() ?
             std::atan2(sine, cosine) :
             0.;
  }



  // The turn T = Q Q_n^T spins by psi = omega - T omega_n, and its rotation
  // vector a changes by J^-1 psi: for a rotation by t = |a|,
  //
  //   J^-1 psi = psi - a x psi / 2 + c a x (a x psi),
  //   c = 1 / t^2 - (1 + cos t) / (2 t sin t).
  RigidMotion::Way
  RigidMotion::change_of_way(const Vector3d    &x,
                             const Vector3d    &dx,
                             const Side         slave,
                             const PlaceChange &old_change,
                             const PlaceChange &change) const
  {
    const double t = axis.norm();
    const double c =
      t < 0.01 ? 1. / 12. + t * t / 720. :
                 1. / (t * t) - (1. + std::cos(t)) / (2. * t * std::sin(t));
    const Vector3d psi        = change.spin - turn * old_change.spin,
                   by         = axis.cross(psi);
    const Vector3d d_axis     = psi - 0.5 * by + c * axis.cross(by);
    const Vector3d d_centre   = change.shift - old_change.shift;
    const auto     d_velocity = [&](const Vector3d &r, const Vector3d &dr) {
      return Vector3d(d_centre + d_axis.cross(r) + axis.cross(dr));
    };
    const Vector3d r = x - old_centre, dr = dx - old_change.shift;
    const Vector3d d_first = d_velocity(r, dr);
    if (slave == Side::implant)
      {
        const Vector3d turned = turn * r;
        return {Vector3d::Zero(),
                d_first,
                d_velocity(turned, psi.cross(turned) + turn * dr)};
      }
    return {-change.spin.cross(implant_axis),
            psi.cross(way(x, slave).first) + turn * d_first,
            d_velocity(x - centre, dx - change.shift)};
  }



  double
  RigidMotion::change_of_turn(const Vector3d    &x,
                              const Vector3d    &dx,
                              const Side         slave,
                              const PlaceChange &old_change,
                              const PlaceChange &change) const
  {
    const auto [n, first, last] = way(x, slave);
    const auto [dn, d_first, d_last] =
      change_of_way(x, dx, slave, old_change, change);
    const Vector3d normal = first.cross(last);
    const double   sine   = n.dot(normal),
                 cosine   = first.dot(last) - n.dot(first) * n.dot(last),
                 square   = sine * sine + cosine * cosine;
    if (!(std::sqrt(square) > 1e-12 * first.norm() * last.norm()))
      return 0.;
    const double d_sine =
      dn.dot(normal) + n.dot(d_first.cross(last) + first.cross(d_last));
    const double d_cosine = d_first.dot(last) + first.dot(d_last) -
                            (dn.dot(first) + n.dot(d_first)) * n.dot(last) -
                            n.dot(first) * (dn.dot(last) + n.dot(d_last));
    return (cosine * d_sine - sine * d_cosine) / square;
  }
} // namespace Debond
