#pragma once

#include <debond/geometry/surface_geometry.h>
#include <debond/interface/contact_point_state.h>

namespace Debond
{
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
    /** How high the point lies over the plane that touches the surface there
     *  [mm]. */
    double height = 0;
  };
  /** On pieces that face the slave, whose @p normal at x points out of it; if
   *  it has none on that of the guess. */
  Projection
  project(const MasterSurface   &master,
          const Eigen::Vector3d &x,
          const Eigen::Vector2d *guess,
          const Eigen::Vector3d *normal = nullptr);

  /** Viscous resistance eta / dt per sliding distance of a step [MPa/mm]; 0
   *  where there is no friction. */
  double
  viscous_stiffness(const ContactPointLaw &law, const ContactPointMode &mode);

  /** Writes the @p result of a point that is open, with the gap @p g_n [mm] for
   *  output: 0 beyond the edge of the master. */
  void
  leave_open(const ContactPointLaw   &law,
             const ContactPointState &old_state,
             ContactPointResult      &result,
             double                   g_n = 0.);

  /**
   * The update of one slave quadrature point: (state_n, kinematics) ->
   * (traction, tangent, state_n+1). Nothing but @p result is written, and
   * nothing of it matters but what it knows of the master at xi_hat^n.
   *
   * Stick iff eps_t |g_t| <= mu(g_s^n) p at xi_hat^n; otherwise xi_hat solves
   * Eqs. (29) and (30),
   *
   *   h_alpha = a_alpha . (g - t_t / eps_t) = 0,
   *   t_t = (mu(g_s) p + eta (g_s - g_s^n) / dt) tau,
   *
   * with mu taken at the updated g_s. tau and g_s are those of TowedGap, or,
   * with SlipDirection::trial, tau is the direction of the trial gap x -
   * y(xi_hat^n) projected on the tangent plane at xi_hat and g_s = g_s^n +
   * |y(xi_hat) - y(xi_hat^n)| [Eq. (32)].
   */
  void
  update_contact_point(const ContactPointLaw   &law,
                       const ContactPointState &start,
                       double                   phi_0,
                       const Eigen::Vector3d   &x,
                       const MasterSurface     &master,
                       const ContactPointMode  &mode,
                       ContactPointResult      &result);

  /** What a quadrature point of the slave surface keeps of a step. Members are
   *  numbers and matrices of fixed size only, see SavedState. */
  struct SlavePointHistory
  {
    ContactPointState accepted;
    /** For points beyond the master's edge: how far the surfaces may still
     *  move before such a point has to be projected again [mm]. */
    double clearance = 0;
    /** Of a point that has just left a piece of the master over its edge: the
     *  height over another one, of which it is below already [mm]; else 0. */
    double enters_at = 0;
    /** Tangential traction of the accepted state in the master's frame [MPa].
     */
    Eigen::Vector3d accepted_traction         = Eigen::Vector3d::Zero();
    Eigen::Vector3d accepted_viscous_traction = Eigen::Vector3d::Zero();
    double          accepted_viscous_pressure = 0; ///< [MPa]
    /** Sum of the slip of the steps in the master's frame [mm], and what that
     *  and the elastic gap were at the last mark, see RelativeMotion. */
    Eigen::Vector3d slipped = Eigen::Vector3d::Zero();
    Eigen::Vector3d marked  = Eigen::Vector3d::Zero();
  };

  /** A quadrature point of the slave surface: where it lies, its history, and
   *  what it contributes in the trial state. Its basis takes off the gap that
   *  it has at the start, see ContactInterface::find_facets(). */
  struct SlavePoint : SurfaceQuadraturePoint, SlavePointHistory
  {
    double             phi_0 = 0;
    ContactPointResult trial;
    /** Of a trial in which it has left the master over its edge: how far it
     *  slid to there [mm]; else 0. */
    double path_to_edge = 0;
    /** False for points of a bone that does not face the implant at the
     *  start: their area does not count. */
    bool faces_implant = true;

    /** phi and mu in one of its states. */
    FrictionCoefficient
    friction(const InterfaceLaw &law, const ContactPointState &state) const
    {
      return law.reported(state, phi_0, trial.pressure);
    }

    /** The step that leads to the trial state, as its law sees it. */
    PointStart
    begin(const InterfaceLaw &law, const ContactPointMode &mode) const
    {
      return law.begin(accepted, phi_0, mode.duration, mode.frictionless);
    }

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      if constexpr (is_in_memory<Archive>)
        {
          archive.copy(static_cast<SlavePointHistory &>(*this));
          archive.copy(static_cast<ContactPointAnswer &>(trial));
        }
      else
        {
          archive &accepted &clearance &enters_at &accepted_traction;
          archive &accepted_viscous_traction      &accepted_viscous_pressure;
          archive &slipped                        &marked;
          // what a run that has ended still writes
          archive &trial.pressure &trial.tangential_traction;
          if (Archive::is_loading::value)
            trial.state = accepted;
        }
    }
  };
} // namespace Debond
