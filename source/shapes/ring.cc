#include <debond/shapes/body_parameters.h>
#include <debond/shapes/meshed_shape.h>
#include <debond/shapes/revolved_mesh.h>
#include <debond/support/number_text.h>

#include <cmath>

namespace Debond
{
  namespace
  {
    /** A coin with a hole, on the bone. */
    class Ring : public MeshedShape
    {
    public:
      std::string
      name() const override
      {
        return "ring";
      }
      std::string
      description() const override
      {
        return "a coin with a hole: a ring given by Radius, Inner radius and "
               "Height";
      }
      std::vector<std::string>
      entries() const override
      {
        return {"Radius", "Inner radius", "Height"};
      }

      void
      check(const BodyParameters &body, const EntryCheck &refuse) const override
      {
        check_cells(body, false, refuse);
        refuse(!(body.inner_radius > 0. && body.inner_radius < body.radius),
               "Inner radius",
               "a ring has a hole: expected more than 0 and less than its "
               "Radius, " +
                 to_text(body.radius) + " mm (without a hole it is a coin)");
      }

      double
      width(const BodyParameters &body, const unsigned int) const override
      {
        return 2. * body.radius;
      }
      double
      area(const BodyParameters &body) const override
      {
        return M_PI * (body.radius * body.radius -
                       body.inner_radius * body.inner_radius);
      }
      bool
      is_round() const override
      {
        return true;
      }

    protected:
      StoredMesh
      stored_mesh(const BodyParameters &body,
                  const BodyParameters &) const override
      {
        RevolvedBody result;
        result.cells    = body.cells;
        result.grading  = body.layer_grading;
        result.height   = body.height;
        result.inner    = [&body](double, double) { return body.inner_radius; };
        result.outer    = [&body](double, double) { return body.radius; };
        result.contact  = RevolvedBody::Part::bottom;
        result.top_name = "held";
        return mesh_of_revolution(result);
      }
    };
  } // namespace



  const BodyGeometry &
  ring_geometry()
  {
    static const Ring ring;
    return ring;
  }
} // namespace Debond
