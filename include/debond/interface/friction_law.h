#pragma once

#include <debond/interface/law_choice.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  /** Numbers that a friction law may keep of a point beside its sliding
   *  distance; what they mean is the law's own affair. */
  using InternalVariables = std::array<double, 2>;

  /** History of a point, from one accepted state to the next. */
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
    /** Damage of the bond by opening, of a law with strength in tension:
     *  what the number means is that law's own affair. */
    double            damage = 0;
    InternalVariables internal{};
    /** Depth to which the bone at the point is crushed [mm], see BoneLayer; and
     *  the sliding distance that the point had come to when that began [mm],
     *  which tells how far it has taken its dent along. */
    double crushed = 0, crushed_at = 0;
    double sheared = 0; ///< distance that it has slid in the bone [mm]

    /** @p phi_0, or 0 if the bond is gone for good. */
    double
    bond_left(const double phi_0) const
    {
      return broken ? 0. : phi_0;
    }
  };

  /** Decay of a bond with the sliding distance, Eq.\ (13). */
  struct Decay
  {
    double value    = 0; ///< s, from 1, or less, down to 0
    double slope    = 0; ///< ds/dg_s <= 0 [1/mm]
    double integral = 0; ///< of s from 0 on [mm]
    double steepest = 0; ///< bound of -ds/dg_s from here on [1/mm]
  };

  /** A point at the beginning of a step, as laws see it. */
  struct PointStart
  {
    double       phi_0   = 1; ///< initial bonding
    PointHistory history = {};
    /** dt of the step [unit of time]; 0 where no time passes, and nothing has a
     *  speed. */
    double duration = 0;
    /** For now: nothing rubs, and slip does not count. */
    bool frictionless = false;
    /** Damage of the share that is held, at the end of the step. */
    double damage = 0;
    /** Decay of the bond with nothing slid in the step: laws of the interface
     *  ask for it more than once, see InterfaceLaw::begin(). */
    Decay at_rest = {};
    /** Resistance of its speed per distance, eta / dt [MPa/mm]. */
    double viscous = 0;

    /** phi_0 as far as opening has not ended the bond. */
    double
    bond_left() const
    {
      return history.bond_left(phi_0);
    }
  };



  /** Limit L >= 0 of the tangential traction [MPa], Eq.\ (30), and its
   *  derivatives. */
  struct FrictionLimit
  {
    double value       = 0; ///< L
    double by_pressure = 0; ///< dL/dp
    double by_bond     = 0; ///< dL/dphi
    /** dL/dd beside what the bond does [MPa/mm], d being the distance that the
     *  point slides in the step. */
    double by_slip = 0;
  };

  /** Friction coefficient of a point and what it follows from, for output. */
  struct FrictionCoefficient
  {
    double phi = 0; ///< bonding state, Eq. (13); 0 for laws without a bond
    double mu  = 0; ///< L/p, Eq. (11)
    double dmu = 0; ///< d mu / d(distance slid in the step) [1/mm]
  };

  /** Works per area of a point in a step [N/mm]. */
  struct PointWork
  {
    double friction = 0; ///< dissipated by slip, by the law
    /** Bound of its error, as pressure and speed change meanwhile. */
    double friction_bound = 0;
    double damage         = 0; ///< dissipated by opening
    double adhesive       = 0; ///< part of both that breaks the bond
    double lift = 0; ///< work of slip that is stored: it parts the faces
  };



  /**
   * Friction law of the interface: the limit L(p, phi, ...) of the tangential
   * traction, by the pressure p and the bonding state phi = phi_0 s(g_s), whose
   * decay s is the law's, too. What a law of the interface takes for p and phi
   * is its own affair: with `adhesive' p counts c phi t_0 more.
   *
   * The members are the parameters of the law: declare() ties them to entries,
   * initialise() makes of them what else the law needs. After that an object
   * never changes, and all functions are pure: a trial may be thrown away, and
   * points may be updated in any order. How to add a law:
   * doc/developers/law.md.
   */
  struct FrictionLaw
  {
    virtual ~FrictionLaw() = default;

    /** @name Parameters */
    //@{
    /** Rows of the law's own parameters, in `Interface'. Laws may share an
     *  entry. */
    virtual void
    declare(EntryTable &)
    {}
    /** Called once, when the parameters are known. Throws EntryError. */
    virtual void
    initialise()
    {}
    //@}

    /** @name A point in a step */
    //@{
    /** L at the end of a step in which the point slides by @p distance >= 0
     *  [mm], under the @p pressure > 0 [MPa], with the bonding state @p phi
     *  then. A point sticks while its traction is less than with distance 0. A
     *  negative L fails the step. */
    virtual FrictionLimit
    limit(const PointStart &start,
          double            phi,
          double            pressure,
          double            distance) const = 0;

    /** Internal variables at the end of that step. */
    virtual InternalVariables
    advance(const PointStart &start, double) const
    {
      return start.history.internal;
    }

    /** Work and its bound while pressure and speed are constant, and what of it
     *  is the bond's; all exact if L is affine in phi and knows no distance
     *  beside it. */
    virtual PointWork
    work(const PointStart &start, double pressure, double distance) const;

    /** Bound of -dL/d(distance) [MPa/mm] >= 0 up to the @p distance in this
     *  step, and for a law that does not depend on the rate for all that is
     *  still to come: what has been found is the first solution, and unique,
     *  while this is less than eps_t. Here for laws that are affine in phi and
     *  know no distance beside it. */
    virtual double
    steepest_fall(const PointStart &start,
                  double            pressure,
                  double            distance = 0.) const;

    /** Decay of the bond at the sliding distance @p slip [mm]; by default there
     *  is no bond. */
    virtual Decay
    decay(double /*slip*/) const
    {
      return {};
    }
    //@}

    /** @name What kind of law it is, for initialise() to say */
    //@{
    /** No tangential traction at all: then viscosity does not resist either. */
    bool is_frictionless = false;
    /** L depends on time: such a law needs one. Closed forms and paths of
     *  equilibrium have none. */
    bool depends_on_rate = false;
    /** Distance over which L changes [mm]. */
    double characteristic_distance = 0;
    /** Sliding distances [mm], ascending, between which L is smooth; up to the
     *  first and from the last on it is constant. For closed forms; of laws
     *  that do not depend on the rate. */
    std::vector<double> kinks{0.};
    /** Internal variables of a point without a history. */
    InternalVariables initial_variables{};
    /** A file whose content belongs to the law; empty: none. */
    std::string file;
    /** The entries that make steepest_fall() less, for messages. */
    std::string entries_against_fall;
    //@}

    /** @name What follows */
    //@{
    /** L after a sliding distance that the bond has gone, too. */
    FrictionLimit
    limit_after(const PointStart &start, double pressure, double distance) const
    {
      const double phi_0  = start.bond_left();
      const Decay  s      = decay(start.history.slip + distance);
      auto         result = limit(start, phi_0 * s.value, pressure, distance);
      result.by_slip += result.by_bond * phi_0 * s.slope;
      return result;
    }

    /** phi, and mu at a @p pressure [MPa]. */
    FrictionCoefficient
    coefficient(const PointStart &start,
                const double      distance,
                const double      pressure = 1.) const
    {
      const FrictionLimit L = limit_after(start, pressure, distance);
      return {start.bond_left() * decay(start.history.slip + distance).value,
              L.value / pressure,
              L.by_slip / pressure};
    }

    /** True if phi matters: a bonded point that opens is worth a warning. */
    bool
    has_bond() const
    {
      return limit({}, 1., 1., 0.).value != limit({}, 0., 1., 0.).value;
    }
    //@}
  };

  using FrictionLawPointer = std::shared_ptr<const FrictionLaw>;
  using FrictionLawPlugin  = LawPlugin<FrictionLaw>;

  /** The law that has been chosen, ready. Throws EntryError. */
  FrictionLawPointer
  create_friction_law(const LawChoice<FrictionLaw> &choice);
} // namespace Debond
