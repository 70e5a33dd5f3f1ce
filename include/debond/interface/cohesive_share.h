#pragma once

#include <debond/interface/contact_point_state.h>

#include <Eigen/Core>

namespace Debond
{
  /** The share of a slave point that is held at the place of the master to
   *  which it has bonded, by laws that have one. It is a point that sticks
   *  there for good, beside the share that rubs. */
  struct CohesiveShare
  {
    /** The trial state of a slave point at @p x that began the step as @p start
     *  says. */
    void
    update(const InterfaceLaw    &law,
           const PointStart      &start,
           const Eigen::Vector3d &x,
           const MasterSurface   &master);

    /** Work that its damage dissipates per area on the straight way from the
     *  gap @p before, by the law [N/mm]. */
    double
    damage_work(const InterfaceLaw    &law,
                PointStart             start,
                const Eigen::Vector3d &before) const;

    /** @name History */
    //@{
    /** Parameters of the master where it is bonded. */
    Eigen::Vector2d xi = Eigen::Vector2d::Zero();
    /** The gap that bears in the accepted state, in the master's frame [mm]. */
    Eigen::Vector3d gap = Eigen::Vector3d::Zero();
    //@}

    /** @name Trial state of the last update(), and its derivatives */
    //@{
    bool            holds    = false;
    double          damage   = 0;        ///< at the end of the step
    double          pressure = 0;        ///< negative: the pull [MPa]
    Eigen::Vector3d normal;              ///< of the master
    Eigen::Vector3d bears, traction;     ///< the gap that does [mm], [MPa]
    double          energy = 0;          ///< [N/mm]
    double          stiffness_by_damage; ///< [MPa/mm]
    SurfaceBasis    basis;               ///< of the master

    /** By the gap x - y and the tangents a_1 and a_2 there. */
    Eigen::Matrix<double, 3, 9> dt;      ///< of the traction
    Eigen::Matrix<double, 1, 9> ddamage; ///< of the damage
    //@}

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &xi &gap;
    }
  };
} // namespace Debond
