#ifndef debond_half_space_h
#define debond_half_space_h

#include <functional>

namespace Debond
{
  /**
   * @file
   * Exact solutions of contact on elastic half spaces, to verify the program
   * with. Lengths in mm, forces in N, stresses and moduli in MPa, angles in
   * radians.
   *
   * Sources: Johnson, Contact Mechanics (1985), sections 3.7 to 3.9, 4.2, 7.2
   * and 7.4; Reissner and Sagoci, J. Appl. Phys. 15 (1944) 652; Lubkin, J.
   * Appl. Mech. 18 (1951) 183; Jaeger, Arch. Appl. Mech. 65 (1995) 478 for the
   * superposition of rigid rotations.
   */

  /** Two elastic half spaces twist against each other like one of the modulus
   *  G, 1/G = 1/G_1 + 1/G_2 [MPa]. */
  double
  shear_modulus_of_pair(double shear_modulus_1, double shear_modulus_2);

  /** E*, 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2 [MPa]. An infinite modulus
   *  is a rigid body. */
  double
  contact_modulus(double young_modulus_1,
                  double poisson_ratio_1,
                  double young_modulus_2,
                  double poisson_ratio_2);

  /** Torque [N mm] of a rigid disk that is bonded to a half space and turned by
   *  @p angle [rad]: T = 16/3 G R^3 theta (Reissner and Sagoci). */
  double
  reissner_sagoci_torque(double shear_modulus, double radius, double angle);

  /** The same if half space and disk are joined by a tangentially elastic layer
   *  of stiffness eps_t [MPa/mm], as they are by the interface of this program
   *  while it sticks; the relative error is below 2e-5.
   *
   *  With the traction written as a sum of rigid rotations of smaller disks,
   *  tau(r) = 4 G r/pi int_r^R g(s) / sqrt(s^2 - r^2) ds, displacement plus
   *  tau/eps_t being theta r becomes
   *
   *    int_r^R g ds + 2/pi int_0^r g [asin x - x sqrt(1 - x^2)] ds, x = s/r,
   *    + 4 G / (pi eps_t) int_r^R g / sqrt(s^2 - r^2) ds = theta,
   *
   *  and T = 16/3 G int_0^R g s^3 ds. It is solved by collocation for a
   *  piecewise constant g, on intervals that become short towards the edge. */
  double
  reissner_sagoci_torque(double shear_modulus,
                         double radius,
                         double angle,
                         double tangential_penalty);



  /**
   * A circular contact on an elastic half space is twisted. Tangential traction
   * is limited by q(r) = mu p(r), so the rim slips and a disk of radius c
   * sticks. Torsion does not change p.
   *
   * When the stick radius is s and the angle grows by dtheta, the disk r < s
   * turns like a rigid one, so T grows by 16/3 G s^3 dtheta and the traction
   * by (4 G / pi) r dtheta / sqrt(s^2 - r^2) (Reissner and Sagoci). That the
   * sum of these tractions is q(r) for r > c is an equation of Abel's type with
   * the solution
   *
   *   theta(c) = 1/(2G) int_c^R q(r) dr / sqrt(r^2 - c^2),
   *   T(c) = 16/3 G c^3 theta(c) + 16 G int_c^R s^2 theta(s) ds
   *        = 4 int_c^R q(r) [2/3 c^3 / sqrt(r^2 - c^2)
   *                          + r^2 arccos(c/r) + c sqrt(r^2 - c^2)] dr
   *
   * (order of integration exchanged in the last line), and the traction at
   * r < c is
   *
   *   2/pi r sqrt(c^2 - r^2) int_c^R q(s) ds / ((s^2 - r^2) sqrt(s^2 - c^2)).
   */
  class TorsionalPartialSlip
  {
  public:
    /** Limit q [MPa] at the radius r; the second argument is sqrt(R^2 - r^2)
     *  [mm], which cannot be had from r at the edge without losing digits. q
     *  may be singular there like the inverse of it. */
    using Limit = std::function<double(double r, double to_edge)>;

    TorsionalPartialSlip(double       radius,
                         double       shear_modulus,
                         const Limit &limit);

    /** Angle theta [rad] at which the stick radius is @p c, 0 < @p c <= R. */
    double
    angle_at_stick_radius(double c) const;
    /** Torque T [N mm] at that angle, 0 <= @p c <= R. */
    double
    torque_at_stick_radius(double c) const;
    /** Tangential traction [MPa] at the radius @p r then. */
    double
    traction(double r, double c) const;

    /** T_max = 2 pi int r^2 q dr [N mm]: everything slips. */
    double
    largest_torque() const;
    /** Up to this angle [rad] nothing slips; 0 unless q is singular. */
    double
    angle_of_first_slip() const;

