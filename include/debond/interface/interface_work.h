#ifndef debond_interface_interface_work_h
#define debond_interface_interface_work_h

#include <debond/interface/slave_point.h>

namespace Debond
{
  /** What the points of the interface have spent up to the accepted state
   *  [N mm]. */
  struct InterfaceWork
  {
    /** Dissipated work, a trapezoid in the traction. */
    double dissipation = 0;
    /** Slip of the last step times the tractions at its end. A trapezoid may be
     *  negative where the slip reverses; this is so only where points slide
     *  along their traction. */
    double step_dissipation = 0;
    /** The part of the dissipation that the law spends on adhesion (D_adh,
     *  integral of (mu - mu_b) p dg_s): the mean pressure times the exact
     *  integral over the sliding distance. */
    double adhesive = 0;
    /** The part of the dissipation that the viscosity makes up. */
    double viscous = 0;
    /** Work of friction with the integral of the law over the sliding distance
     *  instead of a trapezoid, and of viscosity: a step that jumps spends no
     *  more than that. */
    double friction = 0;
    /** How far the work of friction and the stored energy may be wrong because
     *  the pressure or the speed changes while a point slides, and because
     *  points that open slide before they do; a bound of the sum over all
     *  steps. */
    double friction_bound = 0;

    /** To be called before the points of a step are added. */
    void
    begin_step();
    /** Adds what @p point spends from its accepted state to its trial state;
     *  @p mode: of the step; @p frame: Q of the master. */
    void
    add(const SlavePoint       &point,
        const FrictionLaw      &law,
        const ContactPointMode &mode,
        const Eigen::Matrix3d  &frame);

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &dissipation &adhesive &viscous &friction &friction_bound;
    }

  private:
    void
    add_friction(const SlavePoint       &point,
                 const FrictionLaw      &law,
                 const ContactPointMode &mode);
  };
} // namespace Debond
#endif
