#ifndef debond_contact_interface_h
#define debond_contact_interface_h

#include <debond/bonding_pattern.h>
#include <debond/contact_point.h>
#include <debond/interface_parameters.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  class BodyMesh;
  class Chuck;

  /** The two contact surfaces in space and how their control points are
   *  numbered in the coupled system. Index 0 is the bone, 1 the implant. */
  struct InterfaceConfiguration
  {
    struct Side
    {
      ControlNet positions; ///< spatial positions of the control points [mm]
      Eigen::Matrix3d frame = Eigen::Matrix3d::Identity(); ///< Q of the body
      /** For 3 (control point) + component (body frame): number in the coupled
       *  system, -1: none. */
      std::vector<int> unknown_of;
    };
    std::array<Side, 2> side;
    /** Numbers of the chuck components that are unknowns. */
    std::vector<std::pair<unsigned int, unsigned int>> chuck_unknowns;
    const Chuck                                       *chuck = nullptr;
  };

  /**
   * The interface: the slave quadrature points, their history, the forces they
   * exert on the control points of both surfaces, and the tangent.
   *
   * evaluate() computes a *trial* result of every point from the accepted
   * history and never changes that history; commit() is the only way to accept
   * it. A rejected step therefore leaves no trace.
   */
  class ContactInterface
  {
  public:
    ContactInterface(const InterfaceParameters &parameters,
                     const BodyMesh            &bone,
                     const BodyMesh            &implant);

    unsigned int
    n_points() const
    {
      return points.size();
    }
    unsigned int
    slave_side() const
    {
      return slave;
    }
    unsigned int
    master_side() const
    {
      return 1 - slave;
    }

    /** Vectors at the control points of bone and implant. */
    using NodalSums = std::array<ControlNet, 2>;

    /** Faces every point with its closest point on the master. */
    void
    initialise(const InterfaceConfiguration &configuration);

    /** Updates all points. Returns false if a point found no solution. */
    bool
    evaluate(const InterfaceConfiguration &configuration,
             const ContactPointMode       &mode);

    /** Nodal forces of the last evaluate() on the control points of a side, in
     *  space, as they enter the residual [N]. */
    const ControlNet &
    force(const unsigned int side) const
    {
      return forces[side];
    }

    /** Adds the tangent of the last evaluate() to a dense matrix: rows are
     *  equations of control points in their bodies' frames and of chuck
     *  components, d(force)/d(unknowns), without the terms that come from the
     *  rotation of frames and lever arms (see CoupledSystem). */
    void
    add_tangent(const InterfaceConfiguration &configuration,
                Eigen::MatrixXd              &matrix) const;
    /** The product of that tangent with a vector of unknowns, added to @p
     * result. */
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
    accepted_surface(const unsigned int side) const
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

    /** Whether any point of the last evaluate() is open. */
    bool
    has_open_points() const;
    /** Elements of the bone's surface that closed points of the last
     *  evaluate() lie on. */
    std::vector<bool>
    touched_bone_elements() const;
    /** Elements of the bone's surface under the implant's contact face, its
     *  edge included, in this configuration. */
    std::vector<bool>
    bone_elements_under_implant(
      const InterfaceConfiguration &configuration) const;

    struct Point
    {
      unsigned int      element = 0;
      Eigen::Vector2d   xi; ///< on the slave
      Eigen::Vector3d   X;  ///< reference position [mm]
      SurfaceBasis      basis;
      double            JxW   = 0; ///< reference area [mm^2]
      double            phi_0 = 0;
      ContactPointState accepted;
      /** For points beyond the master's edge: how far the surfaces may still
       *  move before such a point has to be projected again [mm]. */
      double clearance = 0;
      /** Tangential traction of the accepted state in the master's frame [MPa].
       */
      Eigen::Vector3d    accepted_traction         = Eigen::Vector3d::Zero();
      Eigen::Vector3d    accepted_viscous_traction = Eigen::Vector3d::Zero();
      double             accepted_pressure         = 0; ///< [MPa]
      ContactPointResult trial;
      /** False for points of a bone that does not face the implant at the
       *  start: their area does not count. */
      bool faces_implant = true;

      /** See serialization.h. */
      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &accepted &clearance       &accepted_traction;
        archive &accepted_viscous_traction &accepted_pressure;
        if (Archive::is_loading::value)
          trial.state = accepted;
      }
    };
    const std::vector<Point> &
    get_points() const
    {
      return points;
    }
    /** phi and mu of a point in its trial state. */
    FrictionCoefficient
    friction(const Point &point) const;
    /** The mean of phi_0 over the slave's quadrature points that face the
     *  implant at the start: that of the pattern if the implant is the slave.
     */
    double
    mean_seen_bonding() const;
    /** phi_0 over the implant's contact face; known from initialise() on. */
    const BondingPattern &
    bonding() const
    {
      return *pattern;
    }
    const InterfaceParameters &
    get_parameters() const
    {
      return parameters;
    }

    /** Area mean of the sliding distance g_s over the contact face in the last
     *  evaluate() [mm], and its derivatives with respect to the positions of
     *  the control points of both surfaces, in space. */
    struct MeanSlip
    {
      double    value = 0;
      NodalSums gradient;
    };
    MeanSlip
    mean_slip(const InterfaceConfiguration &configuration) const;

    /** Sums over all points of the last evaluate(). */
    struct Summary
    {
      double normal_force = 0; ///< int p dA [N]
      double phi_mean     = 0; ///< area mean over the implant's contact face
      double share_stick = 0, share_slip = 0, share_open = 0; ///< of that area
      double energy = 0;                                      ///< stored [N mm]
      /** Largest |d mu/d g_s| p / (eps_t + eta / dt). */
      double max_softening = 0;
      /** The same where the law of a point falls steepest from the g_s on that
       *  the step began with: the local solution is unique while this is below
       *  1. Zero for the explicit law, which does not ask. */
      double steepest_softening = 0;
      /** p, and |d mu/d g_s| of that point [MPa, 1/mm]. */
      double       softening_pressure = 0, softening_slope = 0;
      double       max_penetration = 0; ///< [mm]
      unsigned int bonded_opened =
        0; ///< points with phi > 0 that opened in this step
      unsigned int n_closed = 0;
    };
    Summary
    summarise() const;
    /** Reference area of the implant's contact face by quadrature weights
     * [mm^2]. */
    double
    implant_area() const
    {
      return area_of_implant;
    }

    /** Dissipated work and the part of it that the law spends on adhesion
     *  (D_adh, integral of (mu - mu_b) p dg_s) up to the accepted state [N mm]:
     *  a trapezoid in the traction, and the mean pressure times the exact
     *  integral over the sliding distance. */
    double
    dissipation() const
    {
      return accepted_dissipation;
    }

    /** Slip of the step to the accepted state times the tractions at its end
     *  [N mm]. A trapezoid may be negative where the slip reverses; this is so
     *  only where points slide along their traction. */
    double
    step_dissipation() const
    {
      return accepted_step_dissipation;
    }
    double
    adhesive_work() const
    {
      return accepted_adhesive_work;
    }
    /** The part of the dissipation that the viscosity makes up [N mm]. */
    double
    viscous_work() const
    {
      return accepted_viscous_work;
    }

    /** Work of friction up to the accepted state with the integral of the law
     *  over the sliding distance instead of a trapezoid, and of viscosity
     *  [N mm]: a step that jumps spends no more than that. */
    double
    friction_work() const
    {
      return accepted_friction_work;
    }
    /** How far friction_work() and the stored energy may be wrong because the
     *  pressure or the speed changes while a point slides, and because points
     *  that open slide before they do; a bound of the sum over all steps [N
     * mm]. */
    double
    friction_work_bound() const
    {
      return accepted_friction_work_bound;
    }

    /** Where the last evaluate() failed, for messages; empty if it did not. */
    std::string
    describe_failure() const;

    /** See serialization.h.. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      for (Point &point : points)
        archive &point;
      archive &forces                &accepted_positions;
      archive &accepted_dissipation  &accepted_adhesive_work;
      archive &accepted_viscous_work &accepted_friction_work;
      archive                        &accepted_friction_work_bound;
    }

  private:
    void
    make_points();
    void
    assign_bonding();
    FrictionCoefficient
    friction(const Point &point, const ContactPointState &state) const;
    void
    update(Point                        &point,
           const InterfaceConfiguration &configuration,
           const MasterSurface          &surface,
           double                        moved,
           const ContactPointMode       &mode) const;
    void
    add_steepest_softening(const Point &point, Summary &summary) const;
    void
    add_forces(const Point &point, NodalSums &sums) const;
    void
    add_friction_work(const Point &point, double viscous);
    void
    add_change(const Point     &point,
               const NodalSums &moved,
               NodalSums       &sums) const;
    void
    project_accepted(Point                        &point,
                     const MasterSurface          &master,
                     const InterfaceConfiguration &configuration,
                     bool                          use_guess);
    /** Bound of how far points of the two surfaces have moved towards each
     *  other since the accepted configuration [mm]. */
    double
    motion(const InterfaceConfiguration &configuration) const;
    MasterSurface
    master(const InterfaceConfiguration &configuration) const;

    const InterfaceParameters             parameters;
    const unsigned int                    slave; ///< 0: bone, 1: implant
    std::array<const BodyMesh *, 2>       mesh;
    ContactPointLaw                       law;
    std::vector<Point>                    points;
    double                                area_of_implant = 0;
    std::unique_ptr<const BondingPattern> pattern;
    NodalSums                             forces, accepted_positions;
    double accepted_dissipation = 0, accepted_step_dissipation = 0,
           accepted_adhesive_work = 0, accepted_viscous_work = 0;
    double       accepted_friction_work = 0, accepted_friction_work_bound = 0;
    unsigned int unprojected  = 0;
    int          failed_point = -1;
    ContactPointMode mode_now; ///< of the last evaluate()
  };
} // namespace Debond
#endif
