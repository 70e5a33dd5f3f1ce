#pragma once

#include <debond/geometry/nurbs_surface.h>
#include <debond/interface/interface_law.h>
#include <debond/support/serialization.h>

#include <Eigen/Core>

namespace Debond
{
  /** Numbers as they appear in the VTU array `state`. */
  enum class PointStatus : unsigned char
  {
    open   = 0,
    stick  = 1,
    slip   = 2,
    pulled = 3, ///< across the interface only: it rubs nowhere
    shears = 4  ///< it slides in the bone
  };

  /** Whether a point's xi_hat moves. */
  inline bool
  slides(const PointStatus status)
  {
    return status >= PointStatus::slip;
  }

  /** The state of one slave quadrature point. */
  struct ContactPointState : PointHistory
  {
    PointStatus status = PointStatus::open;
    /** True if @p xi faces the point; false for points beyond the master's
     * edge. */
    bool has_partner = false;
    /** Interacting point on the master, xi_hat. */
    Eigen::Vector2d xi = Eigen::Vector2d::Zero();
    /** Tangential gap, in parts of the master's a_1 and a_2 there: it moves
     *  with the master as it turns and deforms. */
    Eigen::Vector2d gap = Eigen::Vector2d::Zero();

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &status &has_partner &broken &joined &xi &gap &normal_gap;
      archive &slip &damage &crushed &crushed_at            &sheared;
      for (double &variable : internal)
        archive &variable;
    }
  };

  /** The master surface in its current configuration. */
  struct MasterSurface
  {
    const NurbsSurface *surface   = nullptr;
    const ControlNet   *positions = nullptr; ///< spatial [mm]
    /** +-1 such that this times a_1 x a_2 points to the slave. */
    double outward_sign = 1;
    /** Whether it is a plane z = const at rest. */
    bool is_level = false;
    /** Whether it is any plane at rest. */
    bool is_flat = false;
  };

  /** How the update is to be done. */
  struct ContactPointMode
  {
    /** Closed points stick whatever their traction: a first Newton iteration
     *  with the stick tangent cannot cycle between stick and slip. */
    bool stick_first = false;
    /** What has left the master over its edge stays open, also where without it
     *  the bodies go back by a part of what it stands for. */
    bool leaves_for_good = false;
    /** Gaps of this size are rounding of positions [mm]. Such a point counts as
     *  closed with stick_first (touching bodies under a loaded chuck would else
     *  be singular), and as open without (rounding must not wear the bond). */
    double touch_tolerance = 0;
    /** The interface is frictionless for now and slip is not accumulated. */
    bool frictionless = false;
    /** Duration of the step [unit of time]; 0 where no time passes, and nothing
     *  has a speed. */
    double duration = 0;
    /** For SlipDirection::integrated: the angle by which the rigid motion of
     *  the bodies turns the way of the point over the master in the step, about
     *  the normal [rad]. */
    double turn = 0;
    /** Of the share of the point that is held, at the end of the step. */
    double damage = 0;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &stick_first &touch_tolerance &frictionless &duration;
      archive &turn                                       &damage;
    }
  };

  /** What becomes of a quadrature point, as far as it is to be seen between two
   *  steps. Members are numbers and matrices of fixed size only, see
   *  SavedState. */
  struct ContactPointAnswer
  {
    ContactPointState state;
    bool              failed = false; ///< the local iteration found no solution
    bool              negative_friction = false; ///< or one with a negative mu

    double pressure         = 0; ///< p [MPa]; negative where it pulls
    double viscous_pressure = 0; ///< the part of it that speed makes up [MPa]

    /** t = eps_n g_n n + t_t [MPa], as it enters the residual of the slave. */
    Eigen::Vector3d traction            = Eigen::Vector3d::Zero();
    Eigen::Vector3d tangential_traction = Eigen::Vector3d::Zero();
    /** Part of the tangential traction that the viscosity makes up [MPa]. */
    Eigen::Vector3d viscous_traction = Eigen::Vector3d::Zero();
    /** y(xi_hat) - y(xi_hat^n) on the current surface [mm]. */
    Eigen::Vector3d slip_increment = Eigen::Vector3d::Zero();
    double          normal_gap     = 0; ///< g_n [mm]
    double          energy         = 0; ///< stored per area [N/mm]
    /** How far a point that left the master over its edge slid before [mm];
     *  else 0. */
    double path_to_edge = 0;
  };

  /** w = (g, a_1, a_2, g*, g_n, turn), by which traction and xi_hat of a
   *  closed point change: the gap x - y, the master's tangents at xi_hat, the
   *  trial gap x - y_n to the old xi_hat^n, the tangential gap of the step
   * before where the master has taken it, and the angle by which the point's
   * way turns. Here is where in w each of them begins; a point that sticks
   * knows the first three only. */
  struct W
  {
    static constexpr int gap = 0, a1 = 3, a2 = 6, trial_gap = 9, old_gap = 12,
                         turn = 15, size = 16;
  };

  /**
   * Everything one quadrature point contributes.
   *
   * Derivatives with respect to w are total: the motion of xi_hat is eliminated
   * by the implicit function theorem on its two equations.
   */
  struct ContactPointResult : ContactPointAnswer
  {
    /** Of the master at xi_hat, or at xi_hat^n if the point is open. */
    SurfaceBasis                      basis;
    KeptBasis                         old_basis; ///< at xi_hat^n
    Eigen::Matrix<double, 3, W::size> dt;        ///< dt/dw
    Eigen::Matrix<double, 2, W::size> dxi;       ///< dxi_hat/dw
    /** d(g_s + opening)/dw, which a path is measured by. */
    Eigen::Matrix<double, 1, W::size> dpath;
    /** How they change with the damage of the share that is held, by laws that
     *  hold one. */
    struct ByDamage
    {
      Eigen::Vector3d traction = Eigen::Vector3d::Zero();
      Eigen::Vector2d xi       = Eigen::Vector2d::Zero();
    };
    ByDamage by_damage;
    /** d turn / dq of the chuck, where a component of it is unknown. */
    Eigen::Matrix<double, 6, 1> turn_by_chuck =
      Eigen::Matrix<double, 6, 1>::Zero();
  };
} // namespace Debond
