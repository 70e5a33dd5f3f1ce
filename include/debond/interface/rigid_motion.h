#pragma once

#include <debond/interface/interface_configuration.h>

namespace Debond
{
  /** Where the implant is: Q, and the centre of its chuck [mm]. */
  struct Place
  {
    Eigen::Matrix3d frame  = Eigen::Matrix3d::Identity();
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();

    static Place
    of_implant(const InterfaceConfiguration &configuration);
  };

  /** Motion of the implant in a step, as a rigid body whose centre goes
   *  straight while it turns evenly. */
  struct RigidMotion
  {
    RigidMotion(const Place &old_place, const Place &place);

    /** Displacement of a point of the slave that was at @p x, as the master
     *  sees it, in space at the end [mm]. */
    Eigen::Vector3d
    over_master(const Eigen::Vector3d &x, const Side slave) const
    {
      const Eigen::Vector3d motion = centre + turn * (x - old_centre) - x;
      return slave == Side::implant ? motion : Eigen::Vector3d(-motion);
    }

    /** The master's normal towards the slave where a point was, carried along
     *  with the master to the end, and whether it is the same everywhere. */
    struct Normal
    {
      Eigen::Vector3d n;
      bool            is_same = true;
    };

    /** The angle by which it turns the way of a point of the slave that was at
     *  @p x over the master, about the @p normal [rad]. Where that differs from
     *  place to place it turns with the slave, and the way is straight if it is
     *  so in the plane that rolls along: about an axis, on a cylinder, it is.
     */
    double
    turn_of_way(const Eigen::Vector3d &x,
                Side                   slave,
                const Normal          &normal) const;

    /** Derivatives of that angle by the place of the implant at the end. */
    struct TurnGradient
    {
      Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< [rad/mm]
      Eigen::Vector3d spin = Eigen::Vector3d::Zero(); ///< by that of the frame
    };
    TurnGradient
    gradient_of_turn(const Eigen::Vector3d &x,
                     Side                   slave,
                     const Normal          &normal) const;

    Eigen::Matrix3d turn;               ///< from beginning to end
    Eigen::Vector3d axis;               ///< of the turn, times its angle [rad]
    Eigen::Vector3d old_centre, centre; ///< [mm]

  private:
    /** Velocities over the master at both ends of the step, times its duration
     *  [mm], the first one rolled to the end; the normal there; and how the
     *  first one was rolled. */
    struct Way
    {
      Eigen::Vector3d n, first, last;
      Eigen::Matrix3d rolled;
    };
    Way
    way(const Eigen::Vector3d &x, Side slave, const Normal &normal) const;
  };
} // namespace Debond
