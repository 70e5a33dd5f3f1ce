#pragma once

#include <debond/bulk/body.h>
#include <debond/bulk/chuck.h>
#include <debond/interface/contact_interface.h>
#include <debond/system/coupled_tangent.h>
#include <debond/system/load_step_parameters.h>
#include <debond/system/press_fit.h>
#include <debond/system/whole_solver.h>

#include <memory>
#include <string>

namespace dealii
{
  class TimerOutput;
}

namespace Debond
{
  /** The two bodies of a scene: meshes, stiffness and its factors, all of them
   *  independent of friction and loads, so that variants of a study share them.
   */
  struct BodyPair
  {
    explicit BodyPair(const ModelParameters &parameters);

    /** For another run with them. */
    void
    return_to_rest()
    {
      bone->return_to_rest();
      implant->return_to_rest();
    }

    const std::unique_ptr<Body> bone, implant;
    /** Seconds that a study took for them, for all variants that use them. */
    double seconds_shared = 0;
  };



  /**
   * The two bodies, the chuck and the interface as one system of equations in
   * the unknowns that matter to friction: the contact unknowns of the bone,
   * those of the implant, and the chuck components that are not prescribed,
   *
   *   S v_c + Q^T f_contact(v_c, q) = 0,   sum_A f_A . dx_A/dq_k - load_k = 0.
   *
   * Where the scene follows a path of equilibrium, PathEquation says what else
   * is unknown.
   *
   * Everything here is a trial state until commit(). A step goes as follows:
   *
   *   predict()                            where it starts,
   *   evaluate(), solve(), correct(), ...  Newton's method, see solve_newton(),
   *   commit() or rollback()               what becomes of it, see StepSolver.
   *
   * The tangent is that of the last evaluate(): solve() uses no other.
   */
  class CoupledSystem
  {
    std::shared_ptr<BodyPair> both_bodies;

  public:
    /** @p bodies: those of @p parameters if they have been built already, at
     *  rest; they are this system's from now on. Seconds go to the sections
     *  `bulk`, `condensation`, `contact` and `dense solve` of @p timer, if
     *  there is one; it must outlive this object. */
    explicit CoupledSystem(const ModelParameters    &parameters,
                           std::shared_ptr<BodyPair> bodies = nullptr,
                           dealii::TimerOutput      *timer  = nullptr);
    /** Its parts refer to each other. */
    CoupledSystem(const CoupledSystem &) = delete;

    std::shared_ptr<BodyPair>
    bodies() const
    {
      return both_bodies;
    }

    /** Places the implant as the scene says at @p time, undeformed, faces the
     *  slave points with the master and chooses the contact unknowns. */
    void
    start(double time);

    unsigned int
    n_unknowns() const
    {
      return unknowns;
    }

    /** Starts a step to @p time from the accepted state, on the line through
     *  the last two if @p extrapolate; @p parameter is what that is drawn over,
     *  and what was given to commit() with them. */
    void
    predict(double time, double parameter, bool extrapolate);
    /** To be called after predict() with a guess of the time: the step grows
     *  the mean sliding distance by @p slip [mm], and the time is found. Only
     *  where the scene follows the path. */
    void
    prescribe_slip(const double slip)
    {
      path.slip = slip;
    }
    void
    commit(double parameter);
    void
    rollback();

    struct Residual
    {
      std::string why; ///< no residual could be formed; else empty
      /** In the contact unknowns of the bone, those of the implant and the
       *  unknown chuck components [N, N mm]. */
      Eigen::VectorXd unknowns;
      double          norm = 0; ///< Euclidean norm of the whole residual [N]
      double          reference = 0; ///< norm of the contact forces [N]
      /** Part of norm^2 that the bulk's interior makes up. */
      double interior_share = 0;
    };
    /** Contact forces and residual of the trial state. Makes control points
     *  contact unknowns where contact has spread to new ones. */
    Residual
    evaluate(const ContactPointMode &mode);

    /** Derivative of the residual of the last evaluate(). */
    const CoupledTangent &
    tangent() const
    {
      return matrix;
    }

    /** A change of the trial state. */
    struct Correction
    {
      Eigen::VectorXd unknowns; ///< of the system
      /** Displacements of the two bodies, the interior included [mm]. */
      std::array<Eigen::VectorXd, 2> bodies;
      std::string                    why; ///< there is none; else empty
    };
    /** Newton's correction for the @p residual of the last evaluate(), solved
     *  for to @p relative_tolerance. */
    Correction
    solve(const Residual &residual, double relative_tolerance);
    /** Null where the bone is condensed. */
    const MultigridEffort *
    multigrid_effort() const
    {
      return bone.whole() ? &effort_of_multigrid : nullptr;
    }
    /** True if a component is loaded, so that contact alone holds it. */
    bool
    is_held_by_contact() const;
    /** Adds @p fraction of a correction to the trial state. */
    void
    correct(const Correction &correction, double fraction = 1.);
    /** Time of the trial state. */
    double
    time() const
    {
      return trial_time;
    }
    /** Forms and condenses the bulk tangents at the trial state. False if one
     *  is not positive definite. */
    bool
    refactor_bulk();

    /** Measure of a path, in the trial state [mm]; 0 where none is
     *  followed. */
    double
    path_length() const
    {
      return path.follow ? interface.path_length(configuration).value : 0.;
    }

