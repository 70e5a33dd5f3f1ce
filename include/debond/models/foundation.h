#ifndef debond_models_foundation_h
#define debond_models_foundation_h

#include <debond/output/torque_curve.h>
#include <debond/scene/scene.h>

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace Debond
{
  struct BodyPair;

  /** Stiffness of interface and bodies in series, lumped into the interface of
   *  a disk [MPa/mm]. */
  struct FoundationStiffness
  {
    double normal    = 0; ///< mean pressure per depth of push-in
    double torsional = 0; ///< lambda, with a torque pi/2 R^4 lambda theta

    /** What the solution says of one point of the interface, where a foundation
     *  has the same everywhere. */
    struct Point
    {
      double radius   = 0; ///< [mm]
      double area     = 0; ///< [mm^2]
      double phi_0    = 0; ///< initial bonding
      double pressure = 0; ///< over the mean pressure
      /** Traction about the axis per path radius * angle [MPa/mm]. */
      double stiffness = 0;
    };
    std::vector<Point> points;
  };

  /**
   * One linear solution with the bodies of @p scene, all of whose interface
   * sticks: pressed by a millionth of its radius, then turned by as little. The
   * bodies keep mesh and elasticity, rigid ones stay rigid. @p bodies: those of
   * an earlier call with a scene that has the same ones, or null; here they are
   * then. Throws InputError if the bodies do not touch all over then.
   */
  FoundationStiffness
  foundation_stiffness(const Scene               &scene,
                       std::shared_ptr<BodyPair> *bodies = nullptr);



  /**
   * Torques [N mm] at @p angles [rad] if every point had a foundation of its
   * own, with the pressure and the stiffness of the linear solution there.
   * @p pressure is the mean one [MPa]. Not a number if a point has no stiffness
   * or softens faster than it is stiff.
   */
  Eigen::ArrayXd
  torque_of_points(const FoundationStiffness &stiffness,
                   const FrictionLawPointer  &friction,
                   double                     pressure,
                   const Eigen::ArrayXd      &angles);

  /**
   * Estimates, without a finite element solution, how far the curve @p rows of
   * `Model = foundation` is from that of the bodies of @p scene on a converged
   * mesh, relative to the largest torque; that of the lines between the rows
   * is left out. The sum of
   *
   * - twice the difference that a foundation of its own for every point makes
   *   (@p stiffness, the linear solution that the model's stiffness is from);
   *   what sliding points do to their neighbours is taken to be as much again;
   * - the change of both from a @p coarse mesh, whose cells are @p cell_ratio
   *   times as large, with order one;
   * - for Neo-Hookean bodies the largest strain times their share in the
   *   compliance.
   *
   * Not a number if that cannot be said.
   */
  double
  foundation_error(const Scene                  &scene,
                   const std::vector<TorqueRow> &rows,
                   const FoundationStiffness    &stiffness,
                   const FoundationStiffness    &coarse,
                   double                        cell_ratio);
} // namespace Debond
#endif
