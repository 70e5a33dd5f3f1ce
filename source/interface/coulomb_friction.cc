#include <debond/interface/bond_friction.h>

#include <algorithm>
#include <cmath>

// The friction law of the paper, and Coulomb's as a special case of it. Points
// first stick to the interface by an elastic spring; this file says what limits
// the traction of that spring, mu p, as a function of the distance g_s [mm]
// that a point has slid. Eq. (11), which makes mu of the bond, stands in
// bond_friction.h; here is the decay of the bond, Eq. (13).
namespace Debond
{
  namespace
  {
    /** Eq.\ (13): s is 1 up to a_s, 0 from (1 + 2 b_s) a_s on, half a sine
     *  between. With mu_ub = mu_b it is Coulomb's law. The defaults are those
     *  of data set 1 with mu_b = 0.4: a_s = 0.022 mm and b_s = 0.74, so that a
     *  point is debonded once it has slid (1 + 2 b_s) a_s = 54.6 um. */
    class ModifiedCoulomb final : public BondFriction
    {
    public:
      explicit ModifiedCoulomb(const ModifiedCoulombParameters &parameters)
        : BondFriction(parameters.mu_broken, parameters.mu_unbroken)
        , a_s(parameters.sliding_threshold)
        , b_s(parameters.transition_factor)
        , ends({a_s, a_s * (1. + 2. * b_s)})
        , frictionless(parameters.frictionless)
      {}

      // This is more than mu = 0, with which the viscosity still resists.
      bool
      is_frictionless() const override
      {
        return frictionless;
      }

      // a_s and (1 + 2 b_s) a_s [mm]. s and its slope are continuous there, its
      // curvature is not; closed forms integrate between them.
      const std::vector<double> &
      kinks() const override
      {
        return ends;
      }

      // The shorter of the two stages [mm]: the bond holds over a_s and falls
      // over 2 b_s a_s. The largest step along a path of equilibrium is a
      // twentieth of it where the scene does not say.
      double
      characteristic_distance() const override
      {
        return a_s * std::min(1., 2. * b_s);
      }

      // What makes the steepest slope pi / (4 a_s b_s) smaller: larger a_s or
      // b_s.
      std::string
      entries_against_fall() const override
      {
        return "Characteristic slip distance or Transition factor";
      }

      // that of all such laws; here the compiler knows whose decay() it calls
      FrictionCoefficient
      coefficient(const FrictionState &start,
                  const double         distance) const override
      {
        return BondFriction::coefficient(start, distance);
      }

    protected:
      // Eq. (13), with s = g_s/a_s: the bond holds up to s = 1, is gone from s
      // = 1 + 2 b_s on, and falls along half a sine in between, smoothly at
      // both ends, so that dmu/dg_s is continuous.
      //
      // The slope is that of s, in 1/mm: Newton's method needs it exactly, for
      // a point and for the whole system. The slope is 0 in both constant
      // parts, where the point follows Coulomb's law.
      double
      decay(const double slip, double &slope) const override
      {
        const double s = slip / a_s;
        slope          = 0.;
        if (s < 1. || frictionless) // nothing wears it
          return 1.;
        if (s > 1. + 2. * b_s)
          return 0.;
        // from -pi/2 to pi/2 over the fall, 0 in its middle, s = 1 + b_s; the
        // slope carries the 1/a_s of the inner derivative
        const double argument = 0.5 * M_PI / b_s * (s - b_s - 1.);
        slope                 = -0.25 * M_PI / (a_s * b_s) * std::cos(argument);
        return 0.5 * (1. - std::sin(argument));
      }

      // The integral of Eq. (13) in closed form: for the work of adhesion,
      // which a trapezoid over a step would miss by the curvature of s.
      //
      // Its unit is mm. Over the whole decay it is (1 + b_s) a_s: as if the
      // bond held fully up to the middle of the fall, by symmetry of the sine.
      // Under the pressure p a bond costs phi_0 (mu_ub - mu_b) p (1 + b_s) a_s
      // per area [N/mm].
      double
      integrated_decay(const double slip) const override
      {
        const double s = slip / a_s;
        if (s < 1. || frictionless)
          return slip;
        if (s > 1. + 2. * b_s)
          return a_s * (1. + b_s);
        return a_s * (0.5 * (1. + s) +
                      b_s / M_PI * std::cos(0.5 * M_PI / b_s * (s - b_s - 1.)));
      }

