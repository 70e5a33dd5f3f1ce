#pragma once

#include <debond/interface/bonding_pattern.h>
#include <debond/interface/cohesive_share.h>
#include <debond/interface/interface_configuration.h>
#include <debond/interface/interface_parameters.h>
#include <debond/interface/point_motion.h>
#include <debond/interface/rigid_motion.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  /** Sums over all points of the interface in their trial states, and what is
   *  largest among them. */
  struct InterfaceSummary
  {
    double phi_mean    = 0; ///< area mean over the implant's contact face
    double share_stick = 0, share_slip = 0, share_open = 0, share_pulled = 0,
           share_shears = 0;
    double pressure = 0, tangential = 0; ///< area means [MPa]
    double energy = 0;                   ///< stored [N mm]
    /** Largest -dL/d g_s / (eps_t + eta / dt), where the law of a point falls
     *  steepest from the g_s on that the step began with: the local solution is
     *  unique while this is below 1. Zero for the explicit law, which does not
     *  ask. */
    double steepest_softening = 0;
    /** p, and -dL/d g_s of that point [MPa, MPa/mm]. */
    double softening_pressure = 0, softening_slope = 0;
    /** How fast the pull of a bond may fall as it opens, if a point has opened
     *  beyond its strength in the step, and no viscosity resists that
     *  [MPa/mm]. */
    double       opening_softening = 0;
    double       squared_traction  = 0; ///< integral over the area [N^2/mm^2]
    double       max_penetration   = 0; ///< [mm]
    double       max_traction      = 0; ///< [MPa]
    unsigned int bonded_opened =
      0;                       ///< points with phi > 0 that opened in this step
    unsigned int n_closed = 0; ///< or held apart by a bond
    /** Where nothing faced the master before: points that came over its edge
     *  from below its surface and are closed now, and how deep they are at most
     *  [mm]. */
    unsigned int n_from_side = 0;
    double       side_depth  = 0;
    /** Points beyond the edge of the master, and those that crossed it. */
    unsigned int n_beyond = 0, n_crossed = 0;
  };

  /** Area mean of the sliding distance g_s and, of laws with strength in
   *  tension, the opening of points over the contact face [mm], and its
   *  derivatives with respect to the positions of the control points of both
   *  surfaces, in space, and to the chuck where these stay: it turns the way of
   *  the points. */
  struct PathLength
  {
    double                      value = 0;
    NodalSums                   gradient;
    Eigen::Matrix<double, 6, 1> by_chuck = Eigen::Matrix<double, 6, 1>::Zero();
  };

  /** How far the faces have moved along each other between two times: slip and
   *  elastic gap, which bone that is to grow in feels both. Of the face of the
   *  implant. */
  struct RelativeMotion
  {
    double from = 0, to = 0;
    double mean_um = 0, percentile_95_um = 0;
    double share_above_28_um = 0, share_above_150_um = 0;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &from &to &mean_um &percentile_95_um &share_above_28_um
        &share_above_150_um;
    }
  };

  /** What a point carries, as it acts on the slave [MPa]. */
  struct PointTraction
  {
    double          pressure   = 0; ///< negative where it pulls
    Eigen::Vector3d tangential = Eigen::Vector3d::Zero();

    /** Its angle to the normal where it pulls, and 90 degrees where it presses,
     *  if it has a tangential part [deg]: 0 in mode I, 90 in modes II and III.
     */
    double
    mode_deg() const
    {
      return std::atan2(tangential.norm(), std::max(0., -pressure)) * 180. /
             M_PI;
    }
  };

  /** What the implant passes on to the bone at a point, and what the springs
   *  there store. */
  struct PointLoad
  {
    Eigen::Vector3d force  = Eigen::Vector3d::Zero(); ///< [N]
    Eigen::Vector3d moment = Eigen::Vector3d::Zero(); ///< [N mm]
    double          energy = 0;                       ///< [N mm]
  };

  /** How the faces lie where the bodies are made, and what bonds there if the
   *  law has strength in tension. */
  struct FacesAtStart
  {
    double       facets  = 0; ///< gaps that facets account for, at most [mm]
    double       plane   = 0; ///< the same, of plane facets [mm]
    double       overlap = 0; ///< beyond that, at most [mm]
    double       facing_area = 0; ///< of the implant, with the chuck [mm^2]
    unsigned int n_bonded    = 0; ///< points
    double bonded_area = 0, bonding_area = 0; ///< integral of phi_0; wanted
    double largest_gap = 0;                   ///< that is taken off [mm]
    double apart_area  = 0; ///< of gaps that are not, if they should [mm^2]
    double uneven      = 0; ///< range of gaps that are not [mm]

    /** What bonds, in a law that pulls, and gaps that are taken off; empty if
     *  there is neither. */
    std::string
    in_words(bool pulls) const;
  };

  /** How a point has moved in the step in which it opens. */
  struct OpeningMotion
  {
    Eigen::Vector3d normal;   ///< of the master at the old interacting point
    Eigen::Vector3d gap;      ///< to that point at the end [mm]
    Eigen::Vector3d by_chuck; ///< over the master, were the bodies rigid [mm]
  };



  /** The works of the interface up to the accepted state [N mm]. */
  struct InterfaceWork
  {
    /** Dissipated work, a trapezoid in the traction; with what is lost where
     *  points open. */
    double dissipation = 0;
    /** By how much trapezoids would have taken that to be another amount; a
     *  bound of the sum over all steps. */
    double dissipation_bound = 0;
    /** Slip of the last step times the tractions at its end. A trapezoid may be
     *  negative where the slip reverses; this is so only where points slide
     *  along their traction. */
    double step_dissipation = 0;
    /** The part of the dissipation that breaks the bond (D_adh, integral of (mu
     *  - mu_b) p dg_s): the mean pressure times the exact integral over the
     *  sliding distance. */
    double adhesive = 0;
    /** The part of the dissipation that the viscosity makes up. */
    double viscous = 0;
    /** The part of it that opening makes up. */
    double damage = 0;
    /** The part of `adhesive' that tractions across the interface have spent.
     */
    double adhesive_normal = 0;
    /** Work of friction with the integral of the law over the sliding distance
     *  instead of a trapezoid, and of viscosity: a step that jumps dissipates
     *  no more than that. */
    double friction = 0;
    /** How far the work of friction and the stored energy may be wrong because
     *  the pressure or the speed changes while a point slides, and where points
     *  open; a bound of the sum over all steps. */
    double friction_bound = 0;
    /** The parts of both that crushed and sheared bone make up. */
    double crushed = 0, sheared = 0;

    /** Adds the work of @p point from its accepted state to its trial state;
     *  @p mode: of the step; @p frame: Q of the master. */
    void
    add(const SlavePoint       &point,
        const InterfaceLaw     &law,
        const ContactPointMode &mode,
        const Eigen::Matrix3d  &frame);
    /** What the bone beside it takes, which has slid there by @p slid [mm]. */
    void
    add_bone(const SlavePoint       &point,
             const InterfaceLaw     &law,
             const PointStart       &start,
             const ContactPointMode &mode,
             double                  slid);
    /** The work of damage of a share that is held. */
    void
    add(const CohesiveShare    &share,
        const SlavePoint       &point,
        const InterfaceLaw     &law,
        const ContactPointMode &mode,
        const Eigen::Matrix3d  &frame);
    /** The same of a point that opens. */
    void
    add_opening(const SlavePoint       &point,
                const ContactPointLaw  &law,
                const ContactPointMode &mode,
                const Eigen::Matrix3d  &frame,
                const OpeningMotion    &motion);

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &dissipation &dissipation_bound &adhesive &viscous &friction
        &friction_bound &step_dissipation &damage &adhesive_normal &crushed
          &sheared;
    }
  };



  class BulkSpace;

  /**
   * The interface: the slave quadrature points, their history, the forces they
   * exert on the control points of both surfaces, and the tangent.
   *
   * A step goes as follows. Newton's method proposes an InterfaceConfiguration:
   * where both surfaces are. evaluate() computes a *trial* result of every
   * point from the accepted history and never changes that history; force() has
   * the sums of Eq. (36), add_tangent() or apply_tangent() their derivatives.
   * When the step has converged, and only then, commit() makes the trial states
   * the accepted ones, so that a rejected step leaves no trace.
   */
  class ContactInterface
  {
  public:
    ContactInterface(const InterfaceParameters &parameters,
                     const BulkSpace           &bone,
                     const BulkSpace           &implant);

    Side
    slave_side() const
    {
      return slave;
    }

    /** Faces every point with its closest point on the master. */
    void
    initialise(const InterfaceConfiguration &configuration);
    /** After that, the places where they interact are those of a press fit. */
    void
    begin_thicker(const InterfaceConfiguration &configuration);

    /** Updates all points. Returns false if a point found no solution. */
    bool
    evaluate(const InterfaceConfiguration &configuration,
             ContactPointMode              mode);

    /** The mode of the last evaluate(). */
    const ContactPointMode &
    mode() const
    {
      return mode_now;
    }
    /** Whether friction depends on the duration of a step. */
    bool
    depends_on_rate() const
    {
      return is_viscous() || law.joint->depends_on_rate();
    }
    bool
    is_viscous() const
    {
      return law.is_viscous();
    }
    /** Completes the derivatives of the last evaluate() by those with the
     *  components of the chuck that are unknowns of @p configuration, where it
     *  has others than that evaluate() had. */
    void
    differentiate_turns(const InterfaceConfiguration &configuration);

    /** By how much nodal forces would differ from those of the last evaluate(),
     *  in this @p configuration, if the points went there by way of @p middle,
     *  in two steps of half the duration, and had come there by such steps for
     *  as long as their gaps remember [N]. */
    NodalSums
    difference_of_halves(const InterfaceConfiguration &middle,
                         const InterfaceConfiguration &configuration) const;

    /** Nodal forces on the implant in the accepted state [N] of points that
     *  have left the master over its edge in the last evaluate(). */
    ControlNet
    let_go(const InterfaceConfiguration &configuration) const;

    /** Nodal forces of the last evaluate() on the control points of a side, in
     *  space, as they enter the residual [N]; and on the points of its frame,
     *  which make up a moment. */
    const ControlNet &
    force(const Side side) const
    {
      return forces[side];
    }

    /** Adds the tangent of the last evaluate() to a dense matrix: rows are
     *  equations of control points in their bodies' frames and of chuck
     *  components, d(force)/d(unknowns), without the terms that come from the
     *  rotation of frames and lever arms (see CoupledTangent). */
    void
    add_tangent(const InterfaceConfiguration &configuration,
                Eigen::MatrixXd              &matrix) const;
    /** Adds the product of that tangent with a vector of unknowns. */
    void
    apply_tangent(const InterfaceConfiguration &configuration,
                  const Eigen::VectorXd        &direction,
                  Eigen::VectorXd              &result) const;
    /** Accepts the last evaluate(): history, and the works it sums up. Open
     *  points are projected anew in the accepted configuration. */
    void
    commit(const InterfaceConfiguration &configuration);

    /** Control points of a side in the accepted configuration [mm]. */
    const ControlNet &
    accepted_surface(const Side side) const
    {
      return accepted_positions[side];
    }

    /** Number of open points whose projection on the master in the accepted
     *  configuration was not found: they stay open. */
    unsigned int
    n_unprojected() const
    {
      return unprojected;
    }

    /** Of all points in the last evaluate(). */
    std::vector<PointStatus>
    statuses() const;

    /** Whether points that have left the master over its edge, since this was
     *  asked or since commit(), were back on it in the last evaluate(). */
    bool
    has_come_back();
    /** Whether any point of the last evaluate() is open. */
    bool
    has_open_points() const;

    /** Smallest gap of the points that face the master [mm]; infinite: there
     *  are none. */
    double
    smallest_gap() const;

    /** Whether it has left nothing of a bond with strength in tension, and
     *  presses nowhere. */
    bool
    is_detached() const;

    /** How many points were left open between closed ones of their row and of
     *  their column of the surface in the accepted state. */
    unsigned int
    n_enclosed() const;

    /** Points of the slave surface, numbered as surface_quadrature() does, with
     *  their trial states. */
    const std::vector<SlavePoint> &
    get_points() const
    {
      return points;
    }
    /** Along each parameter of a slave surface element. */
    const dealii::Quadrature<1> &
    points_per_element() const
    {
      return along;
    }
    /** Slip and elastic gap of a point since the last mark_motion(), in the
     *  master's frame [mm]. */
    Eigen::Vector3d
    motion_since_mark(const SlavePoint &point) const
    {
      return point.slipped + point.accepted_traction / law.tangential_penalty -
             point.marked;
    }
    /** That of all points, without its times. */
    RelativeMotion
    relative_motion() const;
    void
    mark_motion();
    /** The traction of a point in its trial state, with that of the share that
     *  is held [MPa]. */
    PointTraction
    traction(const SlavePoint &point) const;
    /** Load of a point in the accepted state, with the moment about @p centre:
     *  the sums are those of the chuck. */
    PointLoad
    load(unsigned int q, const Eigen::Vector3d &centre) const;
    /** What the point does, the share that is held included, in its trial
     *  state. */
    PointStatus
    status(const SlavePoint &point) const;
    /** phi and mu of a point in its trial state. */
    FrictionCoefficient
    friction(const SlavePoint &point) const
    {
      return point.friction(*law.joint, point.trial.state);
    }
    /** phi_0 over the implant's contact face; known from initialise() on. */
    const BondingPattern &
    bonding() const
    {
      return *pattern;
    }
    const BodyParameters &
    implant() const;
    const InterfaceLaw &
    get_law() const
    {
      return *law.joint;
    }

    /** Of the last evaluate(). */
    PathLength
    path_length(const InterfaceConfiguration &configuration) const;
    /** How much the measure can still grow [mm]: that of damage ends. */
    double
    path_left() const;

    /** Sums over all points of the last evaluate(). */
    InterfaceSummary
    summarise() const;

    const FacesAtStart &
    faces_at_start() const
    {
      return at_start;
    }

    /** Area of the faces of an implant from a file that lie on the bone, up to
     *  facets, but are not in contact [mm^2]. */
    double
    area_left_out() const;

    /** Reference area of the implant's contact face by quadrature weights
     * [mm^2]. */
    double
    implant_area() const
    {
      return area_of_implant;
    }

    /** The works up to the accepted state. */
    const InterfaceWork &
    work() const
    {
      return works;
    }

    /** Where the last evaluate() failed, for messages; empty if it did not. */
    std::string
    describe_failure() const;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      tangent_is_gathered = false;
      for (SlavePoint &point : points)
        archive &point;
      for (CohesiveShare &share : shares)
        archive &share;
      if (Archive::is_loading::value)
        follow_pattern();
      archive &forces &accepted_positions;
      archive &accepted_place.frame &accepted_place.centre;
      archive &works                &unprojected;
      if constexpr (is_in_memory<Archive>)
        archive &mode_now;
      if (Archive::is_loading::value)
        failed = nullptr; // no state that has been accepted did
    }

  private:
    Side
    master_side() const
    {
      return other(slave);
    }
    MasterSurface
    master(const InterfaceConfiguration &configuration) const;
    OpeningMotion
    opening_motion(const SlavePoint             &point,
                   const InterfaceConfiguration &configuration,
                   const RigidMotion            &chuck,
                   const ControlNet             &before) const;
    void
    find_side(InterfaceSummary &summary) const;
    /** Puts a point in if its law may fall steeper than those before; @p
     *  resistance against that [MPa/mm]. */
    void
    find_steepest(const SlavePoint &point,
                  double            resistance,
                  InterfaceSummary &summary) const;
    /** The share of a point that is held; null: none is. */
    const CohesiveShare *
    held_share(const SlavePoint &point) const;
    /** In the last step. */
    bool
    has_opened_beyond_strength(const SlavePoint &point) const;
    void
    assign_bonding();
    /** Takes off gaps at the start of faces of several elements, which need not
     *  fit. */
    void
    find_facets();
    Projection
    project_at_rest(const MasterSurface   &master,
                    const SlavePoint      &point,
                    const Eigen::Vector2d *guess) const;
    /** Gives points of the bone the phi_0 of the implant that they face. */
    void
    follow_pattern();
    bool
    is_back_at_edge(const SlavePoint &point) const;
    void
    take_off(SlavePoint &point, const Eigen::Vector3d &G);
    Eigen::Vector3d
    normal_of_slave(const SlavePoint &point, const ControlNet &positions) const;
    Projection
    facing(const SlavePoint             &point,
           const InterfaceConfiguration &configuration,
           const Eigen::Vector2d        *guess) const;
    Projection
    project_accepted(SlavePoint                   &point,
                     const InterfaceConfiguration &configuration,
                     bool                          use_guess);
    /** The state that a point without a partner begins this step with: on the
     *  edge that it comes over, or without a partner if it does not. */
    ContactPointState
    entry(const SlavePoint             &point,
          const InterfaceConfiguration &configuration) const;
    /** Adds that of a @p traction [MPa] on a point, and the opposite one on the
     *  master. */
    void
    add_force(const SlavePoint      &point,
              const Eigen::Vector3d &traction,
              const SurfaceBasis    &of_master,
              NodalSums             &sums) const;
    void
    hold(unsigned int                  q,
         const InterfaceConfiguration &configuration,
         const ContactPointMode       &mode,
         NodalSums                    &sums);
    void
    accept_shares(const InterfaceConfiguration &configuration);
    /** Work of the tractions on both faces of a point as a couple, from the
     *  positions @p before and the master's frame @p old_Q [N/mm]. */
    double
    couple_work(const SlavePoint      &point,
                const NodalSums       &before,
                const Eigen::Matrix3d &old_Q) const;

    /** Bound of how far points of the two surfaces have moved towards each
     *  other since the accepted configuration [mm]. */
    double
    motion(const InterfaceConfiguration &configuration) const;

    /** Unless it is gathered already. */
    void
    gather_tangent() const;
    void
    add_products_of_shares(unsigned int      chunk,
                           const PaddedNets &moved,
                           PaddedNets       &sums) const;

    const InterfaceParameters        parameters;
    const ContactPointLaw            law;
    const Side                       slave;
    const double                     touch_tolerance; ///< of every mode [mm]
    std::array<const BulkSpace *, 2> mesh;
    const bool                       master_is_level, master_is_flat;
    const dealii::Quadrature<1>      along; ///< an element
    std::vector<SlavePoint>          points;
    /** Of each point, by laws that hold one; else empty. */
    std::vector<CohesiveShare>            shares;
    double                                area_of_implant = 0;
    FacesAtStart                          at_start;
    std::unique_ptr<const BondingPattern> pattern;
    NodalSums                             forces, accepted_positions;
    Place                                 accepted_place; ///< of the implant
    InterfaceWork                         works;
    unsigned int                          unprojected = 0;
    const SlavePoint                     *failed      = nullptr;
    ContactPointMode                      mode_now; ///< of the last evaluate()
    /** Of the closed points, gathered for the first of several products. */
    mutable std::array<std::vector<PointTangent>, n_chunks> tangent;
    mutable bool tangent_is_gathered = false;
  };
} // namespace Debond
