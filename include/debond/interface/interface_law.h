#ifndef debond_interface_interface_law_h
#define debond_interface_interface_law_h

#include <debond/interface/friction_law.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Debond
{
  /** A point at the beginning of a step, as a law of the interface sees it. */
  struct PointStart
  {
    PointHistory history;
    double       phi_0    = 1; ///< initial bonding
    double       duration = 0; ///< of the step [unit of time], 0: none passes
    /** For now: nothing rubs, and slip does not count. */
    bool frictionless = false;
    /** Of the share that is held, at the end of the step. */
    double damage = 0;
    /** phi and mu with nothing slid in the step, where that is asked for more
     *  than once: see InterfaceLaw::ask_at_rest(). */
    std::optional<FrictionCoefficient> at_rest = std::nullopt;

    /** What the friction law is to know. */
    FrictionState
    friction() const
    {
      return {history.bond_left(phi_0),
              history.slip,
              history.internal,
              duration};
    }
  };



  /** What an interface carries at the end of a step, by the gap g_n across it
   *  and the distance d that the point has slid in the step. */
  struct InterfaceResponse
  {
    double pressure         = 0; ///< p [MPa]; negative where it pulls
    double pressure_by_gap  = 0; ///< dp/dg_n [MPa/mm]
    double pressure_by_slip = 0; ///< dp/dd [MPa/mm]
    double limit            = 0; ///< L >= 0 of the tangential traction [MPa]
    double limit_by_gap     = 0; ///< dL/dg_n [MPa/mm]
    double limit_by_slip    = 0; ///< dL/dd [MPa/mm]
    double limit_by_damage  = 0; ///< of the share that is held [MPa]
    double energy           = 0; ///< stored across the interface [N/mm]
    double viscous_pressure = 0; ///< the part of p that speed makes up [MPa]
    /** Whether the viscosity resists sliding, beside L. */
    bool resists = false;
  };



  /** What a full bond does in tension; 0 of laws without strength there. */
  struct Tension
  {
    double strength  = 0; ///< [MPa]
    double work      = 0; ///< of adhesion, to the end [N/mm]
    double stiffness = 0; ///< as it begins to open [MPa/mm]
    double softening = 0; ///< the steepest fall as it opens [MPa/mm]
    double gap       = 0; ///< at the strength [mm]
    /** Resistance to the speed it opens with [MPa per (mm per unit of time)].
     */
    double viscosity = 0;
  };



  /** Parts of a full bond: phi is phi_0 times both. */
  struct BondLeft
  {
    double by_opening = 1, by_slip = 1;
  };



  /** The share of a point's area that is bonded to a place of the master, at a
   *  gap to that place: the traction is the stiffness times the gap, without
   *  its normal part where that presses. */
  struct CohesiveResponse
  {
    double stiffness           = 0; ///< [MPa/mm]
    double stiffness_by_damage = 0; ///< [MPa/mm]
    double damage              = 0; ///< from 0 to 1, at the end of the step
    double damage_by_normal = 0, damage_by_tangential = 0; ///< [1/mm]
  };



  /** Works per area of a point in a step [N/mm]. */
  struct PointWork
  {
    double friction = 0; ///< what the law lets the slip dissipate
    /** How far that may be wrong, as pressure and speed change meanwhile. */
    double friction_bound = 0;
    double damage         = 0; ///< dissipated by opening
    double adhesive       = 0; ///< what the bond accounts for of both
    double lift = 0; ///< work of slip that is stored: it parts the faces
  };



  /** What a law of the interface is made of besides its own entries. */
  struct InterfaceLawParts
  {
    double             stiffness; ///< eps_n [MPa/mm]
    FrictionLawPointer friction;
    bool               opening_breaks_bond = false;
    /** `Friction update = explicit': mu is that at which the step begins,
     *  whatever the distance, so that a softening bond lags behind by a step.
     *  It has no slope and is never ambiguous. Works are still those of the
     *  law. See doc/evidence/stability.md. */
    bool explicit_friction = false;

    /** Whether friction depends on the duration of a step. */
    bool
    depends_on_rate() const
    {
      return !explicit_friction && friction->depends_on_rate();
    }
  };



  /**
   * The law of the interface: from what a point has gone through, the gap
   * across it and the distance that it slides to the pressure, the limit of the
   * tangential traction, energies, and a new history. Which points slide, and
   * where to, is the same for all laws (slip_problem.h).
   *
   * All laws push with a stiffness eps_n where the faces are pressed together,
   * and rub with a friction law. All functions are pure. How to add a law:
   * doc/developers/law.md.
   */
  class InterfaceLaw : public InterfaceLawParts
  {
  public:
    explicit InterfaceLaw(const InterfaceLawParts &parts)
      : InterfaceLawParts(parts)
    {}
    virtual ~InterfaceLaw() = default;

    /** @name A point in a step */
    //@{
    /** The point with its history @p history begins a step. */
    PointStart
    begin(const PointHistory &history,
          double              phi_0,
          double              duration     = 0.,
          bool                frictionless = false) const;

    /** Once for all places that respond() will be asked at. */
    void
    ask_at_rest(PointStart &start) const;

    /** At the end of the step, at the gap @p g_n [mm], after sliding by
     *  @p distance [mm]. Goes on smoothly beyond reach(), where Newton's method
     *  may look, and where touching points have their tangent. A point cannot
     *  slide backwards: at negative distances nothing rises. */
    virtual InterfaceResponse
    respond(const PointStart &start, double g_n, double distance) const = 0;

    /** The gap up to which the point is carried [mm]. */
    virtual double
    reach(const PointStart &, double /*distance*/) const
    {
      return 0.;
    }

    /** The history of a point that is carried at the end of the step. */
    virtual PointHistory
    advance(const PointStart &start, double g_n, double distance) const;

    /** The history of a point that opens. */
    virtual PointHistory
    open(const PointHistory &history) const;

    /** The works of a point that is carried. */
    virtual PointWork
    work(const PointStart &start, double g_n, double distance) const = 0;
    //@}

    /** Bound of -dL/dd [MPa/mm] >= 0 at the @p pressure [MPa], up to the @p
     *  distance and for what is still to come: what has been found is the first
     *  solution, and unique, while this is less than eps_t. */
    virtual double
    softening_by_slip(const PointStart &start,
                      double            pressure,
                      double            distance) const;

    /** @name Laws that hold a share of the area at the place where it bonded */
    //@{
    virtual bool
    is_cohesive() const
    {
      return false;
    }
    /** What that share does at the gap @p g_n across the interface and the
     *  distance @p delta_t along it [mm]. */
    virtual CohesiveResponse
    hold(const PointStart &, double /*g_n*/, double /*delta_t*/) const
    {
      return {};
    }
    /** The gap at which damage is 1, for the measure of a path [mm]. */
    virtual double
    length_of_damage() const
    {
      return 0.;
    }
    //@}

    /** phi and mu in an accepted state, for output. */
    virtual FrictionCoefficient
    reported(const PointHistory &history, double phi_0) const;

    /** What opening and what slip have each left of a full bond, for output. */
    BondLeft
    left_by_each(const PointHistory &history) const;

    /** @name What kind of law it is */
    //@{
    /** What a full bond does in tension. */
    virtual Tension
    tension() const
    {
      return {};
    }
    bool
    pulls() const
    {
      return tension().strength > 0.;
    }
    /** How far a point has been opened [mm], which never falls: with the
     *  sliding distance what a path of equilibrium is measured by. */
    virtual double
    opened(const PointHistory &) const
    {
      return 0.;
    }
    /** Distance over which the interface changes [mm]. */
    virtual double
    characteristic_distance() const
    {
      return friction->characteristic_distance();
    }
    //@}

  protected:
    /** phi, mu and its slope after sliding by @p distance, which is negative
     *  only at trial places. A point cannot slide against what pulls it. Where
     *  Newton's method looks there mu goes on along its tangent, but never
     *  rises: the distance alone would have a second solution there where
     *  friction rises with the speed, a rise one where it falls steeply. */
    FrictionCoefficient
    coefficient(const PointStart &start, const double distance) const
    {
      if (start.frictionless)
        return {};
      if (distance > 0. && !explicit_friction)
        return friction->coefficient(start.friction(), distance);
      FrictionCoefficient result =
        start.at_rest ? *start.at_rest :
                        friction->coefficient(start.friction(), 0.);
      if (explicit_friction)
        result.dmu = 0.;
      if (distance < 0.)
        {
          result.dmu = std::max(0., result.dmu);
          result.mu += result.dmu * distance;
        }
      return result;
    }
    /** The work of a point that rubs with mu p from the pressure @p p to
     *  @p p_end [MPa], none of which is less than 0. */
    PointWork
    work_of_friction(const PointStart &start,
                     double            p,
                     double            p_end,
                     double            distance) const;
  };

  using InterfaceLawPointer = std::shared_ptr<const InterfaceLaw>;



  using InterfaceLawPlugin =
    LawPlugin<InterfaceLawPointer (*)(const LawChoice &,
                                      const InterfaceLawParts &)>;

  class BondFriction;
  /** The bond of the friction law, for the law of the interface called @p law,
   *  which breaks it by opening as well. Throws EntryError. */
  std::shared_ptr<const BondFriction>
  bond_that_opens(const InterfaceLawParts &parts, const std::string &law);

  /** All laws, in the order of the choices. */
  const std::vector<InterfaceLawPlugin> &
  interface_law_plugins();

  /** Rows for `Law` and for the entries of all laws, in `Interface`; what they
   *  are set to goes to @p choice. */
  void
  declare_interface_laws(EntryTable &table, LawChoice &choice);

  /** The law that has been chosen. Throws EntryError. */
  InterfaceLawPointer
  create_interface_law(const LawChoice &choice, const InterfaceLawParts &parts);

  /** p = -eps_n g_n while that is positive, and L = mu p. */
  InterfaceLawPointer
  friction_under_pressure(const InterfaceLawParts &parts);

  /** Where a point slides in a step. */
  enum class SlipDirection
  {
    integrated,  ///< along its way, see TowedGap
    trial,       ///< along the gap that it would have without sliding
    previous_gap ///< along that of the step before, Eq. (31) as printed
  };

  /** What governs all points of an interface. */
  struct ContactPointLaw
  {
    InterfaceLawPointer joint =
      friction_under_pressure({585, default_friction_law()});
    double tangential_penalty = 585; ///< eps_t [MPa/mm]
    /** eta [MPa per (mm per unit of time)]: resistance of a point to the speed
     *  it slides with. */
    double        viscosity      = 0;
    SlipDirection slip_direction = SlipDirection::integrated;

    /** Whether a viscosity resists sliding or opening. */
    bool
    is_viscous() const
    {
      return viscosity > 0. || joint->tension().viscosity > 0.;
    }
  };
} // namespace Debond
#endif