    /** Where a residual of the present state is largest, for messages. */
    std::string
    describe_worst_point(const Residual &residual) const;

    /** Generalised forces sum_A f_A . dx_A/dq_k of the trial state: what the
     *  chuck exerts on the implant, conjugate to its six components [N, N mm].
     */
    Chuck::Vector6
    chuck_forces() const;
    /** Part of the accepted forces that points carried which leave the master
     *  over its edge in the trial state, on the trial state's arms. */
    Chuck::Vector6
    let_go() const;
    /** Force and moment about C + u that the chuck exerts on the implant, in
     *  space, from the contact forces [N, N mm]. */
    Chuck::Vector6
    chuck_resultant() const;
    /** Derivatives of forces and place of the chuck with respect to the time in
     *  which a step ends. Finite where the equations can be solved. */
    struct Rates
    {
      Chuck::Vector6 forces = Chuck::Vector6::Zero(); ///< of chuck_forces()
      Chuck::Vector6 reaction =
        Chuck::Vector6::Zero(); ///< of chuck_resultant()
      Chuck::Vector6 position = Chuck::Vector6::Zero(); ///< of the chuck
      NodalSums      surfaces; ///< of the control points in space

      /** See serialization.h. */
      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &forces &reaction &position &surfaces;
      }
    };
    /** In the state of the last evaluate(), which has to be one of equilibrium.
     *  Not along a path. */
    Rates
    rates();
    /** The configuration with all six components of the chuck as unknowns, the
     *  last ones. */
    InterfaceConfiguration
    with_whole_chuck() const;
    /** By how much chuck_forces() in the state of the last evaluate() would
     *  differ after steps of half the @p duration, by way of the cubic through
     *  both ends with these rates; without those at the beginning, of the
     *  parabola. See ContactInterface. */
    Chuck::Vector6
    difference_of_halves(double       duration,
                         const Rates *begin,
                         const Rates &end) const;
    /** Strain energy of both bodies in the state of the last evaluate() [N mm].
     */
    double
    bulk_energy() const
    {
      return bulk_residual[Side::bone].energy +
             bulk_residual[Side::implant].energy;
    }
    /** Force and moment of the supports on a body in that state, see Body. */
    Chuck::Vector6
    support_reaction(const Side side, const Eigen::Vector3d &centre) const
    {
      return body[side]->support_reaction(centre, bulk_residual[side]);
    }
    /** |contact resultant - reaction of the supports| of the implant relative
     *  to the larger of the two, moments divided by R: 0 for a rigid implant.
     */
    double
                                reaction_defect() const;
    Body                       &bone, &implant;
    const std::array<Body *, 2> body; ///< the two by their side
    Chuck                       chuck;
    ContactInterface            interface;
    PressFit                    press_fit;
    /** Surfaces in space as of the last evaluate() or commit(). */
    InterfaceConfiguration configuration;
    const double           R; ///< characteristic radius of the implant [mm]

    /** See serialization.h. To be called after start() and commit(). */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &bone &implant &chuck &interface &press_fit;
      archive &path.old_slip &trial_time;
      for (Body::Residual &residual : bulk_residual)
        {
          archive &residual.energy;
          if constexpr (is_in_memory<Archive>)
            archive &residual.internal_force;
        }
      archive &effort_of_multigrid;
      if (Archive::is_loading::value)
        {
          update_configuration();
          number_unknowns();
        }
      archive &solver; // its matrix has the size that is known only now
    }

  private:
    /** The correction that brings faces under a load into contact. */
    Correction
    approach() const;
    void
    update_configuration();
    /** Forces of interface.force() on the body itself. */
    ControlNet
    force_on_points(Side side) const;
    double
    evaluate_chuck(Residual &residual);
    /** Of the implant's control points about C + u, in space [mm]. */
    ControlNet
    arms_of_chuck() const;
    /** Of a resultant what does work on the components of the chuck. */
    Chuck::Vector6
    in_components(const Chuck::Vector6 &total) const;
    Eigen::VectorXd
    rates_by_duration(const InterfaceConfiguration &moving);
    void
    number_unknowns();
    bool
    extend_contact_unknowns();
    bool
    complete_surfaces();
    double
    scale_of(const unsigned int chuck_component) const
    {
      return is_rotation(chuck_component) ? R : 1.;
    }

    /** Solves with the tangent where the bone is a WholeBulk. */
    WholeSolution
    solve_whole(const Eigen::VectorXd &b,
                const Eigen::VectorXd &b_of_bone,
                double                 relative_tolerance) const;
    /** The same for forces at the unknowns only. */
    Eigen::VectorXd
    solve_with_whole_bone(const Eigen::VectorXd &right,
                          double                 relative_tolerance) const;

    dealii::TimerOutput *const timer;
    mutable MultigridEffort    effort_of_multigrid;
    unsigned int               unknowns    = 0;
    double                     force_floor = 0; ///< [N]
    /** Of each body in the last evaluate(). */
    std::array<Body::Residual, 2> bulk_residual;
    DenseSolver                   solver;
    double                        trial_time = 0;
    PathEquation                  path;
    const CoupledTangent          matrix;
  };
} // namespace Debond
