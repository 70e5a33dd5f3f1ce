#ifndef debond_interface_friction_law_h
#define debond_interface_friction_law_h

namespace dealii
{
  class ParameterHandler;
}

namespace Debond
{
  enum class FrictionLawKind
  {
    frictionless,
    coulomb,
    modified_coulomb
  };

  /** The friction entries of the subsection `Interface`. */
  struct FrictionParameters
  {
    FrictionLawKind kind              = FrictionLawKind::modified_coulomb;
    double          mu_broken         = 0.40;  ///< mu_b
    double          mu_unbroken       = 0.58;  ///< mu_ub
    double          sliding_threshold = 0.022; ///< a_s [mm]
    double          transition_factor = 0.74;  ///< b_s
    double          starts_at         = 0; ///< frictionless before this time

    static void
    declare(dealii::ParameterHandler &prm);
    void
    parse(dealii::ParameterHandler &prm);
  };

  /** The friction coefficient of a point and what it follows from. */
  struct FrictionCoefficient
  {
    double phi = 0; ///< bonding state, Eq. (13)
    double mu  = 0; ///< Eq. (11)
    double dmu = 0; ///< d mu / d g_s [1/mm]
  };

  /** s(g_s/a_s) of Eq. (13): 1 below 1, 0 above 1 + 2 b_s, half a sine between.
   *  @p derivative is ds/dg_s [1/mm]. */
  double
  bonding_decay(const FrictionParameters &parameters,
                double                    slip,
                double                   &derivative);

  /** Largest fall |d mu/d g_s| of the modified law [1/mm] at sliding distances
   *  from @p slip [mm] on: pi phi_0 (mu_ub - mu_b) / (4 a_s b_s) as long as it
   *  is not half way down, 0 for the other laws. */
  double
  steepest_fall(const FrictionParameters &parameters,
                double                    phi_0,
                double                    slip = 0);

  /** Integral of mu - mu_b over the sliding distance from @p from to @p to
   * [mm]; 0 for the other laws. */
  double
  adhesive_strength(const FrictionParameters &parameters,
                    double                    phi_0,
                    double                    from,
                    double                    to);

  /** Integral of mu over the sliding distance from @p from to @p to [mm]: what
   *  friction spends, per pressure. */
  double
  friction_strength(const FrictionParameters &parameters,
                    double                    phi_0,
                    double                    from,
                    double                    to);

  /** Eqs. (11) and (13) at the accumulated sliding distance @p slip [mm]. For
   *  `coulomb` mu = mu_b, for `frictionless` 0; phi is reported all the same.
   */
  FrictionCoefficient
  friction_coefficient(const FrictionParameters &parameters,
                       double                    phi_0,
                       double                    slip);
} // namespace Debond
#endif
