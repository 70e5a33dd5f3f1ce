#include <debond/interface/bond_friction.h>

namespace Debond
{
  // int mu dg_s [mm], exactly: debonded friction, and the bond on top of it,
  // whose part times p and summed over the face is D_adh, which does not depend
  // on how a curve is read, as the W_adh of Eq. (20) does. The balance that
  // tells whether a step has jumped compares it with the work of the machine: a
  // trapezoid between the two ends of a step would hold for any two states.
  double
  BondFriction::friction_strength(const FrictionState &start,
                                  const double         distance) const
  {
    return mu_b * distance + start.phi_0 * drop *
                               (integrated_decay(start.slip + distance) -
                                integrated_decay(start.slip));
  }



  // -dmu/dg_s [1/mm] at its largest from g_s^n on, whatever the distance slid
  // in this step: the law does not depend on the rate, so that what is ahead of
  // a point is known. Times p it must stay below eps_t. A bond that strengthens
  // as it breaks, mu_ub < mu_b, never falls.
  double
  BondFriction::steepest_fall(const FrictionState &start, double) const
  {
    return drop > 0. ? steepest_decay(start.slip) * start.phi_0 * drop : 0.;
  }



  // 0 is allowed, for faces without friction; anything else below 1e-9 is taken
  // for a slip of the pen.
  AllowedValues
  BondFriction::allowed_coefficient()
  {
    return Allowed::number_between(1e-9, 1e6, "").or_number(0);
  }



  std::vector<LawEntry>
  BondFriction::entries(const std::vector<LawEntry> &more)
  {
    const AllowedValues   coefficient = allowed_coefficient();
    std::vector<LawEntry> all{
      {"",
       "Friction coefficient broken",
       "0.40",
       coefficient,
       "Friction coefficient mu_b of a debonded point, dimensionless. "
       "Used by modified coulomb and table."},
      {"",
       "Friction coefficient unbroken",
       "0.58",
       coefficient,
       "Coefficient mu_ub of a fully bonded point, dimensionless. Used by "
       "modified coulomb and table, not with Law = mixed mode."}};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
} // namespace Debond
