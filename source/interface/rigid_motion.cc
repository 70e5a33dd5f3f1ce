#include <debond/bulk/chuck.h>
#include <debond/interface/rigid_motion.h>

#include <Eigen/Geometry>

#include <cmath>

// The way of a point over the master in a step is straight where both bodies
// are pushed, and an arc where one turns. Eq. (31) as printed has one direction
// for the whole step; here the rigid motion of the chuck says by how much the
// way turns, and TowedGap integrates along it.
namespace Debond
{
  using Eigen::Vector3d;

  Place
  Place::of_implant(const InterfaceConfiguration &configuration)
  {
    return {configuration.side[Side::implant].frame,
            configuration.chuck->centre()};
  }



  // As a screw: the shortest rotation between both frames, at an even speed,
  // and an even translation of the centre.
  RigidMotion::RigidMotion(const Place &old_place, const Place &place)
    : turn(place.frame * old_place.frame.transpose())
    , old_centre(old_place.centre)
    , centre(place.centre)
  {
    const Eigen::AngleAxisd rotation(turn);
    axis = rotation.angle() * rotation.axis();
  }



  inline RigidMotion::Way
  RigidMotion::way(const Vector3d &x,
                   const Side      slave,
                   const Normal   &normal) const
  {
    // Velocities times the duration of the step [mm] of the point with the
    // lever arm r from the centre, at the first and at the last moment. The
    // screw has the same axis all the time.
    const auto velocity = [&](const Vector3d &r) {
      return Vector3d(centre - old_centre + axis.cross(r));
    };
    const bool            is_implant = slave == Side::implant;
    const Vector3d        r          = x - old_centre;
    const Vector3d       &n          = normal.n;
    const Eigen::Matrix3d identity   = Eigen::Matrix3d::Identity();
    Way                   result{n, velocity(r), velocity(turn * r), identity};
    if (!is_implant) // it stays, and is seen from the implant
      {
        result.first = turn * result.first;
        result.last  = velocity(x - centre);
      }
    if (normal.is_same)
      return result;
    // the rotation that takes one normal to the other, for what is normal to
    // the first: v - (n_2 . v) (n_1 + n_2) / (1 + n_1 . n_2)
    result.n = is_implant ? Vector3d(turn * n) : Vector3d(turn.transpose() * n);
    result.rolled =
      identity - (n + result.n) * result.n.transpose() / (1. + n.dot(result.n));
    result.first -= n.dot(result.first) * n;
    result.first = result.rolled * result.first;
    return result;
  }



  // The angle between the first and the last velocity, both in the tangent
  // plane of the end.
  double
  RigidMotion::turn_of_way(const Vector3d &x,
                           const Side      slave,
                           const Normal   &normal) const
  {
    const auto [n, first, last, rolled] = way(x, slave, normal);
    // along the axis alone it goes nowhere over the master, but for rounding
    // of the parts of both velocities in the tangent plane, times their lengths
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
  //
  // That the normal turns with the slave, where it does, is left out: it is of
  // second order in the step.
  RigidMotion::TurnGradient
  RigidMotion::gradient_of_turn(const Vector3d &x,
                                const Side      slave,
                                const Normal   &normal) const
  {
    const auto [n, first, last, rolled] = way(x, slave, normal);
    // d angle = (cos dsin - sin dcos)/(sin^2 + cos^2), with sine and cosine as
    // in turn_of_way(), which are not normalised.
    const Vector3d across_both = first.cross(last);
    const double   f_n = n.dot(first), l_n = n.dot(last),
                 sine   = n.dot(across_both),
                 cosine = first.dot(last) - f_n * l_n,
                 square = sine * sine + cosine * cosine;
    TurnGradient by;
    if (!(std::sqrt(square) > 1e-12 * first.norm() * last.norm()))
      return by;
    const double   by_sine = cosine / square, by_cosine = -sine / square;
    const Vector3d by_first =
                     rolled.transpose() *
                     (by_sine * last.cross(n) + by_cosine * (last - l_n * n)),
                   by_last =
                     by_sine * n.cross(first) + by_cosine * (first - f_n * n),
                   by_n = by_sine * across_both -
                          by_cosine * (l_n * first + f_n * last);

    // the first velocity is turned, or the lever arm of the last one
    const bool     is_bone = slave == Side::bone;
    const Vector3d r       = x - old_centre;
    // the gradient of the angle by both velocities is passed on to what moves
    // them: translation of the centre, rotation vector a, and lever arm
    const Vector3d by_velocity =
      is_bone ? Vector3d(turn.transpose() * by_first) : by_first;
    const Vector3d arm    = is_bone ? Vector3d(x - centre) : Vector3d(turn * r);
    const Vector3d by_arm = by_last.cross(axis);
    const Vector3d by_axis = r.cross(by_velocity) + arm.cross(by_last);
    const double   t       = axis.norm();
    // c of J^-1; its series where 1/t^2 and the rest would cancel
    const double c =
      t < 0.01 ? 1. / 12. + t * t / 720. :
                 1. / (t * t) - (1. + std::cos(t)) / (2. * t * std::sin(t));
    const Vector3d across = axis.cross(by_axis);
    by.spin               = by_axis + 0.5 * across + c * axis.cross(across);
    by.centre             = by_velocity + by_last;
    if (is_bone)
      {
        by.centre -= by_arm;
        by.spin += first.cross(by_first) + n.cross(by_n);
      }
    else
      by.spin += arm.cross(by_arm);
    return by;
  }
} // namespace Debond
