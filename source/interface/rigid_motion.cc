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



  inline RigidMotion::Way
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



  // Backwards: from the angle to sine and cosine, to the two velocities and n,
  // and to what these are made of. The turn T = Q Q_n^T spins with the frame by
  // psi, and its rotation vector a changes by J^-1 psi: for a rotation by t =
  // |a|,
  //
  //   J^-1 psi = psi - a x psi / 2 + c a x (a x psi),
  //   c = 1 / t^2 - (1 + cos t) / (2 t sin t).
  RigidMotion::TurnGradient
  RigidMotion::gradient_of_turn(const Vector3d &x, const Side slave) const
  {
    const auto [n, first, last] = way(x, slave);
    const Vector3d normal       = first.cross(last);
    const double   f_n = n.dot(first), l_n = n.dot(last), sine = n.dot(normal),
                 cosine = first.dot(last) - f_n * l_n,
                 square = sine * sine + cosine * cosine;
    TurnGradient by;
    if (!(std::sqrt(square) > 1e-12 * first.norm() * last.norm()))
      return by;
    const double   by_sine = cosine / square, by_cosine = -sine / square;
    const Vector3d by_first =
                     by_sine * last.cross(n) + by_cosine * (last - l_n * n),
                   by_last =
                     by_sine * n.cross(first) + by_cosine * (first - f_n * n),
                   by_n =
                     by_sine * normal - by_cosine * (l_n * first + f_n * last);

    // the first velocity is turned, or the lever arm of the last one
    const bool     is_bone = slave == Side::bone;
    const Vector3d r       = x - old_centre;
    const Vector3d by_velocity =
      is_bone ? Vector3d(turn.transpose() * by_first) : by_first;
    const Vector3d arm    = is_bone ? Vector3d(x - centre) : Vector3d(turn * r);
    const Vector3d by_arm = by_last.cross(axis);
    const Vector3d by_axis = r.cross(by_velocity) + arm.cross(by_last);
    const double   t       = axis.norm();
    const double   c =
      t < 0.01 ? 1. / 12. + t * t / 720. :
                   1. / (t * t) - (1. + std::cos(t)) / (2. * t * std::sin(t));
    const Vector3d across = axis.cross(by_axis);
    by.spin               = by_axis + 0.5 * across + c * axis.cross(across);
    by.centre             = by_velocity + by_last;
    if (is_bone)
      {
        by.centre -= by_arm;
        by.spin += first.cross(by_first) - implant_axis.cross(by_n);
      }
    else
      by.spin += arm.cross(by_arm);
    return by;
  }
} // namespace Debond
