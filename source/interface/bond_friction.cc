#include <debond/interface/bond_friction.h>

namespace Debond
{
  // Eq. (11), mu = mu_b + phi (mu_ub - mu_b), with phi = phi_0 s(g_s). The law
  // is implicit: g_s is the sliding distance at the end of the step, g_s^n plus
  // what the point slides in it, Eq. (32). So softening follows the slip
  // without the lag of a step, and Newton's method needs dmu/dg_s.
  FrictionCoefficient
  BondFriction::coefficient(const FrictionState &start,
                            const double         distance) const
  {
    FrictionCoefficient result;
    double              slope;
    result.phi = start.phi_0 * decay(start.slip + distance, slope);
    result.mu  = mu_b + result.phi * drop;
    result.dmu = start.phi_0 * slope * drop;
    return result;
  }



  // int (mu - mu_b) dg_s, exactly: the work per pressure that goes into the
  // bond.
  double
  BondFriction::adhesive_strength(const FrictionState &start,
                                  const double         distance) const
  {
    return start.phi_0 * drop *
           (integrated_decay(start.slip + distance) -
            integrated_decay(start.slip));
  }



  // int mu dg_s: debonded friction, and the bond on top of it.
  double
  BondFriction::friction_strength(const FrictionState &start,
                                  const double         distance) const
  {
    return mu_b * distance + adhesive_strength(start, distance);
  }



  // A bond that strengthens as it breaks, mu_ub < mu_b, never falls.
  double
  BondFriction::steepest_fall(const FrictionState &start, double) const
  {
    return drop > 0. ? steepest_decay(start.slip) * start.phi_0 * drop : 0.;
  }



  std::vector<LawEntry>
  BondFriction::entries(const std::vector<LawEntry> &more)
  {
    const AllowedValues coefficient =
      Allowed::number_between(1e-9, 1e6, "").or_number(0);
    std::vector<LawEntry> all{
      {"",
       "Friction coefficient broken",
       "0.40",
       coefficient,
       "Coefficient mu_b of a debonded point, dimensionless; the coefficient of "
       "plain coulomb."},
      {"",
       "Friction coefficient unbroken",
       "0.58",
       coefficient,
       "Coefficient mu_ub of a fully bonded point, dimensionless. Used by "
       "modified coulomb and table."}};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
} // namespace Debond
