#include <debond/interface/interface_law.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    // Eq. (28) along the normal, t_n = eps_n g_n n: a spring that pushes, p =
    // -eps_n g_n > 0, while g_n < 0; and Eq. (30), L = mu p. The compliance
    // 1/eps_n is a property of the interface, not a numerical device: in the
    // paper's test it is most of the compliance of the whole.
    class FrictionUnderPressure : public InterfaceLaw
    {
    public:
      using InterfaceLaw::InterfaceLaw;

      InterfaceResponse
      respond(const PointStart &start,
              const double      g_n,
              const double      distance) const override
      {
        const FrictionCoefficient c = coefficient(start, distance);
        InterfaceResponse         result;
        result.pressure        = -stiffness * g_n;
        result.pressure_by_gap = -stiffness;
        result.energy          = 0.5 * stiffness * g_n * g_n; // the potential
        if (result.pressure > 0.)
          {
            result.resists       = true;
            result.limit         = c.mu * result.pressure;
            result.limit_by_gap  = -c.mu * stiffness;
            result.limit_by_slip = c.dmu * result.pressure;
          }
        return result;
      }

      // The law is integrated over the distance, with the pressure between its
      // two ends. Of the friction the bond has its part, int (mu - mu_b) dg_s:
      // D_adh, which tells what the adhesion costs without reading it off the
      // torque curve as Eq. (20) does. What the mean pressure can be wrong by,
      // and a speed that changes within the step, keeps a fast but stable fall
      // from being reported as a jump.
      PointWork
      work(const PointStart &start,
           const double      g_n,
           const double      distance) const override
      {
        if (start.frictionless)
          return {};
        const FrictionState state = start.friction();
        const double p = std::max(0., -stiffness * start.history.normal_gap),
                     p_end = std::max(0., -stiffness * g_n),
                     mean  = 0.5 * (p + p_end),
                     per_pressure =
                       friction->friction_strength(state, distance);
        PointWork result;
        result.friction = mean * per_pressure;
        result.friction_bound =
          0.5 * std::abs(p - p_end) * per_pressure +
          mean * friction->strength_bound(state, distance);
        result.adhesive = mean * friction->adhesive_strength(state, distance);
        return result;
      }

      // -dmu/dg_s where it is largest, from the accepted g_s on, times p.
      double
      softening_by_slip(const PointStart &start,
                        const double      pressure,
                        const double      distance) const override
      {
        return friction->steepest_fall(start.friction(), distance) *
               std::max(0., pressure);
      }
    };
  } // namespace



  InterfaceLawPointer
  friction_under_pressure(const InterfaceLawParts &parts)
  {
    return std::make_shared<FrictionUnderPressure>(parts);
  }



  // That of the paper.
  InterfaceLawPlugin
  friction_interface_law_plugin()
  {
    return {"friction",
            "friction under pressure, without strength in tension (the paper)",
            {},
            [](const LawChoice &, const InterfaceLawParts &parts) {
              return friction_under_pressure(parts);
            }};
  }
} // namespace Debond
