#ifndef debond_interface_interface_sensitivity_h
#define debond_interface_interface_sensitivity_h

#include <debond/interface/contact_interface.h>
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

  /** How both surfaces [mm] and the chuck move with a parameter, per its unit.
   */
  struct InterfaceMotion
  {
    NodalSums   surfaces;
    PlaceChange implant;

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &surfaces &implant.shift &implant.spin;
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
     *  and before its first commit(). @p start: how it was placed. */
    InterfaceSensitivity(const ContactInterface                &interface,
                         const std::vector<InterfaceVariation> &variations,
                         std::vector<InterfaceMotion>           start);

    /** Changes of the nodal forces of the last evaluate() with each parameter
     *  [N per unit of the parameter], if all else moves by @p motions. */
    std::vector<NodalSums>
    forces(const InterfaceConfiguration       &configuration,
           const std::vector<InterfaceMotion> &motions) const;

    /** The same, and makes the derivatives of the trial state those that the
     *  next step begins with. To be called before commit(). */
    std::vector<NodalSums>
    advance(const InterfaceConfiguration &configuration,
            std::vector<InterfaceMotion>  motions);

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &accepted &histories;
    }

  private:
    /** Derivative of what a step keeps of a point. */
    struct History
    {
      Eigen::Vector2d xi = Eigen::Vector2d::Zero(), gap = xi; ///< as the state
      double          pressure = 0, slip = 0;

      /** See serialization.h. */
      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &xi &gap &pressure &slip;
      }
    };

    /** A parameter's interface at p + h and p - h. */
    struct Parameter
    {
      std::array<ContactPointLaw, 2>     law;
      std::array<std::vector<double>, 2> phi_0;
      double                             width;
      bool                               changes_friction;
    };

    struct Step;
    struct PointStep;
    struct PointChange;

    std::vector<NodalSums>
    sum_changes(const InterfaceConfiguration       &configuration,
                const std::vector<InterfaceMotion> &motions,
                std::vector<History>               *advanced) const;

    const ContactInterface      &interface;
    std::vector<Parameter>       parameters;
    std::vector<InterfaceMotion> accepted;
    /** Of all parameters at the first point, at the second, ... */
    std::vector<History> histories;
  };
} // namespace Debond
#endif
