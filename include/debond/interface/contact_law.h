#ifndef debond_interface_contact_law_h
#define debond_interface_contact_law_h

#include <debond/interface/friction_law.h>

#include <memory>

namespace Debond
{
  /** What an interface does to a normal gap g_n. */
  struct NormalResponse
  {
    double pressure  = 0; ///< p [MPa]; negative where it pulls
    double stiffness = 0; ///< -dp/dg_n [MPa/mm]
    double energy    = 0; ///< stored per area [N/mm]
  };

  /**
   * The law across the interface: pressure over the gap. An object does not
   * change; what a point remembers is in its history.
   */
  class NormalLaw
  {
  public:
    virtual ~NormalLaw() = default;

    /** At the gap @p g_n [mm] of a point with this @p history. Points that are
     *  closed ask for gaps below reach(); the response goes on smoothly for
     *  larger ones, where Newton's method may look and where touching points
     *  have their tangent. */
    virtual NormalResponse
    respond(double g_n, const PointHistory &history) const = 0;

    /** The gap from which on nothing is carried [mm]: 0 unless the law has
     *  strength in tension. Points open there. */
    virtual double
    reach(const PointHistory &) const
    {
      return 0.;
    }

    /** What a point remembers of being opened. */
    virtual void
    open(PointHistory &) const
    {}

    /** Stiffness of a point that has just closed [MPa/mm]: scales forces, and
     *  is the spring that closed forms set the bodies in series with. */
    virtual double
    initial_stiffness() const = 0;
  };

  /** p = -eps_n g_n, with eps_n = @p stiffness > 0 [MPa/mm].
   *  @p opening_breaks_bond: the entry of this name. */
  std::shared_ptr<const NormalLaw>
  penalty_law(double stiffness, bool opening_breaks_bond = false);

  /** Where a point slides in a step. */
  enum class SlipDirection
  {
    integrated,  ///< along its way, see TowedGap
    trial,       ///< along the gap that it would have without sliding
    previous_gap ///< along that of the step before, Eq. (31) as printed
  };

  /** `Friction update = explicit': the same law with mu at g_s^n, whatever the
   *  distance. See compared_methods.cc. */
  FrictionLawPointer
  explicit_update(FrictionLawPointer law);

  /** What governs all points of an interface. */
  struct ContactPointLaw
  {
    std::shared_ptr<const NormalLaw> normal             = penalty_law(585);
    double                           tangential_penalty = 585; ///< eps_t
                                                               ///< [MPa/mm]
    FrictionLawPointer friction = default_friction_law();
    /** eta [MPa per (mm per unit of time)]: resistance of a point to the speed
     *  it slides with. */
    double        viscosity      = 0;
    SlipDirection slip_direction = SlipDirection::integrated;
  };
} // namespace Debond
#endif
