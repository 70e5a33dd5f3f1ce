#include <debond/shapes/body_parameters.h>
#include <debond/shapes/pin.h>

#include <cmath>

namespace Debond
{
  namespace
  {
    /** A pin that becomes thinner below. */
    class Taper : public Pin
    {
    public:
      std::string
      name() const override
      {
        return "taper";
      }
      std::string
      description() const override
      {
        return "a pin that is a cone: its side leans by the Taper angle, and "
               "Radius is that at z = 0";
      }
      std::vector<std::string>
      entries() const override
      {
        return {"Radius", "Height", "Inner radius", "Taper angle"};
      }

      void
      check(const BodyParameters &body, const EntryCheck &refuse) const override
      {
        refuse(!(radius_of_side(body, -body.height, 0.) > 0.),
               "Taper angle",
               "the cone ends before its Height: expected less");
        Pin::check(body, refuse);
      }

      double
      area(const BodyParameters &body) const override
      {
        const double low = radius_of_side(body, -body.height, 0.);
        return M_PI * (body.radius + low) * body.height /
               std::cos(body.taper_angle * M_PI / 180.);
      }
      double
      radius_of_side(const BodyParameters &body,
                     const double          z,
                     const double) const override
      {
        return body.radius + z * std::tan(body.taper_angle * M_PI / 180.);
      }
    };
  } // namespace



  const BodyGeometry &
  taper_geometry()
  {
    static const Taper taper;
    return taper;
  }
} // namespace Debond
