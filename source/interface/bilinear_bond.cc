#include <debond/input/allowed_values.h>
#include <debond/input/entry_table.h>
#include <debond/interface/bilinear_bond.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>

// A bond between two places. Unlike that of Eq. (13), which knows the
// accumulated sliding distance, it knows the gap between the places that were
// bonded: pulled along the face and back again it is as whole as before. Damage
// makes it softer, and unloads to the origin.
namespace Debond
{
  void
  BilinearBond::declare(EntryTable &table)
  {
    const AllowedValues
      strength = Allowed::number_between(1e-9, 1e6, "MPa").without_default(),
      work     = Allowed::number_between(1e-9, 1e6, "N/mm").without_default();
    // Strength, work and stiffness are the triangle of each of both modes;
    // Criterion and Exponent say which work lies between them.
    table.enter_subsection("Mixed mode");
    table.add("Normal strength",
              N,
              strength,
              "N [MPa]: the largest pull across a full bond.");
    table.add("Shear strength",
              T,
              strength,
              "T [MPa]: the largest tangential traction on a full bond.");
    table.add("Fracture energy I",
              G_I,
              work,
              "G_I [N/mm]: work per area of complete opening. More than Normal "
              "strength^2 / (2 Stiffness).");
    table.add("Fracture energy II",
              G_II,
              work,
              "G_II [N/mm]: work per area of complete sliding. More than Shear "
              "strength^2 / (2 Stiffness).");
    table.add(
      "Stiffness",
      K,
      Allowed::number_between(1e-6, 1e15, "MPa/mm").without_default(),
      "K [MPa/mm]: traction per gap before damage, normal and tangential.");
    table.add("Criterion",
              power_law,
              Allowed::choice("benzeggagh-kenane | power law"),
              "How the fracture energies of both modes combine. "
              "`benzeggagh-kenane': G_I + (G_II - G_I) B^n, with B = "
              "delta_t^2 / delta^2. `power law': the energies of both modes, "
              "divided by G_I and G_II and raised to n, add up to 1. n: "
              "Expert / Interface / Mixed mode / Exponent.");
    table.add("Expert / Exponent",
              exponent,
              Allowed::number_between(1, 10, ""),
              "Exponent of the criterion, dimensionless.");
    table.leave_subsection();
  }



  // The triangle of traction over gap must have room for its falling side: its
  // area is the fracture energy, and its rising side has that of strength and
  // stiffness. In between the modes least_ratio() asks for the same.
  void
  BilinearBond::check() const
  {
    const auto check_mode = [this](const std::string &mode,
                                   const double       work,
                                   const std::string &strength_name,
                                   const double       strength) {
      // work that is stored when damage begins, at delta_0 = strength/K [N/mm]
      const double least = strength * strength / (2. * K);
      if (work <= least)
        throw EntryError("Interface / Mixed mode / Fracture energy " + mode,
                         "a bond would be broken before it is damaged: it must "
                         "be more than " +
                           strength_name +
                           "^2 / (2 Stiffness) = " + to_text(least) + " N/mm",
                         entry_text(work));
    };
    check_mode("I", G_I, "Normal strength", N);
    check_mode("II", G_II, "Shear strength", T);
    if (least_ratio() <= 1.)
      throw EntryError("Expert / Interface / Mixed mode / Exponent",
                       "under a mixture of modes a bond would be broken "
                       "before it is damaged: expected a smaller one, a "
                       "larger Stiffness or larger fracture energies",
                       entry_text(exponent));
  }



  // With q the gap as a multiple of that where damage begins in its direction,
  // and r the same of where it ends, 2 G/(K delta_0^2),
  //
  //   omega = (1 - 1/q) r/(r - 1).
  //
  // Damage is taken from the gap at the end of the step, as phi in Eq. (13)
  // from the distance: implicit, with its derivatives for Newton's method. Of a
  // gap that closes only the part along the face counts.
  CohesiveResponse
  BilinearBond::hold(const PointStart &start,
                     const double      g_n,
                     const double      delta_t) const
  {
    CohesiveResponse result;
    const double     phi_0 = start.bond_left();
    // Damage never falls: that of the beginning of the step is the least. What
    // is left carries t = phi_0 (1 - omega) K delta, straight from the origin.
    result.damage              = start.history.damage;
    result.stiffness_by_damage = -phi_0 * K;
    const double n = std::max(0., g_n), squared = n * n + delta_t * delta_t,
                 q = std::hypot(n * K / N, delta_t * K / T);
    if (q > 1.)
      {
        // q > 1 is beyond the quadratic criterion (t_n/N)^2 + (t_t/T)^2 = 1 of
        // the undamaged bond. B is the share of mode II in the direction of the
        // gap, on which both G and delta_0 depend; along one direction the law
        // is the triangle of that mixture.
        double       G_slope;
        const double B = delta_t * delta_t / squared, G = energy(B, G_slope);
        const double r     = 2. * G * q * q / (K * squared),
                     omega = (1. - 1. / q) * r / (r - 1.);
        if (omega >= 1.)
          result.damage = 1.;
        else if (omega > result.damage)
          {
            result.damage = omega;
            // by a part of the gap, with which B changes by B_slope
            const auto by = [&](const double gap,
                                const double strength,
                                const double B_slope) {
              // chain rule through q and r = 2 G q^2/(K delta^2)
              const double q_slope = gap * K * K / (strength * strength * q),
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



  // 2 G/T is where the triangle ends. A path of equilibrium is measured by
  // damage times a length, so that its steps are as fine as those of bonds that
  // slip wears.
  double
  BilinearBond::length_of_damage() const
  {
    return std::min(2. * G_I / N, 2. * G_II / T);
  }



  // The traction falls by K/(r - 1) along a straight gap [MPa/mm], in mode I by
  // N / (2 G_I/N - N/K).
  Tension
  BilinearBond::tension() const
  {
    return {N, G_I, K, K / (least_ratio() - 1.), N / K};
  }



  // r, the gap at which nothing is left over that where damage begins, is least
  // for some mixture of modes.
  double
  BilinearBond::least_ratio() const
  {
    // Sampled over the mixtures, as there is no closed form with either
    // criterion.
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



  // G [N/mm] of the criterion, by the share B of the squared gap that lies
  // along the face; and dG/dB.
  double
  BilinearBond::energy(const double B, double &slope) const
  {
    if (!power_law) // Benzeggagh and Kenane (1996)
      {
        slope = (G_II - G_I) * exponent * std::pow(B, exponent - 1.);
        return G_I + (G_II - G_I) * std::pow(B, exponent);
      }
    // power law: (G_1/G_I)^a + (G_2/G_II)^a = 1 with G_1 = (1 - B) G and G_2 =
    // B G
    const double first = (1. - B) / G_I, second = B / G_II,
                 G = std::pow(std::pow(first, exponent) +
                                std::pow(second, exponent),
                              -1. / exponent);
    slope =
      std::pow(G, 1. + exponent) * (std::pow(first, exponent - 1.) / G_I -
                                    std::pow(second, exponent - 1.) / G_II);
    return G;
  }
} // namespace Debond
