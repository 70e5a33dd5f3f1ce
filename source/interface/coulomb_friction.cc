#include <debond/interface/bond_friction.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    /** Eq. (13): s is 1 up to a_s, 0 from (1 + 2 b_s) a_s on, half a sine
     *  between. With mu_ub = mu_b it is Coulomb's law. */
    class ModifiedCoulomb : public BondFriction
    {
    public:
      explicit ModifiedCoulomb(const ModifiedCoulombParameters &parameters)
        : BondFriction(parameters.mu_broken, parameters.mu_unbroken)
        , a_s(parameters.sliding_threshold)
        , b_s(parameters.transition_factor)
        , ends({a_s, a_s * (1. + 2. * b_s)})
        , frictionless(parameters.frictionless)
      {}

      bool
      is_frictionless() const override
      {
        return frictionless;
      }

      const std::vector<double> &
      kinks() const override
      {
        return ends;
      }

      double
      characteristic_distance() const override
      {
        return a_s * std::min(1., 2. * b_s);
      }

      std::string
      entries_against_fall() const override
      {
        return "Sliding threshold or Transition factor";
      }

    protected:
      // Eq. (13), with s = g_s/a_s: the bond holds up to s = 1, is gone from s
      // = 1 + 2 b_s on, and falls along half a sine in between, smoothly at
      // both ends, so that dmu/dg_s is continuous.
      double
      decay(const double slip, double &slope) const override
      {
        const double s = slip / a_s;
        slope          = 0.;
        if (s < 1.)
          return 1.;
        if (s > 1. + 2. * b_s)
          return 0.;
        const double argument = 0.5 * M_PI / b_s * (s - b_s - 1.);
        slope                 = -0.25 * M_PI / (a_s * b_s) * std::cos(argument);
        return 0.5 * (1. - std::sin(argument));
      }

      // The integral of Eq. (13) in closed form: for the work of adhesion,
      // which a trapezoid over a step would miss by the curvature of s.
      double
      integrated_decay(const double slip) const override
      {
        const double s = slip / a_s;
        if (s < 1.)
          return slip;
        if (s > 1. + 2. * b_s)
          return a_s * (1. + b_s);
        return a_s * (0.5 * (1. + s) +
                      b_s / M_PI * std::cos(0.5 * M_PI / b_s * (s - b_s - 1.)));
      }

      // pi / (4 a_s b_s) half way down, less after that
      double
      steepest_decay(const double slip) const override
      {
        double slope;
        decay(std::max(slip, a_s * (1. + b_s)), slope);
        return -slope;
      }

    private:
      const double              a_s, b_s;
      const std::vector<double> ends;
      const bool                frictionless;
    };



    std::vector<LawEntry>
    coulomb_entries()
    {
      return BondFriction::entries(
        {{"",
          "Sliding threshold",
          "0.022",
          Allowed::number_between(1e-9, 1e6, "mm"),
          "Sliding distance a_s [mm] up to which a point stays fully bonded. "
          "Only used by modified coulomb."},
         {"",
          "Transition factor",
          "0.74",
          Allowed::number_between(1e-9, 1e6, ""),
          "Factor b_s, dimensionless: a point is fully debonded once it has "
          "slid (1 + 2 b_s) a_s. Only used by modified coulomb."}});
    }



    /** What the entries say; laws that are special cases change it. */
    ModifiedCoulombParameters
    coulomb_parameters(const FrictionLawChoice &choice)
    {
      return {choice.number("Friction coefficient broken"),
              choice.number("Friction coefficient unbroken"),
              choice.number("Sliding threshold"),
              choice.number("Transition factor")};
    }
  } // namespace



  FrictionLawPointer
  modified_coulomb(const ModifiedCoulombParameters &parameters)
  {
    return std::make_shared<ModifiedCoulomb>(parameters);
  }



  FrictionLawPointer
  coulomb(const double mu)
  {
    return modified_coulomb({mu, mu});
  }



  FrictionLawPointer
  default_friction_law()
  {
    return modified_coulomb();
  }



  FrictionLawPointer
  sticking_law()
  {
    return coulomb(1e6);
  }



  FrictionLawPlugin
  frictionless_plugin()
  {
    return {"frictionless",
            "no tangential traction",
            coulomb_entries(),
            [](const FrictionLawChoice &choice) {
              auto parameters      = coulomb_parameters(choice);
              parameters.mu_broken = parameters.mu_unbroken = 0.;
              parameters.frictionless                       = true;
              return modified_coulomb(parameters);
            }};
  }



  FrictionLawPlugin
  coulomb_plugin()
  {
    return {"coulomb",
            "the constant coefficient Friction coefficient broken",
            coulomb_entries(),
            [](const FrictionLawChoice &choice) {
              auto parameters        = coulomb_parameters(choice);
              parameters.mu_unbroken = parameters.mu_broken;
              return modified_coulomb(parameters);
            }};
  }



  FrictionLawPlugin
  modified_coulomb_plugin()
  {
    return {"modified coulomb",
            "the coefficient falls from its unbroken to its broken value as "
            "the accumulated sliding distance of a point grows (Eqs. 11 to 13 "
            "of the paper)",
            coulomb_entries(),
            [](const FrictionLawChoice &choice) {
              return modified_coulomb(coulomb_parameters(choice));
            }};
  }
} // namespace Debond