      // The largest slope that is still ahead of a point [1/mm]: pi / (4 a_s
      // b_s) half way down, at (1 + b_s) a_s, less after that. It gives the
      // bound of local uniqueness, p / eps_t < 4 a_s b_s / (pi phi_0 (mu_ub -
      // mu_b)) (doc/explanation/stability.md). A point before the middle is
      // judged by the middle already, so that a large step does not jump over
      // it unnoticed.
      //
      // A short fall is a brittle bond. The torque of the main scene falls by
      // less than 1 N m/rad, far less than any machine is stiff; with a_s =
      // 0.005 mm and b_s = 0.3 it is 8.9 N m/rad for rigid bodies, and a
      // compliant machine may snap back.
      double
      steepest_decay(const double slip) const override
      {
        double slope;
        decay(std::max(slip, a_s * (1. + b_s)), slope);
        return -slope;
      }

    private:
      // a_s [mm]; b_s, dimensionless; the ends of the fall [mm]; whether the
      // scene calls the law frictionless
      const double              a_s, b_s;
      const std::vector<double> ends;
      const bool                frictionless;
    };



    // Of the bond. Tables of allowed values keep a_s and b_s above zero, by
    // which Eq. (13) divides.
    std::vector<LawEntry>
    decay_entries()
    {
      return {{"",
               "Characteristic slip distance",
               "0.022",
               Allowed::number_between(1e-9, 1e6, "mm"),
               "Characteristic slip distance a_s [mm]: sliding distance up to "
               "which a point stays fully bonded. Used by modified coulomb, "
               "and by coulomb with Law = adhesive; not with Law = mixed "
               "mode."},
              {"",
               "Transition factor",
               "0.74",
               Allowed::number_between(1e-9, 1e6, ""),
               "Factor b_s, dimensionless: a point is fully debonded once it "
               "has slid (1 + 2 b_s) a_s. Used where Characteristic slip "
               "distance is."}};
    }



    ModifiedCoulombParameters
    parameters_of(const LawChoice &choice,
                  const double     mu_broken,
                  const double     mu_unbroken)
    {
      return {mu_broken,
              mu_unbroken,
              choice.number("Characteristic slip distance"),
              choice.number("Transition factor")};
    }
  } // namespace



  // For programs and tests, without a scene; the plug-ins below make the same
  // from entries. Laws are shared and never change: all points refer to one
  // object.
  FrictionLawPointer
  modified_coulomb(const ModifiedCoulombParameters &parameters)
  {
    return std::make_shared<ModifiedCoulomb>(parameters);
  }



  // With mu_ub = mu_b nothing falls, and the bond, which still decays for
  // output, costs nothing.
  FrictionLawPointer
  coulomb(const double mu)
  {
    return modified_coulomb({mu, mu});
  }



  // That of the paper, with its numbers for data set 1.
  FrictionLawPointer
  default_friction_law()
  {
    return modified_coulomb();
  }



  // A coefficient that no traction reaches: for the linear solution from which
  // the closed forms take the stiffness of interface and bodies in series, Eq.
  // (39). A law of its own would have to repeat the rest.
  FrictionLawPointer
  sticking_law()
  {
    return coulomb(1e6);
  }



  // Three names of one class. The first has the coefficient 0: a closed
  // point is then projected on the master, without a tangential traction.
  FrictionLawPlugin
  frictionless_plugin()
  {
    return {"frictionless",
            "no friction",
            decay_entries(),
            [](const LawChoice &choice) {
              auto parameters         = parameters_of(choice, 0., 0.);
              parameters.frictionless = true;
              return modified_coulomb(parameters);
            }};
  }



  // Eq. (8). It is what the debonded implant slides with at the end of the
  // paper's test.
  FrictionLawPlugin
  coulomb_plugin()
  {
    std::vector<LawEntry> entries = decay_entries();
    entries.insert(
      entries.begin(),
      {"",
       "Friction coefficient",
       "0.40",
       BondFriction::allowed_coefficient(),
       "Coefficient mu of Friction law = coulomb, dimensionless."});
    return {"coulomb",
            "constant, Friction coefficient",
            entries,
            [](const LawChoice &choice) {
              const double mu = choice.number("Friction coefficient");
              return modified_coulomb(parameters_of(choice, mu, mu));
            }};
  }



  // All four parameters as they are given. What they would have to be is a
  // matter of calibration: the paper finds them from measured torque curves for
  // given mu_b.
  FrictionLawPlugin
  modified_coulomb_plugin()
  {
    return {"modified coulomb",
            "falls from Friction coefficient unbroken to broken with the "
            "accumulated sliding distance of a point (Eqs. 11 to 13 of the "
            "paper)",
            BondFriction::entries(decay_entries()),
            [](const LawChoice &choice) {
              return modified_coulomb(
                parameters_of(choice,
                              choice.number("Friction coefficient broken"),
                              choice.number("Friction coefficient unbroken")));
            }};
  }
} // namespace Debond
