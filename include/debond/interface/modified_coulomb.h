#pragma once

#include <debond/interface/friction_law.h>

namespace Debond
{
  /** Parameters of Eqs.\ (11) and (13). */
  struct ModifiedCoulombParameters
  {
    double mu_broken         = 0.40;  ///< mu_b
    double mu_unbroken       = 0.58;  ///< mu_ub
    double sliding_threshold = 0.022; ///< a_s [mm]
    double transition_factor = 0.74;  ///< b_s
  };



  /** The law of the paper: L = mu p with mu = phi mu_ub + (1 - phi) mu_b, Eq.\
   *  (11), and phi = phi_0 s(g_s), Eq.\ (13). Laws with another coefficient, or
   *  another decay, may derive from it. */
  class ModifiedCoulomb : public FrictionLaw
  {
  public:
    /** Which of the coefficients scenes give: both; one, Coulomb's law, Eq.\
     *  (8); or none, which stays frictionless under a viscosity, too. */
    enum class Coefficients
    {
      two,
      one,
      none
    };
    explicit ModifiedCoulomb(
      const ModifiedCoulombParameters &parameters   = {},
      const Coefficients               coefficients = Coefficients::two)
      : parameters(parameters)
      , coefficients(coefficients)
    {}

    void
    declare(EntryTable &table) override;
    void
    initialise() override;
    FrictionLimit
    limit(const PointStart &start,
          double            phi,
          double            pressure,
          double            distance) const override;
    Decay
    decay(double slip) const override;

  protected:
    /** Rows of the coefficients, those of them that are given. */
    void
    declare_coefficients(EntryTable &table);

    // Values of data set 1 of the paper until a scene says otherwise; mu_ub =
    // mu_b has a bond that changes no friction.
    ModifiedCoulombParameters parameters;
    Coefficients              coefficients;
  };



  FrictionLawPointer
  modified_coulomb(ModifiedCoulombParameters     parameters = {},
                   ModifiedCoulomb::Coefficients coefficients =
                     ModifiedCoulomb::Coefficients::two);
} // namespace Debond
