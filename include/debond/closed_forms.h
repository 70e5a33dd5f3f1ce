#ifndef debond_closed_forms_h
#define debond_closed_forms_h

#include <debond/friction_law.h>

namespace Debond
{
  /**
   * Two rigid bodies on the elastic frictional interface: a disk is pressed
   * down by a depth d and turned by an angle theta about its axis. This is the
   * exact solution of the interface law for rigid bodies, so the finite element
   * program must reproduce it up to quadrature.
   *
   * The pressure is p = eps_n d everywhere. A point at radius r sticks with the
   * traction t = eps_t r theta while that is at most mu(0) p. Beyond, its path
   * r theta is sliding plus elastic deformation of the interface,
   *
   *   r theta = g_s + t / eps_t,   t = mu(g_s) p,
   *
   * and the torque is T = 2 pi int_0^R r^2 t dr.
   *
   * With compliant bodies it still is a good estimate if eps_t is replaced by
   * the stiffness of the interface and the bulk in series and p by the mean
   * pressure.
   */
  class RigidBodiesTorsion
  {
  public:
    struct Parameters
    {
      double             radius             = 0; ///< R [mm]
      double             push_in            = 0; ///< d >= 0 [mm]
      double             normal_penalty     = 0; ///< eps_n [MPa/mm]
      double             tangential_penalty = 0; ///< eps_t [MPa/mm]
      double             phi_0              = 1; ///< initial bonding, uniform
      FrictionParameters friction;
    };

    /** Throws dealii::ExcMessage unless has_unique_solution(). */
    explicit RigidBodiesTorsion(const Parameters &parameters);

    /** Whether the law softens slowly enough, |d mu/d g_s| p < eps_t
     *  everywhere; otherwise the traction jumps at some angle. */
    static bool
    has_unique_solution(const Parameters &parameters);

    /** p [MPa]. */
    double
    pressure() const;

    /** Sliding distance g_s [mm] at the radius @p r [mm] and the angle @p theta
     *  [rad] of a rotation that began at zero and never reversed. */
    double
    slip(double r, double theta) const;

    /** Tangential traction t [MPa], with the sign of @p theta. */
    double
    traction(double r, double theta) const;

    /** Torque T [N mm] at the angle @p theta [rad]; odd in theta. */
    double
    torque(double theta) const;

  private:
    /** The path r theta at which the sliding distance is @p slip [mm]. */
    double
    path(double slip) const;

    const Parameters parameters;
  };
} // namespace Debond
#endif
