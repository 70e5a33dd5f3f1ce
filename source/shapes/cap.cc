#include <debond/shapes/body_parameters.h>
#include <debond/shapes/coin.h>
#include <debond/support/number_text.h>

#include <cmath>

namespace Debond
{
  namespace
  {
    /** A coin whose contact face is part of a sphere. */
    class Cap : public Coin
    {
    public:
      std::string
      name() const override
      {
        return "cap";
      }
      std::string
      description() const override
      {
        return "the same with a spherical contact face of radius Cap radius";
      }
      std::vector<std::string>
      entries() const override
      {
        return {"Radius", "Height", "Cap radius"};
      }

      void
      check(const BodyParameters &body, const EntryCheck &refuse) const override
      {
        Coin::check(body, refuse);
        refuse(body.cap_radius <= body.radius,
               "Cap radius",
               "a cap is flatter than a hemisphere: expected more than "
               "Radius, " +
                 to_text(body.radius) + " mm");
        refuse(rise(body) >= body.height,
               "Height",
               "the rim of the cap is " + to_text(rise(body)) +
                 " mm above its centre: expected more than that");
      }

      double
      area(const BodyParameters &body) const override
      {
        return 2. * M_PI * body.cap_radius * rise(body);
      }
      bool
      has_closed_forms() const override
      {
        return false;
      }

      NurbsSurface
      contact_face(const BodyParameters &body, const Side) const override
      {
        return NurbsSurface::cap(body.radius, body.cap_radius, body.cells[0]);
      }

    private:
      /** Height of the rim of the contact face above its centre [mm]. */
      static double
      rise(const BodyParameters &body)
      {
        return height_on_sphere(body.radius, body.cap_radius);
      }
    };
  } // namespace



  const BodyGeometry &
  cap_geometry()
  {
    static const Cap cap;
    return cap;
  }
} // namespace Debond
