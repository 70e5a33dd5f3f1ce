#include <debond/input/allowed_values.h>
#include <debond/input/entry_table.h>
#include <debond/interface/interface_law.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    // Rough faces climb on each other and shed debris: their distance grows
    // with the slip, by h = h_inf (1 - exp(-g_s/l)), and never falls, as g_s
    // does not,
    //
    //   p = -eps_n (g_n - h(g_s)) while that is positive,  L of this pressure.
    //
    // Of the work of slip L dg_s the part p dh pushes the faces apart: it is
    // stored, and the rest dissipated, which is not negative while h' <= mu.
    class Dilatant : public InterfaceLaw
    {
    public:
      void
      declare(EntryTable &table) override
      {
        table.enter_subsection("Dilatant");
        table.add("Height",
                  h_inf,
                  Allowed::number_between(1e-9, 1e3, "mm")
                    .or_number(0)
                    .without_default(),
                  "h_inf [mm]: distance by which the faces have moved apart "
                  "after long sliding.");
        table.add("Length",
                  l,
                  Allowed::number_between(1e-9, 1e3, "mm").without_default(),
                  "l [mm]: sliding distance over which they move apart, h = "
                  "h_inf (1 - exp(-g_s/l)). Height / Length must not exceed "
                  "the friction coefficient of a debonded point, which "
                  "provides the work (not checked with rate and state).");
        table.leave_subsection();
      }

      // The second law of thermodynamics: what lifts the faces must not be more
      // than what friction takes. The coefficient is that under 1 MPa.
      bool
      initialise() override
      {
        // Climbing takes p dh of the work L dg_s = mu p dg_s: h' = h_inf/l at
        // the start is the steepest, and mu without a bond is what there is in
        // the end.
        if (bone.shears() && bone.shear_wears_bond)
          throw EntryError("Interface / Shear in bone wears bond",
                           "with Law = dilatant faces would climb as bone "
                           "slides: expected false",
                           "true");
        const double least = friction->coefficient({0.}, 0.).mu;
        if (!depends_on_rate() && h_inf > least * l)
          throw EntryError(
            "Interface / Dilatant / Height",
            "the faces would climb by " + to_text(h_inf / l) +
              " mm per mm of slip (Height / Length), more than friction pays "
              "for: the coefficient without a bond is " +
              to_text(least));
        return InterfaceLaw::initialise();
      }

      // Friction under the pressure of the gap that is left between faces that
      // have climbed, Eqs. (28) and (30); as they climb the pressure changes
      // with the slip, too, and the limit with it.
      InterfaceResponse
      answer(const PointStart &start,
             const double      g_n,
             const double      distance) const override
      {
        // h is taken at the end of the step, with the distance that the local
        // problem tries: dp/dd = eps_n h' then enters its derivatives, and
        // sliding under a held gap raises the pressure.
        InterfaceResponse result = InterfaceLaw::answer(start, g_n, distance);
        const double      slip   = slipped(start, distance);
        if (!start.frictionless && distance >= 0.)
          {
            const double rise       = h_inf / l * std::exp(-slip / l); // dh/dd
            result.pressure_by_slip = -result.pressure_by_gap * rise;
            result.limit_by_slip -= result.limit_by_gap * rise;
          }
        return result;
      }

      double
      gap_left(const PointStart &start,
               const double      g_n,
               const double      distance) const override
      {
        return InterfaceLaw::gap_left(start, g_n, distance) -
               height(slipped(start, distance));
      }

      // Only a point that is closed climbs on its way.
      double
      reach(const PointStart &start, const double distance) const override
      {
        // [mm]: faces that have climbed by h touch up to the gap h
        return height(start.history.normal_gap < PointHistory::far ?
                        slipped(start, distance) :
                        start.history.slip) +
               InterfaceLaw::reach(start, distance);
      }

      // The friction of both ends, and the lift by the mean pressure: a
      // trapezoid, as the work of the chuck has it.
      PointWork
      work(const PointStart &start,
           const double      g_n,
           const double      distance) const override
      {
        PointWork result = InterfaceLaw::work(start, g_n, distance);
        result.lift =
          0.5 *
          (pressed(start, start.history.normal_gap, 0.) +
           pressed(start, g_n, distance)) *
          (height(slipped(start, distance)) - height(start.history.slip));
        return result;
      }

    private:
      static double
      slipped(const PointStart &start, const double distance)
      {
        return start.history.slip +
               (start.frictionless ? 0. : std::max(0., distance));
      }

      double
      height(const double slip) const
      {
        // [mm], without loss of digits while g_s is small beside l
        return -h_inf * std::expm1(-slip / l);
      }

      double h_inf = 0.002, l = 0.05; ///< [mm]
    };
  } // namespace



  InterfaceLawPlugin
  dilatant_interface_law_plugin()
  {
    return {"dilatant",
            "friction under pressure between rough faces that move apart as "
            "they slide",
            Dilatant()};
  }
} // namespace Debond
