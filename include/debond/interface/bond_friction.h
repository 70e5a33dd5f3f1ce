#ifndef debond_interface_bond_friction_h
#define debond_interface_bond_friction_h

#include <debond/interface/friction_law.h>

namespace Debond
{
  /**
   * Laws of a bond that breaks as a point slides: Eq.\ (11),
   *
   *   mu = phi mu_ub + (1 - phi) mu_b,   phi = phi_0 s(g_s),
   *
   * whose decay s falls from 1, or less, and never rises. Two coefficients and
   * a curve make such a law: a class that derives from this one says what the
   * curve is, its integral and the bound of its slope. Newton's method
   * needs the slope, the balance of energy the integral, and the check that the
   * local solution is unique the bound.
   */
  class BondFriction : public FrictionLaw
  {
  public:
    BondFriction(const double mu_broken, const double mu_unbroken)
      : mu_b(mu_broken)
      , drop(mu_unbroken - mu_broken)
    {}

    // mu and dmu/dg_s at the end of a step: what limits the traction, Eq. (30).
    FrictionCoefficient
    coefficient(const FrictionState &start, double distance) const override;
    // int mu dg_s over the step [mm]: work per pressure
    double
    friction_strength(const FrictionState &start,
                      double               distance) const override;
    // the largest -dmu/dg_s ahead [1/mm], for the uniqueness of the local
    // solution
    double
    steepest_fall(const FrictionState &start, double) const override;
    // Where a bond makes no difference its opening is no reason for a warning.
    bool
    has_bond() const override
    {
      return drop != 0.;
    }
    // What closed forms take where phi_0 = 0, beside a bonded disk.
    double
    mu_without_bond() const override
    {
      return mu_b;
    }

    /** What coefficients of friction may be. */
    static AllowedValues
    allowed_coefficient();
    /** The entries of mu_b and mu_ub, and @p more. */
    static std::vector<LawEntry>
    entries(const std::vector<LawEntry> &more);

    // Laws of the interface ask for the bond itself.
    /** s at the sliding distance @p slip [mm]; @p slope: ds/dg_s [1/mm]. */
    virtual double
    decay(double slip, double &slope) const = 0;
    /** Integral of s from 0 to @p slip [mm]. */
    virtual double
    integrated_decay(double slip) const = 0;
    /** Bound of -ds/dg_s from @p slip on [1/mm]. */
    virtual double
    steepest_decay(double slip) const = 0;

    const double mu_b, drop; ///< mu_ub - mu_b

  protected:
    // Eq. (11), mu = mu_b + phi (mu_ub - mu_b), with phi = phi_0 s(g_s). The
    // law is implicit: g_s is the sliding distance at the end of the step,
    // g_s^n plus what the point slides in it, Eq. (32). So softening follows
    // the slip without the lag of a step, and Newton's method needs dmu/dg_s.
    //
    // mu is mu_ub where the bond is whole and mu_b where it is gone. phi never
    // rises, since g_s never falls and s never rises: damage does not heal.
    // phi_0 is that of the point, 0 if its bond has been broken by opening. mu
    // at g_s^n instead would leave the torque of the main scene in 50 steps too
    // high by up to 4.4 % of the largest while the bond softens, right at its
    // maximum and at the end
    // (doc/explanation/contact.md, Stick and slip).
    FrictionCoefficient
    of_decay(const double phi_0, const double s, const double slope) const
    {
      FrictionCoefficient result;
      // phi and mu are dimensionless, dmu/dg_s in 1/mm
      result.phi = phi_0 * s;
      result.mu  = mu_b + result.phi * drop;
      result.dmu = phi_0 * slope * drop;
      return result;
    }
  };


  // Each sliding point asks a few times in a step: a final class that calls
  // this, inline, spares it the call of decay().
  inline FrictionCoefficient
  BondFriction::coefficient(const FrictionState &start,
                            const double         distance) const
  {
    double       slope;
    const double s = decay(start.slip + distance, slope);
    return of_decay(start.phi_0, s, slope);
  }



  /** Eq.\ (13) with its four parameters. */
  struct ModifiedCoulombParameters
  {
    double mu_broken         = 0.40;  ///< mu_b
    double mu_unbroken       = 0.58;  ///< mu_ub
    double sliding_threshold = 0.022; ///< a_s [mm]
    double transition_factor = 0.74;  ///< b_s
    bool   frictionless      = false; ///< what a law of this kind is called
  };

  FrictionLawPointer
  modified_coulomb(const ModifiedCoulombParameters &parameters = {});

  /** Coulomb's law, whose @p mu no bond changes. The bond is reported as with
   *  the default of Eq. (13). */
  FrictionLawPointer
  coulomb(double mu = ModifiedCoulombParameters().mu_broken);
} // namespace Debond
#endif
