#ifndef debond_interface_contact_law_h
#define debond_interface_contact_law_h

#include <debond/interface/friction_law.h>
#include <debond/interface/normal_law.h>

namespace Debond
{
  /** What governs all points of an interface. */
  struct ContactPointLaw
  {
    std::shared_ptr<const NormalLaw> normal             = penalty_law(585);
    double                           tangential_penalty = 585; ///< eps_t
                                                               ///< [MPa/mm]
    FrictionLawPointer friction = default_friction_law();
    /** eta [MPa per (mm per unit of time)]: resistance of a point to the speed
     *  it slides with. */
    double viscosity = 0;
    /** mu at g_s^n instead of g_s: a variant that the implicit law is compared
     *  with. */
    bool explicit_friction = false;
  };
} // namespace Debond
#endif
