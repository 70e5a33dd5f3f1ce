#include <debond/shapes/body_parameters.h>
#include <debond/shapes/meshed_shape.h>
#include <debond/shapes/revolved_mesh.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

namespace Debond
{
  namespace
  {
    /** Bone around the side of an implant. */
    class Sleeve : public MeshedShape
    {
    public:
      std::string
      name() const override
      {
        return "sleeve";
      }
      std::string
      description() const override
      {
        return "a tube around the side of the implant, given by Outer radius "
               "and Height, whose top is at z = 0; its outer face is held, "
               "and its ends as Ends says, or it stands on a plate with a "
               "hole (Support radius)";
      }
      bool
      is_for_bone() const override
      {
        return true;
      }
      bool
      is_for_implant() const override
      {
        return false;
      }
      std::vector<std::string>
      entries() const override
      {
        return {"Outer radius", "Height", "Ends", "Support radius"};
      }

      void
      check(const BodyParameters &body, const EntryCheck &refuse) const override
      {
        check_cells(body, false, refuse);
        refuse(stands_on_ring(body) && body.ends != SleeveEnds::free,
               "Ends",
               "the bone stands on a ring (Support radius), which holds its "
               "bottom: expected free");
      }

      double
      width(const BodyParameters &body, const unsigned int) const override
      {
        return 2. * body.outer_radius;
      }

    protected:
      StoredMesh
      stored_mesh(const BodyParameters &body,
                  const BodyParameters &implant) const override
      {
        const BodyGeometry &inside = implant.geometry();
        RevolvedBody        result;
        result.height =
          body.sleeve_height > 0. ? body.sleeve_height : implant.height;
        if (!(inside.radius_of_side(implant, 0., 0.) > 0.))
          throw EntryError("Bone / Shape",
                           "a sleeve is around the side of an implant, and a " +
                             inside.name() +
                             " touches bone below it: expected a block, or "
                             "another Implant / Shape");
        if (const double r = 0.5 * inside.width(implant, 0);
            r >= body.outer_radius)
          throw EntryError(
            "Bone / Outer radius",
            "the bone is thinner than the implant: expected more "
            "than " +
              to_text(r, 6) + " mm",
            to_text(body.outer_radius));
        if (!(inside.radius_of_side(implant, -result.height, 0.) > 0.))
          throw EntryError("Bone / Height",
                           "it is beyond the tip of the implant",
                           to_text(result.height));
        inside.check_cells_of_side(implant,
                                   result.height,
                                   body.cells,
                                   [](const bool         is_mistake,
                                      const std::string &entry,
                                      const std::string &message) {
                                     if (is_mistake)
                                       throw EntryError("Bone / " + entry,
                                                        message);
                                   });
        result.is_round = inside.is_round_about_axis();
        result.inner = [&implant, &inside](const double z, const double angle) {
          return inside.radius_of_side(implant, z, angle);
        };
        result.outer   = [&body](double, double) { return body.outer_radius; };
        result.cells   = body.cells;
        result.grading = body.layer_grading;
        result.lowest  = -result.height;
        result.contact = RevolvedBody::Part::inner;
        result.outer_name  = stands_on_ring(body) ? "free" : "held";
        result.bottom_name = result.top_name = name_of(body.ends);
        if (stands_on_ring(body))
          {
            result.bottom_name = "held";
            result.bottom_from = body.support_radius;
          }
        StoredMesh stored = mesh_of_revolution(result);
        if (stands_on_ring(body) && stored.groups["held"].empty())
          throw EntryError("Bone / Support radius",
                           "the bone falls through this hole: expected less "
                           "than the middle of the outermost cells",
                           to_text(body.support_radius));
        return stored;
      }

    private:
      static bool
      stands_on_ring(const BodyParameters &body)
      {
        return body.support_radius > 0.;
      }
    };
  } // namespace



  const BodyGeometry &
  sleeve_geometry()
  {
    static const Sleeve sleeve;
    return sleeve;
  }
} // namespace Debond
