#include <debond/interface/bond_friction.h>
#include <debond/interface/interface_law.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Debond
{
  namespace
  {
    // The bilinear cohesive law of Camanho and Davila (2002) between the bonded
    // share of a point and the place where it bonded, and friction on the share
    // that is broken, after Alfano and Sacco (2006):
    //
    //   t = phi_0 (1 - omega) K delta,   delta = (<n>, delta_t),
    //   L = mu_b (1 - phi_0 (1 - omega)) max(0, p).
    //
    // omega begins where (<t_n>/N)^2 + (t_t/T)^2 = 1 and is 1 where the work is
    // that of the criterion, G(B), B = delta_t^2/delta^2. It never falls.
    class MixedMode : public InterfaceLaw
    {
    public:
      MixedMode(const LawChoice &choice, const InterfaceLawParts &parts)
        : InterfaceLaw(parts)
        , N(choice.number("Normal strength"))
        , T(choice.number("Shear strength"))
        , G_I(choice.number("Fracture energy I"))
        , G_II(choice.number("Fracture energy II"))
        , K(choice.number("Stiffness"))
        , exponent(choice.number("Exponent"))
        , power_law(choice.text("Criterion") == "power law")
        , mu_b(parts.friction->mu_without_bond())
      {}

      InterfaceResponse
      respond(const PointStart &start,
              const double      g_n,
              const double) const override
      {
        InterfaceResponse result;
        result.pressure        = -stiffness * g_n;
        result.pressure_by_gap = -stiffness;
        result.energy          = 0.5 * stiffness * g_n * g_n;
        // the tangent of faces that touch, whichever way they will go
        if (start.history.joined && std::abs(g_n) < 1e-9 * N / K)
          result.pressure_by_gap =
            -std::max(stiffness, start.phi_0 * (1. - start.damage) * K);
        if (result.pressure > 0.)
          {
            result.resists = true;
            if (start.frictionless)
              return result;
            const double bonded    = start.history.joined ? start.phi_0 : 0.,
                         rubs      = 1. - bonded * (1. - start.damage);
            result.limit           = mu_b * rubs * result.pressure;
            result.limit_by_gap    = -mu_b * rubs * stiffness;
            result.limit_by_damage = mu_b * bonded * result.pressure;
          }
        return result;
      }

      PointHistory
      advance(const PointStart &start,
              const double      g_n,
              const double      distance) const override
      {
        PointHistory result = InterfaceLaw::advance(start, g_n, distance);
        result.damage       = start.damage;
        return result;
      }

      // Damage is that of the share that is held.
      PointWork
      work(const PointStart &start,
           const double      g_n,
           const double      distance) const override
      {
        PointStart before = start;
        before.damage     = start.history.damage;
        const double L_n  = respond(before, start.history.normal_gap, 0.).limit,
                     L    = respond(start, g_n, distance).limit;
        PointWork result;
        if (!start.frictionless)
          {
            result.friction       = 0.5 * (L_n + L) * distance;
            result.friction_bound = 0.5 * std::abs(L - L_n) * distance;
          }
        return result;
      }

      // The friction of what is broken is constant.
      double
      softening_by_slip(const PointStart &,
                        const double,
                        const double) const override
      {
        return 0.;
      }

      FrictionCoefficient
      reported(const PointHistory &history, const double phi_0) const override
      {
        FrictionCoefficient result;
        result.phi = history.bond_left(phi_0) * (1. - history.damage);
        result.mu  = mu_b;
        return result;
      }

      bool
      is_cohesive() const override
      {
        return true;
      }

      // With q the gap as a multiple of that where damage begins in its
      // direction, and r the same of where it ends, 2 G/(K delta_0^2),
      //
      //   omega = (1 - 1/q) r/(r - 1).
      CohesiveResponse
      hold(const PointStart &start,
           const double      g_n,
           const double      delta_t) const override
      {
        CohesiveResponse result;
        const double     phi_0     = start.history.bond_left(start.phi_0);
        result.damage              = start.history.damage;
        result.stiffness_by_damage = -phi_0 * K;
        const double n = std::max(0., g_n), squared = n * n + delta_t * delta_t,
                     q = std::hypot(n * K / N, delta_t * K / T);
        if (q > 1.)
          {
            double       G_slope;
            const double B     = delta_t * delta_t / squared,
                         G     = energy(B, G_slope);
            const double r     = 2. * G * q * q / (K * squared),
                         omega = (1. - 1. / q) * r / (r - 1.);
            if (omega >= 1.)
              result.damage = 1.;
            else if (omega > result.damage)
              {
                result.damage = omega;
                const auto by = [&](const double gap,
                                    const double strength,
                                    const double B_slope) {
                  const double q_slope =
                                 gap * K * K / (strength * strength * q),
                               r_slope =
                                 r * (G_slope * B_slope / G + 2. * q_slope / q -
                                      2. * gap / squared);
                  return q_slope / (q * q) * r / (r - 1.) -
                         (1. - 1. / q) / ((r - 1.) * (r - 1.)) * r_slope;
                };
                if (n > 0.)
                  result.damage_by_normal = by(n, N, -2. * n * B / squared);
                result.damage_by_tangential =
                  by(delta_t, T, 2. * delta_t * (1. - B) / squared);
              }
          }
        result.stiffness = phi_0 * (1. - result.damage) * K;
        return result;
      }

      double
      length_of_damage() const override
      {
        return std::min(2. * G_I / N, 2. * G_II / T);
      }
      double
      characteristic_distance() const override
      {
        return length_of_damage();
      }

      Tension
      tension() const override
      {
        return {N, G_I, K, softening(), N / K};
      }

      /** The least r of all mixtures of modes: the gap at which nothing is left
       *  over that where damage begins. */
      double
      least_ratio() const
      {
        constexpr unsigned int n_mixtures = 256;
        double                 result     = 2. * G_I * K / (N * N), slope;
        for (unsigned int i = 1; i <= n_mixtures; ++i)
          {
            const double B = static_cast<double>(i) / n_mixtures;
            result         = std::min(result,
                              2. * energy(B, slope) * K *
                                ((1. - B) / (N * N) + B / (T * T)));
          }
        return result;
      }

    private:
      /** The steepest fall of the traction along any straight gap [MPa/mm]:
       *  K/(r - 1), in mode I N / (2 G_I/N - N/K). */
      double
      softening() const
      {
        return K / (least_ratio() - 1.);
      }

      /** G [N/mm] of the criterion, by the share B of the squared gap that lies
       *  along the face; and dG/dB. */
      double
      energy(const double B, double &slope) const
      {
        if (!power_law) // Benzeggagh and Kenane (1996)
          {
            slope = (G_II - G_I) * exponent * std::pow(B, exponent - 1.);
            return G_I + (G_II - G_I) * std::pow(B, exponent);
          }
        const double first = (1. - B) / G_I, second = B / G_II,
                     G = std::pow(std::pow(first, exponent) +
                                    std::pow(second, exponent),
                                  -1. / exponent);
        slope =
          std::pow(G, 1. + exponent) * (std::pow(first, exponent - 1.) / G_I -
                                        std::pow(second, exponent - 1.) / G_II);
        return G;
      }

      const double N, T, G_I, G_II, K, exponent;
      const bool   power_law;
      const double mu_b;
    };



    InterfaceLawPointer
    create(const LawChoice &choice, const InterfaceLawParts &parts)
    {
      const double K = choice.number("Stiffness");
      for (const auto &[energy, strength] :
           {std::array<const char *, 2>{
              {"Fracture energy I", "Normal strength"}},
            std::array<const char *, 2>{
              {"Fracture energy II", "Shear strength"}}})
        {
          const double least = std::pow(choice.number(strength), 2) / (2. * K);
          if (choice.number(energy) <= least)
            throw EntryError(
              std::string("Interface / Mixed mode / ") + energy,
              "a bond would be broken before it is damaged: it must be more "
              "than " +
                std::string(strength) +
                "^2 / (2 Stiffness) = " + to_text(least) + " N/mm",
              choice.text(energy));
        }
      bond_that_opens(parts, "mixed mode");
      const auto law = std::make_shared<MixedMode>(choice, parts);
      if (law->least_ratio() <= 1.)
        throw EntryError("Interface / Mixed mode / Exponent",
                         "under a mixture of modes a bond would be broken "
                         "before it is damaged: expected a smaller one, a "
                         "larger Stiffness or larger fracture energies",
                         choice.text("Exponent"));
      return law;
    }
  } // namespace



  InterfaceLawPlugin
  mixed_mode_interface_law_plugin()
  {
    const std::string   subsection = "Mixed mode";
    const AllowedValues strength   = Allowed::number_between(1e-9, 1e6, "MPa"),
                        energy     = Allowed::number_between(1e-9, 1e6, "N/mm");
    return {
      "mixed mode",
      "a bilinear cohesive law for tension and shear, and friction where it "
      "is broken",
      {{subsection,
        "Normal strength",
        "5",
        strength,
        "N [MPa]: the largest pull across a full bond."},
       {subsection,
        "Shear strength",
        "5",
        strength,
        "T [MPa]: the largest tangential traction on a full bond."},
       {subsection,
        "Fracture energy I",
        "0.05",
        energy,
        "G_I [N/mm]: work per area of complete opening. More than Normal "
        "strength^2 / (2 Stiffness)."},
       {subsection,
        "Fracture energy II",
        "0.1",
        energy,
        "G_II [N/mm]: work per area of complete sliding. More than Shear "
        "strength^2 / (2 Stiffness)."},
       {subsection,
        "Stiffness",
        "2000",
        Allowed::number_between(1e-6, 1e15, "MPa/mm"),
        "K [MPa/mm]: traction per gap before damage, normal and tangential."},
       {subsection,
        "Criterion",
        "benzeggagh-kenane",
        Allowed::choice("benzeggagh-kenane | power law"),
        "How the fracture energies of both modes combine. "
        "`benzeggagh-kenane': G_I + (G_II - G_I) B^Exponent, with B = "
        "delta_t^2 / delta^2. `power law': the energies of both modes, "
        "divided by G_I and G_II and raised to Exponent, add up to 1."},
       {subsection,
        "Exponent",
        "2",
        Allowed::number_between(1, 10, ""),
        "Exponent of the criterion, dimensionless."}},
      create};
  }
} // namespace Debond