    /** c [mm] at the angle @p theta >= 0. Zero when it is below 1e-8 R. */
    double
    stick_radius(double theta) const;
    /** T [N mm] at the angle @p theta; odd in theta. */
    double
    torque(double theta) const;

  private:
    /** int_c^R f q(r) / sqrt(r^2 - c^2) dr for a function f of r and
     *  sqrt(r^2 - c^2) that varies over the length @p scale near r = c. */
    double
    integrate(double                                       c,
              double                                       scale,
              const std::function<double(double, double)> &f) const;

    const double R, G;
    const Limit  q;
  };



  /** q constant [MPa]. */
  TorsionalPartialSlip::Limit
  uniform_limit(double q);
  /** A rigid flat punch of radius R under the force P [N]:
   *  q = mu P / (2 pi R sqrt(R^2 - r^2)). */
  TorsionalPartialSlip::Limit
  flat_punch_limit(double radius, double mu, double force);
  /** Hertz, contact radius a under the force P [N]:
   *  q = 3 mu P / (2 pi a^2) sqrt(1 - r^2/a^2). */
  TorsionalPartialSlip::Limit
  hertz_limit(double radius, double mu, double force);

  /** Closed forms for q constant: theta = q/(2G) arcosh(R/c),
   *  T = 4/3 q R^3 [arccos k + k sqrt(1 - k^2)], k = c/R. */
  double
  uniform_limit_angle(double shear_modulus, double radius, double q, double c);
  double
  uniform_limit_torque(double radius, double q, double c);
  /** The same as a function of the angle [rad]: k = 1/cosh(2 G theta / q). */
  double
  uniform_limit_torque_at_angle(double shear_modulus,
                                double radius,
                                double q,
                                double angle);
  /** T_max = 2/3 pi q R^3. */
  double
  uniform_limit_largest_torque(double radius, double q);

  /** Flat punch: theta = mu P / (4 pi G R^2) K(k'), k'^2 = 1 - (c/R)^2. */
  double
  flat_punch_limit_angle(double shear_modulus,
                         double radius,
                         double mu,
                         double force,
                         double c);
  /** T_max = pi/4 mu P R. */
  double
  flat_punch_limit_largest_torque(double radius, double mu, double force);

  /** Hertz: theta = 3 mu P / (4 pi G a^2) [K(k') - E(k')] (Lubkin). */
  double
  hertz_limit_angle(double shear_modulus,
                    double radius,
                    double mu,
                    double force,
                    double c);
  /** T_max = 3 pi/16 mu P a. */
  double
  hertz_limit_largest_torque(double radius, double mu, double force);



  /** Sphere of radius Rc on a half space, or two spheres with 1/Rc = 1/R_1 +
   *  1/R_2, approaching by d (Hertz). */
  struct HertzContact
  {
    /** @p approach d and @p curvature_radius Rc [mm], @p modulus E* [MPa]. */
    HertzContact(double approach, double curvature_radius, double modulus);

    double radius;           ///< a = sqrt(Rc d) [mm]
    double force;            ///< P = 4/3 E* sqrt(Rc d^3) [N]
    double largest_pressure; ///< p_0 = 2/pi E* sqrt(d / Rc) [MPa]

    /** p(r) = p_0 sqrt(1 - r^2/a^2) [MPa]. */
    double
    pressure(double r) const;
  };



  /**
   * A Hertz contact under a constant force P is loaded by a tangential force Q,
   * 0 <= Q <= mu P (Cattaneo, Mindlin). The ring c < r < a slips. Its slip is
   * taken to be parallel to Q, which is exact for Poisson's ratio 0 and a good
   * approximation otherwise.
   */
  struct CattaneoMindlin
  {
    double mu     = 0; ///< friction coefficient
    double force  = 0; ///< P [N]
    double radius = 0; ///< a [mm]
    /** (2 - nu_1)/G_1 + (2 - nu_2)/G_2 [1/MPa]; nothing for a rigid body. */
    double tangential_compliance = 0;

    /** c = a (1 - Q/(mu P))^(1/3) [mm]. */
    double
    stick_radius(double tangential_force) const;
    /** Relative displacement of distant points [mm]:
     *  3 mu P / (16 a) compliance [1 - (1 - Q/(mu P))^(2/3)]. */
    double
    displacement(double tangential_force) const;
    /** Tangential traction [MPa] at the radius @p r. */
    double
    traction(double r, double tangential_force) const;
  };



  /** Horizontal force per vertical force that pushes a rigid wedge up an
   *  incline: (tan a + mu)/(1 - mu tan a). Negative @p mu: the force at which
   *  it slides down, (tan a - mu)/(1 + mu tan a). */
  double
  wedge_force_ratio(double slope, double mu);
} // namespace Debond
#endif
