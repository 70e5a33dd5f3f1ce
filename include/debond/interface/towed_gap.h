#pragma once

#include <Eigen/Core>

#include <cmath>
#include <complex>

namespace Debond
{
  /** Arc that turns by an angle: chord and end of one of length 1. */
  struct Arc
  {
    explicit Arc(const double turn = 0.)
      : turn(turn)
      , chord_over_length(std::abs(turn) < 1e-5 ?
                            1. - turn * turn / 24. :
                            std::sin(0.5 * turn) / (0.5 * turn))
      , half_turn(std::polar(1., 0.5 * turn))
    {}

    double               turn;              ///< [rad]
    double               chord_over_length; ///< sin(turn/2) / (turn/2)
    std::complex<double> half_turn;         ///< exp(i turn/2)
  };



  /**
   * Gap of a sliding point, as it turns in a step, and the distance that the
   * point slides: the variant `integrated' of Expert / Slip direction.
   *
   * In the tangent plane the tangential gap g is a string that tows its anchor,
   * the interacting point. The point moves along a path, seen from the master;
   * the string holds while it is shorter than L = mu p / eps_t, and else pulls
   * the anchor along: with the angle alpha from the path's direction to g,
   *
   *   d alpha/ds = kappa - sin(alpha) / L,   d g_s/ds = cos(alpha) - dL/ds,
   *
   * with kappa = minus the curvature of the path.
   *
   * The path is a chord or, where the step turns it, an arc; while it slides L
   * is the mean of its lengths at the beginning and the end of sliding. Where
   * neither changes the result does not depend on the size of the step, else it
   * is of second order in it. doc/explanation/contact.md has the derivation.
   */
  struct TowedGap
  {
    /** Gap, motion and limits of the step, in the tangent plane. */
    struct Step
    {
      const Arc      &arc;        ///< of the path
      Eigen::Vector2d old_gap;    ///< g of the step before [mm]
      Eigen::Vector2d motion;     ///< of the point in the step [mm]
      double          old_limit;  ///< L at the beginning [mm]
      double          held_limit; ///< at the end if it has not slid [mm]
      double          length;     ///< of g at the end [mm]
    };
    explicit TowedGap(const Step &step);

    Eigen::Vector2d direction; ///< of g at the end
    /** g_s - g_s^n [mm]; negative only at trial places where the point would
     *  slide against its traction. */
    double distance;
    /** d(direction, distance)/d(old_gap, motion, held_limit, length, turn). */
    Eigen::Matrix<double, 3, 7> derivative;
  };
} // namespace Debond
