#include <debond/interface/interface_law.h>

#include <algorithm>

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
        InterfaceResponse result;
        result.pressure        = -stiffness * g_n;
        result.pressure_by_gap = -stiffness;
        result.energy          = 0.5 * stiffness * g_n * g_n; // the potential
        if (result.pressure > 0.)
          {
            const FrictionCoefficient c = coefficient(start, distance);
            result.resists              = true;
            result.limit                = c.mu * result.pressure;
            result.limit_by_gap         = -c.mu * stiffness;
            result.limit_by_slip        = c.dmu * result.pressure;
          }
        return result;
      }

      PointWork
      work(const PointStart &start,
           const double      g_n,
           const double      distance) const override
      {
        return work_of_friction(start,
                                std::max(0.,
                                         -stiffness * start.history.normal_gap),
                                std::max(0., -stiffness * g_n),
                                distance);
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
            "friction under pressure, no strength in tension (the paper)",
            {},
            [](const LawChoice &, const InterfaceLawParts &parts) {
              return friction_under_pressure(parts);
            }};
  }
} // namespace Debond
