#pragma once

#include <debond/interface/modified_coulomb.h>

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <vector>

namespace Debond
{
  /**
   * Closed forms of a disk that is pressed on a surface and turned about its
   * axis by a rotation that began at zero and never reversed. All fields depend
   * on the radius r alone; points outside the stick radius c(theta) slide.
   * Everything is odd in theta or even, as it should be.
   */
  class TorsionModel
  {
  public:
    static constexpr double undefined =
      std::numeric_limits<double>::quiet_NaN();

    struct Disk
    {
      double radius   = 0; ///< R [mm]
      double pressure = 0; ///< p [MPa], the same everywhere
      /** Of the tangential traction per path of points that stick [MPa/mm]:
       *  eps_t, or lambda of Eq.\ (39). */
      double stiffness = 0;
      double phi_0     = 1; ///< initial bonding inside bonded_radius
      /** Points further out are not bonded at the start [mm]. */
      double bonded_radius        = std::numeric_limits<double>::infinity();
      FrictionLawPointer friction = modified_coulomb();

      /** Limit of the traction by a bond that slip has worn, and its slope. */
      FrictionLimit
      limit(const double phi_0, const double slip = 0.) const
      {
        return friction->limit_after({phi_0, {slip}}, pressure, 0.);
      }
      /** The path r theta after which a point has slid by @p slip [mm]. */
      double
      path(const double phi_0, const double slip = 0.) const
      {
        return slip + limit(phi_0, slip).value / stiffness;
      }
      /** The sliding distance, from one before on, at a path that is beyond
       *  it [mm]. */
      double
      slip_at(double phi_0, double path, double before = 0.) const;
    };
    const Disk disk;

    explicit TorsionModel(const Disk &disk)
      : disk(disk)
    {}
    virtual ~TorsionModel() = default;

    /** The interface at one radius. NaN: not part of the model. */
    struct Point
    {
      bool   sticks   = true;
      double slip     = 0; ///< accumulated sliding distance g_s [mm]
      double traction = 0; ///< tangential, with the sign of theta [MPa]
      double phi      = 0; ///< bonding state
      double mu       = 0; ///< friction coefficient
    };
    /** At the radius @p r in [0, R] [mm] and the angle @p theta [rad]. */
    virtual Point
    point(double r, double theta) const = 0;

    /** Radius c in [0, R] inside which points stick [mm]. */
    virtual double
    stick_radius(double theta) const = 0;

    /** Sums over the disk. NaN: not part of the model. */
    struct State
    {
      double torque        = 0; ///< T [N mm]
      double phi_mean      = 0; ///< area mean
      double stored_energy = 0; ///< of the tangential traction [N mm]
      double dissipation   = 0; ///< work of friction since theta = 0 [N mm]
      double adhesive_work = 0; ///< its part above mu_b p, D_adh [N mm]
    };
    /** Integrates the fields of point() over the disk. */
    virtual State
    state(double theta) const;

    /** Torque T [N mm] at the angle @p theta [rad]: Eq.\ (37). */
    double
    torque(const double theta) const
    {
      return state(theta).torque;
    }

  protected:
    /** Radii [mm] where the fields of point() are not smooth, in any order;
     *  those outside of ]0, R[ do not matter. */
    virtual std::vector<double>
    kinks(double) const
    {
      return {};
    }
    /** phi_0 at a radius [mm]. */
    double
    initial_bonding(const double r) const
    {
      return r <= disk.bonded_radius ? disk.phi_0 : 0.;
    }
    /** The point at the radius @p r after the sliding distance @p slip. */
    Point
    point_with(bool sticks, double r, double slip, double theta) const;
  };



  /**
   * Two rigid bodies on the elastic frictional interface: a disk is pressed
   * down by a depth d and turned by an angle theta about its axis. The finite
   * element program must reproduce it up to quadrature, and to 3/2 (mu p /
   * eps_t R)^2 of the torque: here the gap of a sliding point does not turn
   * with the path (doc/explanation/closed_forms.md).
   *
   * The pressure p is eps_n d. A point at radius r sticks with the
   * traction t = eps_t r theta while that is at most L(p, 0). Beyond, its path
   * r theta is sliding plus elastic deformation of the interface,
   *
   *   r theta = g_s + t / eps_t,   t = L(p, g_s),
   *
   * and the torque is T = 2 pi int_0^R r^2 t dr.
   *
   * With compliant bodies it still is a good estimate if eps_t is replaced by
   * the stiffness lambda of the interface and the bulk in series, Eq. (39), and
   * p by the mean pressure: `Model = foundation`.
   */
  class RigidBodiesTorsion : public TorsionModel
  {
  public:
    /** Throws dealii::ExcMessage unless has_unique_solution(). */
    explicit RigidBodiesTorsion(const Disk &disk);

    /** Whether the law softens slowly enough, |d mu/d g_s| p < eps_t
     *  everywhere; otherwise the traction jumps at some angle. */
    static bool
    has_unique_solution(const Disk &disk)
    {
      return disk.friction->steepest_fall({disk.phi_0}, disk.pressure) <
             disk.stiffness;
    }

