#pragma once

#include <debond/interface/bone_layer.h>
#include <debond/interface/modified_coulomb.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

namespace Debond
{
  /** Tractions of an interface at the end of a step, by the gap g_n across it
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
    /** True if the viscosity resists sliding, beside L. */
    bool resists = false;
    /** True if the point slides in the bone, which bears no more; @p rubbed is
     *  the distance before that [mm]. */
    bool   shears = false;
    double rubbed = 0;
  };



  /** Behaviour of a full bond in tension; 0 of laws without strength there. */
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



  struct BilinearBond;

  /**
   * Law of the interface: from the history of a point, the gap across it and
   * the distance that it slides to the pressure, the limit of the tangential
   * traction, energies, and a new history. Which points slide, and where to, is
   * the same for all laws (slip_problem.h).
   *
   * All laws push with a stiffness eps_n where the faces are pressed together,
   * and rub with a friction law. This one does no more: p = -eps_n g_n while
   * that is positive, and L of that, as in the paper. All functions are pure.
   * How to add a law: doc/developers/law.md.
   */
  class InterfaceLaw
  {
  public:
    virtual ~InterfaceLaw() = default;

    /** @name Parameters */
    //@{
    /** Rows of the law's own parameters, in `Interface'. */
    virtual void
    declare(EntryTable &)
    {}
    /** Called once, when parameters and the members below are known. Returns
     * false if the law comes to friction under pressure. Throws EntryError. */
    virtual bool
    initialise();
    //@}

    /** @name Members of all laws */
    //@{
    double             stiffness = 585; ///< eps_n [MPa/mm]
    FrictionLawPointer friction;        ///< never null where points are asked
    BoneLayer          bone;
    bool               opening_breaks_bond = false;
    /** `Friction update = explicit': L is that at which the step begins,
     *  whatever the distance, so that a softening bond lags behind by a step.
     *  It has no slope and is never ambiguous. Works are still those of the
     *  law. See doc/evidence/stability.md. */
    bool explicit_friction = false;
    //@}

    /** @name A point in a step */
    //@{
    /** The point with its history @p history begins a step. */
    PointStart
    begin(const PointHistory &history,
          const double        phi_0,
          const double        duration     = 0.,
          const bool          frictionless = false) const
    {
      return {phi_0,
              history,
              duration,
              frictionless,
              history.damage,
              friction->decay(history.slip)};
    }

    /** Tractions at the end of the step, at the gap @p g_n [mm], after sliding
     *  by @p distance [mm], as far as the bone bears them. Goes on smoothly
     *  beyond reach(), where Newton's method may look, and where touching
     *  points have their tangent. A point cannot slide backwards: at negative
     *  distances nothing rises. */
    InterfaceResponse
    respond(const PointStart &start,
            const double      g_n,
            const double      distance) const
    {
      // Laws give answer(); what the bone bears of it is the same for all, and
      // is asked here alone. Most scenes have bone that bears all, and pay one
      // comparison for it.
      if (bone.shears())
        return respond_in_bone(start, g_n, distance);
      InterfaceResponse result = answer(start, g_n, distance);
      result.rubbed            = distance;
      return result;
    }

    /** What is left of a gap between faces that have been crushed and have
     *  climbed on each other [mm]. */
    virtual double
    gap_left(const PointStart &start,
             const double      g_n,
             double /*distance*/) const
    {
      return g_n + start.history.crushed;
    }

    /** The pressure there, at least 0 [MPa]. */
    double
    pressed(const PointStart &start,
            const double      g_n,
            const double      distance) const
    {
      return std::max(0., push(start, g_n, distance).pressure);
    }

    /** The gap up to which the point is carried [mm]. */
    virtual double
    reach(const PointStart &start, double /*distance*/) const
    {
      return -start.history.crushed;
    }

    /** What pushes there, see gap_left(). */
    BoneLayer::Push
    push(const PointStart &start, const double g_n, const double distance) const
    {
      return bone.push(stiffness,
                       gap_left(start, g_n, distance),
                       start.history.crushed);
    }

    /** History of a point that is carried at the end of the step. */
    virtual PointHistory
    advance(const PointStart &start, double g_n, double distance) const;

    /** History of a point that opens. */
    virtual PointHistory
    open(const PointHistory &history) const;

    /** Works of a point that is carried, but for what the bone takes. */
    virtual PointWork
    work(const PointStart &start, double g_n, double distance) const;
    //@}

    /** Bound of -dL/dd [MPa/mm] >= 0 at the @p pressure [MPa], up to the @p
     *  distance and for what is still to come: what has been found is the first
     *  solution, and unique, while this is less than eps_t. */
    virtual double
    softening_by_slip(const PointStart &start,
                      double            pressure,
                      double            distance) const;

    /** phi, and mu at a @p pressure [MPa], in an accepted state, for output. */
    virtual FrictionCoefficient
    reported(const PointHistory &history, double phi_0, double pressure) const;

    /** Parts of a full bond that opening and slip have each left, for output:
     *  phi is phi_0 times both. */
    std::array<double, 2>
    left_by_each(const PointHistory &history) const;

    /** @name What kind of law it is, for initialise() to say */
    //@{
    /** Behaviour of a full bond in tension. */
    Tension tension;
    /** Bond of the share of the area that is held at the place where it bonded;
     *  null where no such share is. */
    std::shared_ptr<const BilinearBond> cohesion;
    /** Distance over which the interface changes [mm]. */
    double characteristic_distance = 0;
    //@}

    /** @name What follows */
    //@{
    bool
    pulls() const
    {
      return tension.strength > 0.;
    }
    /** Distance that a point has slid in the interface and in the bone [mm]. */
    double
    slid(const PointHistory &history) const
    {
      return history.slip + (bone.shear_wears_bond ? 0. : history.sheared);
    }
    /** Opening that a point has come to [mm], which never falls: with the
     *  sliding distance what a path of equilibrium is measured by. */
    double
    opened(const PointHistory &history) const
    {
      return cohesion ? 0. : history.damage;
    }
    /** True if friction depends on the duration of a step. */
    bool
    depends_on_rate() const
    {
      return !explicit_friction && friction->depends_on_rate;
    }
    //@}

  protected:
    /** respond(), of an interface on bone that bears all. */
    virtual InterfaceResponse
    answer(const PointStart &start, double g_n, double distance) const;

    /** Number of a point, and its derivatives by gap and distance. */
    using Changing = Eigen::Vector3d;

    /** phi_0 s(g_s) after a distance. */
    Changing
    bond_after(const PointStart &start, double distance) const;

    /** Writes L and its derivatives: that of the friction law under what is
     *  pressed together, @p pressed > 0 [MPa], with the bonding state @p phi.
     */
    void
    rub(const PointStart  &start,
        double             distance,
        const Changing    &pressed,
        const Changing    &phi,
        InterfaceResponse &response) const;

    /** For a law called @p law, which breaks the bond of the friction law by
     *  opening as well. Throws EntryError if there is none. */
    void
    require_bond(const std::string &law) const;

  private:
    InterfaceResponse
    respond_in_bone(const PointStart &start, double g_n, double distance) const;
  };

  using InterfaceLawPointer = std::shared_ptr<const InterfaceLaw>;
  using InterfaceLawPlugin  = LawPlugin<InterfaceLaw>;

  /** @p law, or what it comes to, ready. Throws EntryError. */
  InterfaceLawPointer
  initialised(const std::shared_ptr<InterfaceLaw> &law);

  /** Law of the paper. */
  InterfaceLawPointer
  friction_under_pressure(double stiffness, const FrictionLawPointer &friction);



  /** Direction in which a point slides in a step. */
  enum class SlipDirection
  {
    integrated,  ///< along its way, see TowedGap
    trial,       ///< along the gap that it would have without sliding
    previous_gap ///< along that of the step before, Eq. (31) as printed
  };

  /** Law and numbers that govern all points of an interface. */
  struct ContactPointLaw
  {
    InterfaceLawPointer joint =
      friction_under_pressure(585, modified_coulomb());
    double tangential_penalty = 585; ///< eps_t [MPa/mm]
    /** eta [MPa per (mm per unit of time)]: resistance of a point to the speed
     *  it slides with. */
    double        viscosity      = 0;
    SlipDirection slip_direction = SlipDirection::integrated;

    /** True if a viscosity resists sliding or opening. */
    bool
    is_viscous() const
    {
      return viscosity > 0. || joint->tension.viscosity > 0.;
    }
  };
} // namespace Debond
