#ifndef debond_interface_interface_sensitivity_h
#define debond_interface_interface_sensitivity_h

#include <debond/interface/contact_interface.h>
#include <debond/interface/local_motion.h>
#include <debond/interface/rigid_motion.h>

#include <vector>

namespace Debond
{
  /** How an interface changes with a parameter p: it at p + h and at p - h. */
  struct InterfaceVariation
  {
    InterfaceParameters plus, minus;
    double              width; ///< 2 h
  };

  /** How both surfaces [mm] and the implant as a whole move with n_lanes
   *  parameters, per their units. */
  struct InterfaceMotion
  {
    LaneSums surfaces;
    Lanes<3> shift = Lanes<3>::Zero(); ///< of the chuck's centre [mm]
    Lanes<3> spin  = Lanes<3>::Zero(); ///< of its frame, in space [rad]

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &surfaces &shift &spin;
    }
  };

  /**
   * The derivatives of an interface by parameters, in the course of steps: of
   * what a step begins with, the history of the points and where bodies and
   * chuck were, and with it of the nodal forces at the end of the step.
   *
   * The law of a point is differentiated as its tangent is, by the implicit
   * function theorem in the state of the last evaluate(). What coefficients,
   * pressures and stiffnesses change with the parameter at a given state is the
   * difference of the two variations.
   */
  class InterfaceSensitivity
  {
  public:
    /** After initialise() of the @p interface, which must outlive this object,
     *  and before its first commit(). @p start: how it was placed. A motion is
     *  that of the first n_lanes parameters, of the next, ... */
    InterfaceSensitivity(const ContactInterface                &interface,
                         const std::vector<InterfaceVariation> &variations,
                         std::vector<InterfaceMotion>           start);

    /** Changes of the nodal forces of the last evaluate() with each parameter
     *  [N per unit of the parameter], by the history, the law and @p given
     *  motions. */
    std::vector<LaneSums>
    forces(const InterfaceConfiguration &configuration,
           std::vector<InterfaceMotion>  given);

    /** The changes of these forces if the unknowns follow by @p response as
     *  well, and of the chuck's components by @p chuck; makes the derivatives
     *  of this state those that the next step begins with. To be called after
     *  forces() and before commit(). */
    std::vector<LaneSums>
    advance(const InterfaceConfiguration       &configuration,
            const std::vector<InterfaceMotion> &response,
            const std::vector<Lanes<6>>        &chuck);

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &accepted &histories;
    }

  private:
    /** Columns of the derivative of what a step keeps of a point: xi_hat, gap,
     *  pressure and g_s of its state. */
    enum
    {
      at_xi       = 0,
      at_gap      = 2,
      at_pressure = 4,
      at_slip     = 5,
      n_history   = 6
    };
    using History = Lanes<n_history>;

    /** A parameter's interface at p + h and p - h. */
    struct Parameter
    {
      std::array<ContactPointLaw, 2>     law;
      std::array<std::vector<double>, 2> phi_0;
      double                             width;
      bool                               changes_friction;
    };

    /** A closed point, with the unknowns at rest. */
    struct Change
    {
      Lanes<ContactPointResult::n_w> dw;
      Lanes<PointData::n_columns>    data;
      Lanes<3>                       traction;
      Lanes<2>                       xi;
      Lanes<1>                       slip;
    };
    struct Step;
    struct PointStep;
    struct PointStart;
    struct Block;

    void
    set_data(const PointStart &at,
             unsigned int      q,
             unsigned int      first_parameter,
             const History    &start,
             Change           &change) const;
    Change
    change_at_rest(const PointStart &at,
                   unsigned int      q,
                   const Block      &block) const;
    History
    history(const PointStep &at, const Change &change) const;
    template <typename Work>
    std::vector<LaneSums>
    sum_over_closed_points(const InterfaceConfiguration &configuration,
                           const Work                   &work) const;

    const ContactInterface      &interface;
    std::vector<Parameter>       parameters;
    std::vector<InterfaceMotion> accepted;
    /** Of the first n_lanes parameters at all points, of the next, ... */
    std::vector<std::vector<History>> histories;

    // from forces() to advance()
    std::vector<InterfaceMotion>     given;
    std::vector<std::vector<Change>> changes;
  };
} // namespace Debond
#endif
