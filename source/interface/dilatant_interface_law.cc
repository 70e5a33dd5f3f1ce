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
    //   p = -eps_n (g_n - h(g_s)) while that is positive,  L = mu p.
    //
    // Of the work of slip L dg_s the part p dh pushes the faces apart: it is
    // stored, and the rest dissipated, which is not negative while h' <= mu.
    class Dilatant : public InterfaceLaw
    {
    public:
      Dilatant(const double             height,
               const double             length,
               const InterfaceLawParts &parts)
        : InterfaceLaw(parts)
        , h_inf(height)
        , l(length)
      {}

      InterfaceResponse
      respond(const PointStart &start,
              const double      g_n,
              const double      distance) const override
      {
        const FrictionCoefficient mu    = coefficient(start, distance);
        const double              slip  = slipped(start, distance);
        const double              depth = height(slip) - g_n;
        InterfaceResponse         result;
        result.pressure        = stiffness * depth;
        result.pressure_by_gap = -stiffness;
        result.energy          = 0.5 * stiffness * depth * depth;
        if (!start.frictionless && distance >= 0.)
          result.pressure_by_slip = stiffness * slope(slip);
        if (result.pressure > 0.)
          {
            result.resists      = true;
            result.limit        = mu.mu * result.pressure;
            result.limit_by_gap = -mu.mu * stiffness;
            result.limit_by_slip =
              mu.dmu * result.pressure + mu.mu * result.pressure_by_slip;
          }
        return result;
      }

      // Only a point that is closed climbs on its way.
      double
      reach(const PointStart &start, const double distance) const override
      {
        return height(start.history.normal_gap < PointHistory::far ?
                        slipped(start, distance) :
                        start.history.slip);
      }

      PointWork
      work(const PointStart &start,
           const double      g_n,
           const double      distance) const override
      {
        const auto pressure = [&](const double gap, const double slid) {
          return std::max(0., respond(start, gap, slid).pressure);
        };
        const double p     = pressure(start.history.normal_gap, 0.),
                     p_end = pressure(g_n, distance);
        PointWork result   = work_of_friction(start, p, p_end, distance);
        result.lift =
          0.5 * (p + p_end) *
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
        return -h_inf * std::expm1(-slip / l);
      }

      double
      slope(const double slip) const
      {
        return h_inf / l * std::exp(-slip / l);
      }

      const double h_inf, l; ///< [mm]
    };
  } // namespace



  InterfaceLawPlugin
  dilatant_interface_law_plugin()
  {
    const std::string subsection = "Dilatant";
    return {
      "dilatant",
      "friction under pressure between rough faces that move apart as they "
      "slide",
      {{subsection,
        "Height",
        "0.002",
        Allowed::number_between(1e-9, 1e3, "mm").or_number(0),
        "h_inf [mm]: distance by which the faces have moved apart after long "
        "sliding."},
       {subsection,
        "Length",
        "0.05",
        Allowed::number_between(1e-9, 1e3, "mm"),
        "l [mm]: sliding distance over which they move apart, h = h_inf (1 - "
        "exp(-g_s/l)). Height / Length must not exceed the friction "
        "coefficient of a debonded point, which provides the work (not checked "
        "with rate and state)."}},
      [](const LawChoice &choice, const InterfaceLawParts &parts) {
        const double height = choice.number("Height"),
                     length = choice.number("Length"),
                     least  = parts.friction->mu_without_bond();
        if (!parts.depends_on_rate() && height > least * length)
          throw EntryError(
            "Interface / Dilatant / Height",
            "the faces would climb by " + to_text(height / length) +
              " mm per mm of slip (Height / Length), more than "
              "friction pays for: the coefficient without a bond "
              "is " +
              to_text(least));
        return InterfaceLawPointer(
          std::make_shared<Dilatant>(height, length, parts));
      }};
  }
} // namespace Debond
