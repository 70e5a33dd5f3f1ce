#include <debond/input/allowed_values.h>
#include <debond/input/entry_table.h>
#include <debond/interface/interface_law.h>

#include <deal.II/base/quadrature_lib.h>

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
    //   L = L(max(0, p + c phi t_0), phi)
    //
    // with kappa the largest gap since the point has been closed: on the
    // envelope while the gap grows, else straight to the origin. A viscosity
    // eta pulls beside that with phi_0 s eta dg_n/dt while a bond opens.
    class Adhesive : public InterfaceLaw
    {
    public:
      void
      declare(EntryTable &table) override
      {
        table.enter_subsection("Adhesive");
        table.add("Strength",
                  t_0,
                  Allowed::number_between(1e-9, 1e6, "MPa")
                    .or_number(0)
                    .without_default(),
                  "t_0 [MPa]: the largest pull across a full bond. 0: as Law = "
                  "friction.");
        table.add("Gap at strength",
                  g_0,
                  Allowed::number_between(1e-9, 1e3, "mm").without_default(),
                  "g_0 [mm]: gap at the largest pull. The work of adhesion is "
                  "e t_0 g_0 [N/mm], the initial stiffness of the bond e t_0 / "
                  "g_0.");
        table.add("Adhesive friction",
                  c,
                  Allowed::number_between(0, 1, ""),
                  "c, dimensionless: share of the strength that is added to "
                  "the pressure in friction, mu (p + c phi t_0).");
        table.add("Expert / Opening viscosity",
                  eta,
                  Allowed::number_between(1e-15,
                                          1e15,
                                          "MPa per (mm per unit of time)")
                    .or_number(0),
                  "eta [MPa per (mm per unit of time)]: a bond that opens with "
                  "the speed v has an additional pull of phi eta v. A bond "
                  "that would open in a jump opens in time instead, and "
                  "results depend on the rate.");
        table.leave_subsection();
      }

      bool
      initialise() override
      {
        // Without a strength nothing holds the faces together: the law of the
        // paper is taken in its place, which spares each point the
        // exponentials.
        if (t_0 == 0.)
          return false;
        require_bond("adhesive");
        // Of a full bond: sigma_e is largest at g_0, its area is e t_0 g_0, and
        // its slope at 0 is e t_0/g_0. The fall -dsigma_e/dx = t_0/g_0 (x/g_0 -
        // 1) exp(1 - x/g_0) is steepest at x = 2 g_0, t_0/(e g_0): where the
        // bodies resist less than that, the bond opens in a jump.
        tension = {
          t_0, M_E * t_0 * g_0, M_E * t_0 / g_0, t_0 / (M_E * g_0), g_0, eta};
        characteristic_distance =
          std::min(g_0, friction->characteristic_distance);
        return true;
      }

      // In the place of Eqs. (28) and (30). Both p and L follow the bond, which
      // is that at the end of the step: opening damages it by kappa, slip by s,
      // and each softens what the other one meets.
      InterfaceResponse
      answer(const PointStart &start,
             const double      gap,
             const double      distance) const override
      {
        const double g_n = gap_left(start, gap, distance);
        // kappa follows the gap at the end of the step while that grows: the
        // damage is implicit, as is that by slip, so that no step lags behind
        // the one before.
        const bool is_held      = holds(start.history, start.phi_0),
                   grows        = is_held && g_n > start.history.damage;
        const double      kappa = grows ? g_n : start.history.damage;
        const Changing    s     = bond_after(start, distance); // phi_0 s
        InterfaceResponse result;
        if (g_n > 0. && is_held)
          {
            // on the envelope K falls as the gap grows, dK/dg_n = -K/g_0
            const double K          = s[0] * pull(kappa);
            result.pressure         = -K * g_n;
            result.pressure_by_gap  = -K * (grows ? 1. - g_n / g_0 : 1.);
            result.pressure_by_slip = -s[2] * pull(kappa) * g_n;
            // what is given up at the end of the step has become damage
            result.energy = kappa > gone() ? 0. : 0.5 * K * g_n * g_n;
          }
        else
          {
            const BoneLayer::Push push = this->push(start, gap, distance);
            result.pressure            = push.pressure;
            result.pressure_by_gap     = push.by_gap;
            if (g_n < 0.)
              result.energy = push.energy;
          }
        // Pressure and pull have the one value 0 at g_n = 0, but not one slope:
        // eps_n on one side, phi K on the other.
        // The tangent of faces that touch, whichever way they will go: with the
        // softer one the first correction may go beyond the largest pull.
        if (is_held && std::abs(g_n) < touching * g_0)
          result.pressure_by_gap = -std::max(stiffness, s[0] * pull(kappa));
        // not by what p and L are at the end: that would be a jump within the
        // step
        result.resists = is_held || result.pressure > 0.;
        // d = x exp(1 - x) beyond g_0
        // phi = phi_0 s d as Eq. (13) has it with a bond that opening wears,
        // too, and what presses for friction, p + c phi t_0: pulled faces rub
        // on as long as they hold. Both with their derivatives by gap and
        // distance, which rub() chains with those of the friction law.
        const double   d = left(kappa), by_kappa = grows && kappa > g_0 ?
                                                     d * (1. / kappa - 1. / g_0) :
                                                     0.;
        const Changing phi(s[0] * d, s[0] * by_kappa, s[2] * d),
          pressed = Changing(result.pressure,
                             result.pressure_by_gap,
                             result.pressure_by_slip) +
                    c * t_0 * phi;
        // it is zero beyond g_0 for c = 1, but for rounding
        if (pressed[0] >
            1e-14 * std::max(std::abs(result.pressure), c * t_0 * phi[0]))
          rub(start, distance, pressed, phi, result);
        if (is_held)
          add_viscosity(start, g_n, phi, result);
        return result;
      }

      // A bond that holds is carried however wide it is open, until its
      // history says that it is gone.
      double
      reach(const PointStart &start, const double) const override
      {
        return holds(start.history, start.phi_0) ?
                 std::numeric_limits<double>::infinity() :
                 InterfaceLaw::reach(start, 0.);
      }

      // The first closing is what glues the faces: a gap before that has
      // damaged nothing.
      PointHistory
      advance(const PointStart &start,
              const double      g_n,
              const double      distance) const override
      {
        PointHistory result = InterfaceLaw::advance(start, g_n, distance);
        if (start.history.joined)
          result.damage =
            std::max(start.history.damage, gap_left(start, g_n, distance));
        // Beyond gone() the bond is given up for good: what is left of the
        // exponential would hold points together that no instrument could tell
        // from open ones.
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
           const double      gap,
           const double      distance) const override
      {
        // Per area of the point [N/mm]. Friction and damage are accounted for
        // apart, so that D_adh is the part that broke the bond.
        const double before_step = start.history.normal_gap,
                     g_start     = gap_left(start, before_step, 0.),
                     g_n         = gap_left(start, gap, distance);
        PointWork result;
        if (!start.frictionless && distance > 0.)
          {
            const double before =
                           integrated_limit(start, before_step, distance),
                         after    = integrated_limit(start, gap, distance);
            result.friction       = 0.5 * (before + after);
            result.friction_bound = 0.5 * std::abs(before - after);
          }
        if (holds(start.history, start.phi_0))
          {
            const double kappa_n = std::max(start.history.damage, g_start),
                         kappa   = std::max(start.history.damage, g_n),
                         s_n     = bond_after(start, 0.)[0],
                         s       = bond_after(start, distance)[0],
                         e_n = stored(kappa_n, g_start), e = stored(kappa, g_n);
            result.damage = 0.5 * (s_n + s) * (spent(kappa) - spent(kappa_n)) -
                            0.5 * (s - s_n) * (e_n + e);
            if (kappa > gone()) // nothing gives the rest back
              result.damage += s * e;
          }
        result.adhesive = result.damage;
        if (!start.frictionless)
          for (const auto &[at, slid] :
               {std::pair(before_step, 0.), std::pair(gap, distance)})
            {
              const InterfaceResponse end = answer(start, at, slid);
              const double            unbonded =
                end.pressure > 0. ?
                             friction->limit(start, 0., end.pressure, slid).value :
                             0.;
              result.adhesive += 0.5 * (end.limit - unbonded) * distance;
            }
        return result;
      }

      // As p + c phi t_0 <= p + c t_0; that the pull falls with the bond raises
      // L. Where dL/dp falls with the pressure that of now counts, too: of what
      // is to come it is no bound then.
      double
      softening_by_slip(const PointStart &start,
                        const double      pressure,
                        const double      distance) const override
      {
        // A bound of -dL/dd = dL/dphi dphi/dd + dL/dp c t_0 dphi/dd for all
        // that is still to come in this step, with the steepest s' from g_s on
        // and the most that can press. It is compared with eps_t, see
        // InterfaceLaw::softening_by_slip().
        const double bonded = start.bond_left() * left(start.history.damage),
                     slip = start.history.slip, held = c * t_0,
                     now = pressure + held * bonded *
                                        friction->decay(slip + distance).value,
                     most = std::max(0., pressure) + held;
        if (!(most > 0.))
          return 0.;
        const FrictionLimit L = friction->limit(start, 1., most, distance);
        double              by_pressure = L.by_pressure;
        if (now > 0.)
          by_pressure =
            std::max(by_pressure,
                     friction->limit(start, 1., now, distance).by_pressure);
        return bonded * friction->decay(slip).steepest *
               std::max(0., L.by_bond + held * by_pressure);
      }

      FrictionCoefficient
      reported(const PointHistory &history,
               const double        phi_0,
               const double        pressure) const override
      {
        const double d   = left(history.damage),
                     phi = history.bond_left(phi_0) * d *
                           friction->decay(history.slip).value;
        return InterfaceLaw::reported(history,
                                      phi_0 * d,
                                      pressure + c * phi * t_0);
      }

    private:
      /** A pull by the speed of opening, beside the rest. What begins to move,
       *  whichever way, has the tangent of what opens. */
      void
      add_viscosity(const PointStart  &start,
                    const double       g_n,
                    const Changing    &phi,
                    InterfaceResponse &response) const
      {
        // The speed is the mean one of the step, (g_n - g_n^n)/dt, of the open
        // part of the gap only: faces that are pressed have none. A pull that
        // would fall faster than the bodies unload so takes a time that grows
        // with eta.
        const double before =
                       std::max(0.,
                                gap_left(start, start.history.normal_gap, 0.)),
                     moved  = before < PointHistory::far ? g_n - before : 0.,
                     opened = std::max(0., moved);
        if (!(start.duration > 0.) || std::min(g_n, moved) <= -touching * g_0)
          return;
        const double resistance   = eta / start.duration;
        response.viscous_pressure = -phi[0] * resistance * opened;
        response.pressure += response.viscous_pressure;
        response.pressure_by_gap -= resistance * (phi[0] + phi[1] * opened);
        response.pressure_by_slip -= resistance * phi[2] * opened;
      }

      /** Integral of L over the @p distance at a gap, by Simpson's rule [N/mm].
       */
      double
      integrated_limit(const PointStart &start,
                       const double      g_n,
                       const double      distance) const
      {
        // L at a fixed gap is smooth in the distance but for where the decay of
        // the bond begins and ends, whose places the law does not say.
        static const dealii::QIterated<1> simpson(dealii::QSimpson<1>(), 16);
        double                            mean = 0.;
        for (unsigned int q = 0; q < simpson.size(); ++q)
          mean += simpson.weight(q) *
                  answer(start, g_n, distance * simpson.point(q)[0]).limit;
        return mean * distance;
      }

      /** True if a point with this history is bonded. */
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
        // W(kappa) = integral of sigma_e from 0 to kappa, less K kappa^2/2,
        // which unloading gives back: of small openings, which are elastic,
        // nothing is spent but what is of third order.
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

      static constexpr double touching = 1e-9; ///< in parts of g_0

      double t_0 = 5, g_0 = 0.005; ///< [MPa], [mm]
      double c = 1, eta = 0; ///< dimensionless, [MPa per (mm per unit of time)]
    };
  } // namespace



  InterfaceLawPlugin
  adhesive_interface_law_plugin()
  {
    return {
      "adhesive",
      "a bond with strength in tension, exponential and irreversible, that also "
      "adds to friction",
      Adhesive()};
  }
} // namespace Debond
