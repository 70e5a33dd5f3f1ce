#ifndef debond_interface_friction_law_h
#define debond_interface_friction_law_h

#include <debond/interface/law_entries.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  /** What a friction law may keep of a point beside its sliding distance; what
   *  the numbers mean is the law's own affair. */
  using InternalVariables = std::array<double, 2>;

  /** What the laws keep of a point from one accepted state to the next. */
  struct PointHistory
  {
    static constexpr double far = 1e100; ///< [mm]

    /** Accumulated sliding distance g_s [mm], Eq.\ (12). */
    double slip = 0;
    /** g_n [mm] where the point is carried, else far away. */
    double normal_gap = far;
    /** It has been closed: what opens from now on opens a bond. */
    bool joined = false;
    /** The bond is gone for good: by opening. */
    bool broken = false;
    /** How far opening has damaged the bond, by a law with strength in tension:
     *  what the number means is that law's own affair. */
    double            damage = 0;
    InternalVariables internal{};

    /** @p phi_0, or 0 if the bond is gone for good. */
    double
    bond_left(const double phi_0) const
    {
      return broken ? 0. : phi_0;
    }
  };



  /** A point at the beginning of a step, as a friction law sees it. */
  struct FrictionState
  {
    double            phi_0 = 1; ///< initial bonding, as far as it is left
    double            slip  = 0; ///< g_s^n [mm]
    InternalVariables internal{};
    /** dt of the step [unit of time]; 0 where no time passes, and nothing has a
     *  speed. */
    double duration = 0;
  };

  /** The friction coefficient of a point and what it follows from. */
  struct FrictionCoefficient
  {
    double phi = 0; ///< bonding state, Eq. (13); 0 for laws without a bond
    double mu  = 0; ///< Eq. (11)
    double dmu = 0; ///< d mu / d(distance slid in the step) [1/mm]
  };

  /**
   * The friction law of the interface: how mu follows from what a point has
   * gone through and from the distance that it slides in the step. The limit of
   * the tangential traction is mu p.
   *
   * All functions are pure: an object never changes, a trial may be thrown
   * away, and points may be updated in any order. How to add a law:
   * doc/developers/law.md.
   */
  class FrictionLaw
  {
  public:
    virtual ~FrictionLaw() = default;

    /** @name A point in a step */
    //@{
    /** phi, mu and d mu/d @p distance at the end of a step in which the point
     *  slides by @p distance >= 0 [mm]. A point sticks while its traction is
     *  less than with distance 0. A negative mu fails the step. */
    virtual FrictionCoefficient
    coefficient(const FrictionState &start, double distance) const = 0;

    /** The internal variables at the end of that step. */
    virtual InternalVariables
    advance(const FrictionState &start, double) const
    {
      return start.internal;
    }

    /** The internal variables of a point without a history. */
    virtual InternalVariables
    initial_variables() const
    {
      return {};
    }

    /** phi and mu in an accepted @p state, for output. */
    virtual FrictionCoefficient
    reported(const FrictionState &state) const
    {
      return coefficient(state, 0.);
    }
    //@}

    /** @name Works per pressure [mm] */
    //@{
    /** Integral of mu over the @p distance [mm] that a point slides. */
    virtual double
    friction_strength(const FrictionState &start, double distance) const = 0;

    /** How much more that may be if the speed changes within the step. */
    virtual double
    strength_bound(const FrictionState &, double) const
    {
      return 0.;
    }
    //@}

    /** @name Uniqueness */
    //@{
    /** Bound of -d mu/d(distance) [1/mm] >= 0 up to the @p distance in this
     *  step, and for a law that does not depend on the rate for all that is
     *  still to come: what has been found is the first solution, and unique,
     *  while this is less than eps_t / p. */
    virtual double
    steepest_fall(const FrictionState &start, double distance = 0.) const = 0;

    /** The entries that make it less, for messages. */
    virtual std::string
    entries_against_fall() const
    {
      return "";
    }
    //@}

    /** @name What kind of law it is */
    //@{
    /** No tangential traction at all. */
    virtual bool
    is_frictionless() const
    {
      return false;
    }
    /** mu depends on time: such a law needs one. Closed forms and paths of
     *  equilibrium have none. */
    virtual bool
    depends_on_rate() const
    {
      return false;
    }
    /** phi matters: a bonded point that opens is worth a warning. */
    virtual bool
    has_bond() const
    {
      return false;
    }
    /** mu of what has no bond; asked for where there is one. */
    virtual double
    mu_without_bond() const
    {
      return 0.;
    }
    /** Distance over which mu changes [mm]. */
    virtual double
    characteristic_distance() const = 0;
    /** A file that belongs to the law; empty: none. */
    virtual std::string
    file() const
    {
      return "";
    }
    //@}

    /** @name For closed forms; of laws that do not depend on the rate */
    //@{
    /** Sliding distances [mm], ascending, between which mu is smooth; up to the
     *  first and from the last on it is constant. */
    virtual const std::vector<double> &
    kinks() const;
    //@}
  };

  using FrictionLawPointer = std::shared_ptr<const FrictionLaw>;

  using FrictionLawPlugin =
    LawPlugin<FrictionLawPointer (*)(const LawChoice &)>;

  /** All laws, in the order of the choices. */
  const std::vector<FrictionLawPlugin> &
  friction_law_plugins();

  class EntryTable;

  /** Rows for `Friction law` and for the entries of all laws, in `Interface`;
   *  what they are set to goes to @p choice. */
  void
  declare_friction_laws(EntryTable &table, LawChoice &choice);

  /** The law that has been chosen. Throws EntryError. */
  FrictionLawPointer
  create_friction_law(const LawChoice &choice);

  /** The law of a scene that says nothing. */
  FrictionLawPointer
  default_friction_law();

  /** A law that no traction of a sensible interface overcomes. */
  FrictionLawPointer
  sticking_law();
} // namespace Debond
#endif