    /** Sliding distance g_s [mm] at the radius @p r [mm] and the angle @p theta
     *  [rad] of a rotation that began at zero and never reversed. */
    double
    slip(double r, double theta) const;

    Point
    point(const double r, const double theta) const override
    {
      const double g_s = slip(r, theta);
      return point_with(g_s == 0., r, g_s, theta);
    }
    double
    stick_radius(double theta) const override;

  private:
    std::vector<double>
    kinks(double theta) const override;
  };



  /**
   * The torque [N mm] of RigidBodiesTorsion at many @p angles [rad] at once.
   * The traction depends on the path s = r theta alone, so that one integral
   * along it serves all of them,
   *
   *   T(theta) = 2 pi / |theta|^3 int_0^(R |theta|) s^2 t(s) ds,
   *
   * taken over the sliding distance g, s = g + mu(g) p / eps_t, which takes no
   * iteration between the ends.
   *
   * @p disk must have a unique solution.
   */
  Eigen::VectorXd
  torsion_curve(const TorsionModel::Disk  &disk,
                const std::vector<double> &angles);



  /**
   * Two rigid bodies turned by a compliant machine: a torsion spring k stands
   * between the machine and the disk, so that the machine's angle is
   *
   *   theta_m(theta) = theta + T(theta) / k.
   *
   * States of equilibrium are a curve with the disk's angle theta as parameter.
   * Where T falls steeper than -k the machine's angle falls along the curve, it
   * snaps back: a machine that turns on and on leaves the curve at the maximum
   * of theta_m and jumps, at that angle, to the next theta that belongs to it.
   * Stored energy is then released without equilibrium,
   *
   *   k/2 [(theta_m - theta_1)^2 - (theta_m - theta_2)^2]
   *     - int_theta_1^theta_2 T dtheta.
   *
   * Angles are in radians and not negative.
   */
  class CompliantMachineTorsion
  {
    const TorsionModel &bodies;
    const double        stiffness, largest_angle;

  public:
    /** @p bodies must outlive this object. @p stiffness k > 0 of the machine
     *  [N mm/rad]; the curve is searched up to the angle @p largest_angle of
     *  the disk [rad] at a few thousand points. */
    CompliantMachineTorsion(const TorsionModel &bodies,
                            double              stiffness,
                            double              largest_angle);

    /** theta_m at the angle @p theta of the disk [rad]. */
    double
    machine_angle(const double theta) const
    {
      return theta + bodies.torque(theta) / stiffness;
    }

    /** What a machine that turns on and on cannot follow. */
    struct Jump
    {
      double machine_angle = 0;                   ///< [rad]
      double angle_before = 0, angle_after = 0;   ///< theta [rad]
      double torque_before = 0, torque_after = 0; ///< [N mm]
      double released_energy = 0;                 ///< [N mm]
    };
    std::vector<Jump> jumps;

    /** theta [rad] when a machine that turns on and on has come to @p
     *  machine_angle <= `largest_angle` [rad]; at a jump the angle before. */
    double
    angle(double machine_angle) const;

  private:
    /** On a branch that rises. */
    double
    angle_between(double begin, double end, double machine_angle) const;
  };



  /**
   * The analytical model of the paper with the modified Coulomb law,
   * Eqs.\ (17), (18), (37), (49): c(theta) = R theta_lin / theta; inside, the
   * traction is t_max r / c with t_max = mu(0) p; outside it is mu(g_s) p with
   * g_s = 0 while theta < theta_slide and g_s = r (theta - theta_slide +
   * theta_lin) from then on.
   *
   * The sliding distance of Eq. (49) is not the motion that the traction works
   * on, so this model does not balance energy.
   *
   * @p linear_limit theta_lin > 0, @p full_sliding theta_slide >= theta_lin
   * [rad]. The stiffness of @p disk follows from theta_lin, Eqs. (43) and (46).
   */
  std::unique_ptr<TorsionModel>
  prescribed_angles_torsion(const TorsionModel::Disk &disk,
                            double                    linear_limit,
                            double                    full_sliding);

  /**
   * The model of Mathieu et al. (2012) as the paper prints it, Eqs. (14) to
   * (16): a circular mode III crack runs inwards through the bond between a
   * rigid disk and an elastic half space; behind its tip the constant friction
   * tau_0 acts. Before the crack starts, the bonded disk of Reissner and
   * Sagoci.
   *
   * @p shear_modulus G > 0 [MPa], @p adhesion_energy w_adh >= 0 [N/mm],
   * @p friction_stress tau_0 >= 0 [MPa]. Of @p disk only the radius counts.
   */
  std::unique_ptr<TorsionModel>
  crack_torsion(const TorsionModel::Disk &disk,
                double                    shear_modulus,
                double                    adhesion_energy,
                double                    friction_stress);
} // namespace Debond
