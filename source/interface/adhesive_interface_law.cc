#include <debond/interface/bond_friction.h>
#include <debond/interface/interface_law.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Debond
{
  namespace
  {
    // A bond with strength in tension, exponential, irreversible, and with
    // friction of its own: after Immel, Nguyen, Haiat and Sauer (2022) and
    // Mergel, Scheibert and Sauer (2021). doc/explanation/adhesion.md,
    // Adhesive.
    //
    //   sigma_e(x) = t_0 x/g_0 exp(1 - x/g_0)    envelope of the pull
    //   d(kappa) = 1 up to g_0, then sigma_e(kappa)/t_0
    //   phi = phi_0 s(g_s) d(kappa)
    //   p = -eps_n g_n                           for g_n <= 0
    //   p = -phi_0 s K g_n, K = sigma_e(kappa)/kappa     for g_n > 0
    //   L = mu(phi) max(0, p + c phi t_0)
    //
    // with kappa the largest gap since the point has been closed: on the
    // envelope while the gap grows, else straight to the origin. A viscosity
    // eta pulls beside that with phi_0 s eta dg_n/dt while a bond opens.
    class Adhesive : public InterfaceLaw
    {
    public:
      Adhesive(const LawChoice                    &choice,
               const InterfaceLawParts            &parts,
               std::shared_ptr<const BondFriction> bond)
        : InterfaceLaw(parts)
        , t_0(choice.number("Strength"))
        , g_0(choice.number("Gap at strength"))
        , c(choice.number("Adhesive friction"))
        , eta(choice.number("Opening viscosity"))
        , bond(std::move(bond))
      {}

      InterfaceResponse
      respond(const PointStart &start,
              const double      g_n,
              const double      distance) const override
      {
        const Bond        now(*this, start, g_n, distance);
        InterfaceResponse result = without_viscosity(start, now, g_n);
        // what begins to move, whichever way, has the tangent of what opens
        const double before = std::max(0., start.history.normal_gap),
                     moved  = before < PointHistory::far ? g_n - before : 0.,
                     opened = std::max(0., moved);
        if (now.holds && start.duration > 0. &&
            std::min(g_n, moved) > -touching * g_0)
          {
            const double resistance = eta / start.duration;
            result.viscous_pressure = -now.phi * resistance * opened;
            result.pressure += result.viscous_pressure;
            result.pressure_by_gap -=
              resistance * (now.phi + now.phi_by_gap * opened);
            result.pressure_by_slip -= resistance * now.phi_by_slip * opened;
          }
        return result;
      }

      // A bond that holds is carried however wide it is open, until its
      // history says that it is gone.
      double
      reach(const PointStart &start, const double) const override
      {
        return holds(start.history, start.phi_0) ?
                 std::numeric_limits<double>::infinity() :
                 0.;
      }

      PointHistory
      advance(const PointStart &start,
              const double      g_n,
              const double      distance) const override
      {
        PointHistory result = InterfaceLaw::advance(start, g_n, distance);
        if (start.history.joined)
          result.damage = std::max(start.history.damage, g_n);
        result.broken = start.history.broken || result.damage > gone();
        return result;
      }

      // Only the edge of the master opens a point that is bonded: the bond is
      // torn.
      PointHistory
      open(const PointHistory &history) const override
      {
        PointHistory result = InterfaceLaw::open(history);
        result.broken       = history.broken || history.joined;
        return result;
      }

      // Friction is integrated over the distance, between the gaps of both
      // ends; D_adh takes a trapezoid. A bond of the strength phi_0 s that is
      // opened up to kappa has taken W(kappa), less what it gives back, and one
      // that is open loses what it stores as slip breaks it. With both at a
      // time the mean: exact if one of them rests, never negative.
      PointWork
      work(const PointStart &start,
           const double      g_n,
           const double      distance) const override
      {
        const double            g_start = start.history.normal_gap;
        const InterfaceResponse begin   = respond(start, g_start, 0.),
                                end     = respond(start, g_n, distance);
        PointWork result;
        if (!start.frictionless && distance > 0.)
          {
            const double before   = integrated_limit(start, g_start, distance),
                         after    = integrated_limit(start, g_n, distance);
            result.friction       = 0.5 * (before + after);
            result.friction_bound = 0.5 * std::abs(before - after);
          }
        const Bond before(*this, start, g_start, 0.),
          now(*this, start, g_n, distance);
        if (now.holds)
          {
            const double e_n = stored(before.kappa, g_start),
                         e   = stored(now.kappa, g_n);
            result.damage    = 0.5 * (before.phi_0_s + now.phi_0_s) *
                              (spent(now.kappa) - spent(before.kappa)) -
                            0.5 * (now.phi_0_s - before.phi_0_s) * (e_n + e);
            if (now.kappa > gone()) // nothing gives the rest back
              result.damage += now.phi_0_s * e;
          }
        const double pressed =
          0.5 * (std::max(0., begin.pressure) + std::max(0., end.pressure));
        result.adhesive =
          result.damage +
          (start.frictionless ?
             0. :
             (0.5 * (begin.limit + end.limit) - bond->mu_b * pressed) *
               distance);
        return result;
      }

      // As p + c phi t_0 <= p + c t_0; that the pull falls with the bond raises
      // L.
      double
      softening_by_slip(const PointStart &start,
                        const double      pressure,
                        const double) const override
      {
        const PointHistory &history = start.history;
        const double        mu_ub   = bond->mu_b + bond->drop;
        return history.bond_left(start.phi_0) * left(history.damage) *
               bond->steepest_decay(history.slip) *
               std::max(0.,
                        bond->drop * (std::max(0., pressure) + c * t_0) +
                          mu_ub * c * t_0);
      }

      FrictionCoefficient
      reported(const PointHistory &history, const double phi_0) const override
      {
        double              slope;
        FrictionCoefficient result;
        result.phi = history.bond_left(phi_0) * left(history.damage) *
                     bond->decay(history.slip, slope);
        result.mu = bond->mu_b + result.phi * bond->drop;
        return result;
      }

      // it falls steepest at 2 g_0
      Tension
      tension() const override
      {
        return {
          t_0, M_E * t_0 * g_0, M_E * t_0 / g_0, t_0 / (M_E * g_0), g_0, eta};
      }
      double
      opened(const PointHistory &history) const override
      {
        return history.damage;
      }
      double
      characteristic_distance() const override
      {
        return std::min(g_0, bond->characteristic_distance());
      }

    private:
      /** The bond of a point at the end of a step. */
      struct Bond
      {
        Bond(const Adhesive   &law,
             const PointStart &start,
             const double      g_n,
             const double      distance)
          : holds(law.holds(start.history, start.phi_0))
          , grows(holds && g_n > start.history.damage)
          , kappa(grows ? g_n : start.history.damage)
        {
          const double slip = start.frictionless ? 0. : std::max(0., distance);
          double       s_by_slip;
          phi_0_s = start.history.bond_left(start.phi_0) *
                    law.bond->decay(start.history.slip + slip, s_by_slip);
          const bool moves = !start.frictionless && distance >= 0.;
          s_slope =
            moves ? start.history.bond_left(start.phi_0) * s_by_slip : 0.;
          const double d = law.left(kappa);
          phi            = phi_0_s * d;
          phi_by_slip    = s_slope * d;
          // d = x exp(1 - x) beyond g_0
          phi_by_gap =
            grows && kappa > law.g_0 ? phi * (1. / kappa - 1. / law.g_0) : 0.;
        }

        bool   holds;                        ///< in tension, too
        bool   grows;                        ///< opens further than it has been
        double kappa;                        ///< [mm]
        double phi_0_s, s_slope;             ///< by the distance
        double phi, phi_by_slip, phi_by_gap; ///< [1, 1/mm, 1/mm]
      };

      /** What is not made up by speed. */
      InterfaceResponse
      without_viscosity(const PointStart &start,
                        const Bond       &now,
                        const double      g_n) const
      {
        InterfaceResponse result;
        if (g_n > 0. && now.holds)
          {
            // on the envelope K falls as the gap grows, dK/dg_n = -K/g_0
            const double K          = now.phi_0_s * pull(now.kappa);
            result.pressure         = -K * g_n;
            result.pressure_by_gap  = -K * (now.grows ? 1. - g_n / g_0 : 1.);
            result.pressure_by_slip = -now.s_slope * pull(now.kappa) * g_n;
            // what is given up at the end of the step has become damage
            result.energy = now.kappa > gone() ? 0. : 0.5 * K * g_n * g_n;
          }
        else
          {
            result.pressure        = -stiffness * g_n;
            result.pressure_by_gap = -stiffness;
            if (g_n < 0.)
              result.energy = 0.5 * stiffness * g_n * g_n;
          }
        // The tangent of faces that touch, whichever way they will go: with the
        // softer one the first correction may go beyond the largest pull.
        if (now.holds && std::abs(g_n) < touching * g_0)
          result.pressure_by_gap =
            -std::max(stiffness, now.phi_0_s * pull(now.kappa));
        // not by what p and L are at the end: that would be a jump within the
        // step
        result.resists = now.holds || result.pressure > 0.;
        if (start.frictionless)
          return result;
        // what is pressed, or held, across the interface
        const double cohesion = c * now.phi * t_0,
                     held     = result.pressure + cohesion;
        if (held > rounding * std::max(std::abs(result.pressure), cohesion))
          {
            const double mu    = bond->mu_b + now.phi * bond->drop,
                         slope = bond->drop * held + mu * c * t_0; // by phi
            result.limit       = mu * held;
            result.limit_by_gap =
              mu * result.pressure_by_gap + slope * now.phi_by_gap;
            result.limit_by_slip =
              mu * result.pressure_by_slip + slope * now.phi_by_slip;
          }
        return result;
      }

      /** Integral of L over the @p distance at a gap, by Simpson's rule [N/mm].
       */
      double
      integrated_limit(const PointStart &start,
                       const double      g_n,
                       const double      distance) const
      {
        constexpr unsigned int n   = 32;
        double                 sum = 0.;
        for (unsigned int i = 0; i <= n; ++i)
          sum += (i == 0 || i == n ? 1. :
                  i % 2 == 1       ? 4. :
                                     2.) *
                 respond(start, g_n, distance * i / n).limit;
        return sum * distance / (3. * n);
      }

      /** Whether a point with this history is bonded. */
      bool
      holds(const PointHistory &history, const double phi_0) const
      {
        return history.joined && !history.broken && phi_0 > 0.;
      }

      /** K [MPa/mm]. */
      double
      pull(const double kappa) const
      {
        return t_0 / g_0 * std::exp(1. - kappa / g_0);
      }

      /** d: what opening has left. */
      double
      left(const double kappa) const
      {
        return kappa <= g_0 ? 1. : kappa / g_0 * std::exp(1. - kappa / g_0);
      }

      /** Stored in the gap at the full bond [N/mm]. */
      double
      stored(const double kappa, const double g_n) const
      {
        const double g = std::max(0., g_n);
        return g < PointHistory::far ? 0.5 * pull(kappa) * g * g : 0.;
      }

      /** The work up to kappa, less what is stored there [N/mm]. */
      double
      spent(const double kappa) const
      {
        const double x = kappa / g_0;
        return -std::exp(1.) * t_0 * g_0 *
               (std::expm1(-x) + (x + 0.5 * x * x) * std::exp(-x));
      }

      /** From here on 1e-7 of the strength and 4e-8 of the work are left, which
       *  nobody misses [mm]. */
      double
      gone() const
      {
        return 20. * g_0;
      }

      // of p + c phi t_0, which is zero beyond g_0 for c = 1
      static constexpr double rounding = 1e-14;
      // in parts of g_0
      static constexpr double touching = 1e-9;

      const double                              t_0, g_0, c, eta;
      const std::shared_ptr<const BondFriction> bond;
    };
  } // namespace



  InterfaceLawPlugin
  adhesive_interface_law_plugin()
  {
    const std::string subsection = "Adhesive";
    return {
      "adhesive",
      "a bond with strength in tension, exponential and irreversible, that also "
      "adds to friction",
      {{subsection,
        "Strength",
        "5",
        Allowed::number_between(1e-9, 1e6, "MPa").or_number(0),
        "t_0 [MPa]: the largest pull across a full bond. 0: as Law = "
        "friction."},
       {subsection,
        "Gap at strength",
        "0.005",
        Allowed::number_between(1e-9, 1e3, "mm"),
        "g_0 [mm]: gap at the largest pull. The work of adhesion is e t_0 "
        "g_0 [N/mm], the initial stiffness of the bond e t_0 / g_0."},
       {subsection,
        "Adhesive friction",
        "1",
        Allowed::number_between(0, 1, ""),
        "c, dimensionless: share of the strength that is added to the "
        "pressure in friction, mu (p + c phi t_0)."},
       {subsection,
        "Opening viscosity",
        "0",
        Allowed::number_between(1e-15, 1e15, "MPa per (mm per unit of time)")
          .or_number(0),
        "eta [MPa per (mm per unit of time)]: a bond that opens with the "
        "speed v has an additional pull of phi eta v. A bond that would open "
        "in a jump opens in time instead, and results depend on the rate."}},
      [](const LawChoice &choice, const InterfaceLawParts &parts) {
        if (choice.number("Strength") == 0.)
          return friction_under_pressure(parts);
        return InterfaceLawPointer(std::make_shared<Adhesive>(
          choice, parts, bond_that_opens(parts, "adhesive")));
      }};
  }
} // namespace Debond
