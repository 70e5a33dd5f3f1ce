#ifndef debond_interface_contact_point_h
#define debond_interface_contact_point_h

#include <debond/geometry/closest_point.h>
#include <debond/geometry/nurbs_surface.h>
#include <debond/interface/contact_law.h>

#include <Eigen/Core>

namespace Debond
{
  /** Numbers as they appear in the VTU array `state`. */
  enum class PointStatus : unsigned char
  {
    open  = 0,
    stick = 1,
    slip  = 2
  };

  /** The state of one slave quadrature point. */
  struct ContactPointState : PointHistory
  {
    PointStatus status = PointStatus::open;
    /** True if @p xi faces the point; false for points beyond the master's
     * edge. */
    bool has_partner = false;
    /** Interacting point on the master, xi_hat. */
    Eigen::Vector2d xi = Eigen::Vector2d::Zero();

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &status &has_partner &broken &xi &slip;
      for (double &variable : internal)
        archive &variable;
    }
  };

  /** A point in this state at the beginning of a step, for its friction law. */
  inline FrictionState
  friction_state(const ContactPointState &state,
                 const double             phi_0,
                 const double             duration = 0.)
  {
    return {state.bond_left(phi_0), state.slip, state.internal, duration};
  }

  /** The master surface in its current configuration. */
  struct MasterSurface
  {
    const NurbsSurface *surface   = nullptr;
    const ControlNet   *positions = nullptr; ///< spatial [mm]
    /** +-1 such that this times a_1 x a_2 points to the slave. */
    double outward_sign = 1;
  };

  /** Where a slave point projects on the master. */
  struct Projection
  {
    Eigen::Vector2d xi        = Eigen::Vector2d::Zero();
    bool            converged = false;
    /** Whether xi can be an interacting point: x - y is normal to the surface
     *  there, and the surface regular. In the corners of a disk the tangents
     *  are parallel; once it is deformed the normal close to them can point
     *  anywhere. */
    bool faces = false;
    /** How far the surfaces can move before a point that does not face the
     *  master can be in contact [mm]. */
    double clearance = 0;
  };
  Projection
  project(const MasterSurface   &master,
          const Eigen::Vector3d &x,
          const Eigen::Vector2d *guess);

  /** How the update is to be done. */
  struct ContactPointMode
  {
    /** Closed points stick whatever their traction: a first Newton iteration
     *  with the stick tangent cannot cycle between stick and slip. */
    bool stick_first = false;
    /** Gaps of this size are rounding of positions [mm]. Such a point counts as
     *  closed with stick_first (touching bodies under a loaded chuck would else
     *  be singular), and as open without (rounding must not wear the bond). */
    double touch_tolerance = 0;
    /** The interface is frictionless for now and slip is not accumulated. */
    bool frictionless = false;
    /** Duration of the step [unit of time]; 0 where no time passes, and nothing
     *  has a speed. */
    double duration = 0;
    /** Direction of slip in space, of any length; zero: that of the trial gap.
     *  The tangent takes it as fixed. */
    Eigen::Vector3d slip_direction = Eigen::Vector3d::Zero();
  };

  /** Viscous resistance eta / dt per sliding distance of a step [MPa/mm]; 0
   *  where there is no friction. */
  double
  viscous_stiffness(const ContactPointLaw &law, const ContactPointMode &mode);

  /**
   * Everything one quadrature point contributes.
   *
   * Derivatives are with respect to w = (x, y, a_1, a_2, y_n), 15 numbers:
   * slave point, master point and tangents at xi_hat, and the master point at
   * the old xi_hat^n. They are total: the motion of xi_hat is eliminated by the
   * implicit function theorem on its two equations.
   */
  struct ContactPointResult
  {
    ContactPointState state;
    bool              failed = false; ///< the local iteration found no solution
    bool              negative_friction = false; ///< or one with a negative mu

    /** t = eps_n g_n n + t_t [MPa], as it enters the residual of the slave. */
    Eigen::Vector3d traction            = Eigen::Vector3d::Zero();
    Eigen::Vector3d tangential_traction = Eigen::Vector3d::Zero();
    /** Part of the tangential traction that the viscosity makes up [MPa]. */
    Eigen::Vector3d viscous_traction = Eigen::Vector3d::Zero();
    /** y(xi_hat) - y(xi_hat^n) on the current surface [mm]. */
    Eigen::Vector3d slip_increment = Eigen::Vector3d::Zero();
    double          normal_gap     = 0; ///< g_n [mm]
    double          pressure       = 0; ///< p >= 0 [MPa]
    double          energy         = 0; ///< stored per area [N/mm]
    /** |d mu/d g_s| p / (eps_t + eta / dt) where the law softens; the local
     *  solution is unique while this is below one. */
    double softening = 0;

    SurfaceBasis                 basis;     ///< master basis at xi_hat
    SurfaceBasis                 old_basis; ///< at xi_hat^n; only when slipping
    Eigen::Matrix<double, 3, 15> dt;        ///< dt/dw
    Eigen::Matrix<double, 2, 15> dxi;       ///< dxi_hat/dw
  };

  /** A point that is open whatever its gap, for that it is beyond the edge of
   *  the master: writes @p result. */
  void
  leave_open(const ContactPointLaw   &law,
             const ContactPointState &old_state,
             ContactPointResult      &result);

  /**
   * The update of one slave quadrature point: (state_n, kinematics) ->
   * (traction, tangent, state_n+1). A pure function: nothing but @p result is
   * written.
   *
   * Stick iff eps_t |g_t| <= mu(g_s^n) p at xi_hat^n; otherwise xi_hat solves
   * Eqs. (29) and (30),
   *
   *   h_alpha = a_alpha . (g - t_t / eps_t) = 0,
   *   t_t = (mu(g_s) p + eta (g_s - g_s^n) / dt) tau,
   *   g_s = g_s^n + |y(xi_hat) - y(xi_hat^n)|            [Eq. (32)],
   *
   * with tau the direction of the trial gap x - y(xi_hat^n) projected on the
   * tangent plane at xi_hat, and mu taken at the updated g_s; @p law and @p
   * mode may say otherwise.
   */
  void
  update_contact_point(const ContactPointLaw   &law,
                       const ContactPointState &old_state,
                       double                   phi_0,
                       const Eigen::Vector3d   &x,
                       const MasterSurface     &master,
                       const ContactPointMode  &mode,
                       ContactPointResult      &result);
} // namespace Debond
#endif
