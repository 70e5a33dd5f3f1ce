#include <debond/input/allowed_values.h>
#include <debond/interface/friction_law.h>

#include <deal.II/base/parameter_handler.h>

namespace Debond
{
  void
  FrictionParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry(
      "Friction law",
      "modified coulomb",
      Allowed::choice("frictionless | coulomb | modified coulomb"),
      "`frictionless': no tangential traction. `coulomb': the constant "
      "coefficient Friction coefficient broken. `modified coulomb': the "
      "coefficient falls from its unbroken to its broken value as the "
      "accumulated sliding distance of a point grows (Eqs. 11 to 13 of the "
      "paper).");
    prm.declare_entry("Friction coefficient broken",
                      "0.40",
                      Allowed::number_from(0, ""),
                      "Coefficient mu_b of a debonded point, dimensionless; "
                      "the coefficient of plain coulomb.");
    prm.declare_entry("Friction coefficient unbroken",
                      "0.58",
                      Allowed::number_from(0, ""),
                      "Coefficient mu_ub of a fully bonded point, "
                      "dimensionless. Only used by modified coulomb.");
    prm.declare_entry("Sliding threshold",
                      "0.022",
                      Allowed::number_above(0, "mm"),
                      "Sliding distance a_s [mm] up to which a point stays "
                      "fully bonded. Only used by modified coulomb.");
    prm.declare_entry("Transition factor",
                      "0.74",
                      Allowed::number_above(0, ""),
                      "Factor b_s, dimensionless: a point is fully debonded "
                      "once it has slid (1 + 2 b_s) a_s. Only used by modified "
                      "coulomb.");
    prm.declare_entry("Friction starts at",
                      "0",
                      Allowed::number("time"),
                      "Time before which the interface is frictionless, for "
                      "instance to press the implant in without locking "
                      "tangential traction in.");
  }



  void
  FrictionParameters::parse(dealii::ParameterHandler &prm)
  {
    const std::string law = prm.get("Friction law");
    kind              = law == "frictionless" ? FrictionLawKind::frictionless :
                        law == "coulomb"      ? FrictionLawKind::coulomb :
                                                FrictionLawKind::modified_coulomb;
    mu_broken         = prm.get_double("Friction coefficient broken");
    mu_unbroken       = prm.get_double("Friction coefficient unbroken");
    sliding_threshold = prm.get_double("Sliding threshold");
    transition_factor = prm.get_double("Transition factor");
    starts_at         = prm.get_double("Friction starts at");
  }
} // namespace Debond

#include <algorithm>
#include <cmath>

namespace Debond
{
  double
  bonding_decay(const FrictionParameters &parameters,
                const double              slip,
                double                   &derivative)
  {
    const double a_s = parameters.sliding_threshold;
    const double b_s = parameters.transition_factor;
    const double s   = slip / a_s;
    derivative       = 0.;
    if (s < 1.)
      return 1.;
    if (s > 1. + 2. * b_s)
      return 0.;
    const double argument = 0.5 * M_PI / b_s * (s - b_s - 1.);
    derivative            = -0.25 * M_PI / (a_s * b_s) * std::cos(argument);
    return 0.5 * (1. - std::sin(argument));
  }



  namespace
  {
    // Integral of s(g/a_s) from 0 to g, Eq. (13).
    double
    integrated_decay(const FrictionParameters &parameters, const double slip)
    {
      const double a_s = parameters.sliding_threshold;
      const double b_s = parameters.transition_factor;
      const double s   = slip / a_s;
      if (s < 1.)
        return slip;
      if (s > 1. + 2. * b_s)
        return a_s * (1. + b_s);
      return a_s * (0.5 * (1. + s) +
                    b_s / M_PI * std::cos(0.5 * M_PI / b_s * (s - b_s - 1.)));
    }
  } // namespace



  double
  steepest_fall(const FrictionParameters &parameters,
                const double              phi_0,
                const double              slip)
  {
    if (parameters.kind != FrictionLawKind::modified_coulomb)
      return 0.;
    const double half_way =
      parameters.sliding_threshold * (1. + parameters.transition_factor);
    double steepest;
    bonding_decay(parameters, std::max(slip, half_way), steepest);
    return -steepest * phi_0 *
           std::max(0., parameters.mu_unbroken - parameters.mu_broken);
  }



  double
  adhesive_strength(const FrictionParameters &parameters,
                    const double              phi_0,
                    const double              from,
                    const double              to)
  {
    if (parameters.kind != FrictionLawKind::modified_coulomb)
      return 0.;
    return phi_0 * (parameters.mu_unbroken - parameters.mu_broken) *
           (integrated_decay(parameters, to) -
            integrated_decay(parameters, from));
  }



  double
  friction_strength(const FrictionParameters &parameters,
                    const double              phi_0,
                    const double              from,
                    const double              to)
  {
    const double mu_without_bond =
      parameters.kind == FrictionLawKind::frictionless ? 0. :
                                                         parameters.mu_broken;
    return mu_without_bond * (to - from) +
           adhesive_strength(parameters, phi_0, from, to);
  }



  FrictionCoefficient
  friction_coefficient(const FrictionParameters &parameters,
                       const double              phi_0,
                       const double              slip)
  {
    FrictionCoefficient result;
    double              decay_derivative;
    result.phi = phi_0 * bonding_decay(parameters, slip, decay_derivative);
    switch (parameters.kind)
      {
        case FrictionLawKind::frictionless:
          break;
        case FrictionLawKind::coulomb:
          result.mu = parameters.mu_broken;
          break;
        case FrictionLawKind::modified_coulomb:
          {
            const double drop = parameters.mu_unbroken - parameters.mu_broken;
            result.mu         = parameters.mu_broken + result.phi * drop;
            result.dmu        = phi_0 * decay_derivative * drop;
            break;
          }
      }
    return result;
  }
} // namespace Debond
