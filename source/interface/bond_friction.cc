#include <debond/interface/bond_friction.h>

#include <algorithm>

namespace Debond
{
  BondFriction::BondFriction(const double mu_broken, const double mu_unbroken)
    : mu_b(mu_broken)
    , mu_ub(mu_unbroken)
    , drop(mu_unbroken - mu_broken)
  {}



  // Eq. (11), at the updated sliding distance.
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



  double
  BondFriction::adhesive_strength(const FrictionState &start,
                                  const double         distance) const
  {
    if (drop == 0.)
      return 0.;
    return start.phi_0 * drop *
           (integrated_decay(start.slip + distance) -
            integrated_decay(start.slip));
  }



  double
  BondFriction::friction_strength(const FrictionState &start,
                                  const double         distance) const
  {
    return mu_b * distance + adhesive_strength(start, distance);
  }



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
