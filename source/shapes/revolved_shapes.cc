#include <debond/geometry/nurbs_surface.h>
#include <debond/shapes/body_mesh.h>
#include <debond/shapes/body_parameters.h>
#include <debond/shapes/revolved_mesh.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    RevolvedBody::Radius
    always(const double radius)
    {
      return [radius](double, double) { return radius; };
    }



    RevolvedBody
    revolved(const BodyParameters &body,
             const double          lowest,
             const double          height,
             const double          inner_radius)
    {
      RevolvedBody result;
      result.cells   = body.cells;
      result.grading = body.layer_grading;
      result.lowest  = lowest;
      result.height  = height;
      if (inner_radius > 0.)
        result.inner = always(inner_radius);
      return result;
    }



    BodyGeometry
    pin(const BodyParameters &body)
    {
      BodyGeometry result = BodyGeometry::round(body.radius, body.height);
      result.is_round     = false;
      result.chuck_height = 0.;
      result.area         = 2. * M_PI * body.radius * body.height;
      result.radius       = body.radius;
      result.side         = always(body.radius);
      return result;
    }

    BodyGeometry
    taper(const BodyParameters &body)
    {
      const double R = body.radius, angle = body.taper_angle * M_PI / 180.;
      BodyGeometry result = pin(body);
      result.side = [R, slope = std::tan(angle)](const double z, double) {
        return R + z * slope;
      };
      result.area = M_PI * (R + result.side(-body.height, 0.)) * body.height /
                    std::cos(angle);
      return result;
    }

    // A helix that rises against the clock, seen from above: turned to the
    // left, it comes out. Its area has no closed form.
    BodyGeometry
    screw(const BodyParameters &body)
    {
      BodyGeometry result = pin(body);
      result.reach        = body.radius + 0.5 * body.thread_depth;
      result.width        = {{2. * result.reach, 2. * result.reach}};
      result.area         = 0.;
      result.waves_around = body.starts;
      result.wave_length  = body.pitch;
      result.side         = [R      = body.radius,
                     half   = 0.5 * body.thread_depth,
                     pitch  = body.pitch,
                     starts = body.starts](const double z, const double angle) {
        return R + half * std::cos(2. * M_PI * z / pitch - starts * angle);
      };
      return result;
    }



    /** Refuses cells that do not show the waves of a side. */
    void
    check_waves(const BodyGeometry                &geometry,
                const double                       height,
                const std::array<unsigned int, 3> &cells,
                const EntryCheck                  &refuse)
    {
      const double around = 4. * geometry.waves_around,
                   along = std::ceil(4. * height / geometry.wave_length - 1e-9);
      refuse(cells[0] < around || cells[2] < along,
             "Cells",
             "they do not show the thread, which needs four to each wave: "
             "expected at least " +
               to_text(around) + " around and " + to_text(along) + " along");
    }

    void
    check_pin(const BodyParameters &body, const EntryCheck &refuse)
    {
      const BodyGeometry geometry = body.geometry();
      const double       low      = geometry.side(-body.height, 0.);
      refuse(body.shape == BodyShape::screw && body.thread_depth >= body.radius,
             "Thread depth",
             "the thread is deeper than the screw is thick: expected less "
             "than its Radius, " +
               to_text(body.radius) + " mm");
      refuse(!(low > 0.),
             "Taper angle",
             "the cone ends before its Height: expected less");
      check_waves(geometry, body.height, body.cells, refuse);
      const double thinnest = body.shape == BodyShape::screw ?
                                body.radius - 0.5 * body.thread_depth :
                                low;
      refuse(body.inner_radius >= thinnest,
             "Inner radius",
             "the implant has no wall: expected less than its radius, " +
               to_text(thinnest) + " mm");
      check_cells_around(body, body.inner_radius == 0., refuse);
    }

    StoredMesh
    cells_of_pin(const BodyParameters &body, const BodyParameters &)
    {
      const BodyGeometry geometry = body.geometry();
      RevolvedBody       result =
        revolved(body, -body.height, body.height, body.inner_radius);
      result.outer    = geometry.side;
      result.top_name = "held";
      result.is_round = geometry.waves_around == 0.;
      return mesh_of_revolution(result);
    }



    BodyGeometry
    ring(const BodyParameters &body)
    {
      BodyGeometry result = BodyGeometry::round(body.radius, body.height);
      result.area         = M_PI * (body.radius * body.radius -
                            body.inner_radius * body.inner_radius);
      return result;
    }

    void
    check_ring(const BodyParameters &body, const EntryCheck &refuse)
    {
      if (!body.is_fitted())
        check_cells_around(body, false, refuse);
      refuse(!(body.inner_radius > 0. && body.inner_radius < body.radius),
             "Inner radius",
             "a ring has a hole: expected more than 0 and less than its "
             "Radius, " +
               to_text(body.radius) + " mm (without a hole it is a coin)");
    }

    NurbsSurface
    face_of_ring(const BodyParameters &body)
    {
      return NurbsSurface::fitted_ring(body.radius,
                                       body.inner_radius,
                                       body.fitted_cells[0],
                                       body.fitted_cells[1]);
    }

    StoredMesh
    cells_of_ring(const BodyParameters &body, const BodyParameters &)
    {
      RevolvedBody result = revolved(body, 0., body.height, body.inner_radius);
      result.outer        = always(body.radius);
      result.contact      = RevolvedBody::Part::bottom;
      result.top_name     = "held";
      return mesh_of_revolution(result);
    }



    BodyGeometry
    sleeve(const BodyParameters &body)
    {
      return BodyGeometry::round(body.outer_radius,
                                 body.mesh ? body.mesh->box.side_length(2) :
                                             body.height);
    }

    void
    check_sleeve(const BodyParameters &body, const EntryCheck &refuse)
    {
      check_cells_around(body, false, refuse);
      refuse(body.support_radius > 0. && !body.ends.empty(),
             "Ends",
             "the bone stands on a ring (Support radius), which holds its "
             "bottom: expected free");
    }

    /** Refuses a sleeve that the implant does not fit in. */
    void
    check_bore(const BodyParameters &body,
               const BodyParameters &implant,
               const double          height)
    {
      const BodyGeometry inside = implant.geometry();
      if (!inside.side)
        throw EntryError("Bone / Shape",
                         "a sleeve is around the side of an implant, and a " +
                           implant.shape_row().name +
                           " touches bone below it: expected a block, or "
                           "another Implant / Shape");
      if (const double r = 0.5 * inside.width[0]; r >= body.outer_radius)
        throw EntryError("Bone / Outer radius",
                         "the bone is thinner than the implant: expected more "
                         "than " +
                           to_text(r, 6) + " mm",
                         to_text(body.outer_radius));
      if (!(inside.side(-height, 0.) > 0.))
        throw EntryError("Bone / Height",
                         "it is beyond the tip of the implant",
                         to_text(height));
      check_waves(inside, height, body.cells, refusal_in("Bone"));
    }

    StoredMesh
    cells_of_sleeve(const BodyParameters &body, const BodyParameters &implant)
    {
      const double height =
        body.sleeve_height > 0. ? body.sleeve_height : implant.height;
      const bool stands_on_ring = body.support_radius > 0.;
      check_bore(body, implant, height);
      RevolvedBody result = revolved(body, -height, height, 0.);
      result.inner        = implant.geometry().side;
      result.outer        = always(body.outer_radius);
      result.is_round     = implant.geometry().waves_around == 0.;
      result.contact      = RevolvedBody::Part::inner;
      result.outer_name   = stands_on_ring ? "" : "held";
      result.top_name     = body.ends;
      result.bottom_name  = stands_on_ring ? "held" : result.top_name;
      StoredMesh stored   = mesh_of_revolution(result);
      if (!stands_on_ring)
        return stored;
      const auto is_over_hole = [&](const auto &corners) {
        double r = 0.;
        for (const unsigned int node : corners)
          r += 0.25 * std::hypot(stored.nodes[node][0], stored.nodes[node][1]);
        return r < body.support_radius;
      };
      auto &held = stored.groups["held"];
      held.erase(std::remove_if(held.begin(), held.end(), is_over_hole),
                 held.end());
      if (held.empty())
        throw EntryError("Bone / Support radius",
                         "the bone falls through this hole: expected less "
                         "than the middle of the outermost cells",
                         to_text(body.support_radius));
      return stored;
    }
  } // namespace



  std::vector<ShapeRow>
  revolved_shapes()
  {
    const auto implant = [](const std::string              &name,
                            const std::string              &description,
                            const std::vector<std::string> &entries,
                            const auto                      geometry) {
      return ShapeRow{name,
                      description,
                      false,
                      true,
                      entries,
                      geometry,
                      check_pin,
                      nullptr,
                      cells_of_pin};
    };
    return {
      implant("pin",
              "a cylinder along the z axis in the bone, given by Radius and "
              "Height, whose side is the contact face; hollow with an Inner "
              "radius. It ends at z = 0, where the chuck holds it",
              {"Radius", "Height", "Inner radius"},
              pin),
      implant("taper",
              "a pin that is a cone: its side leans by the Taper angle, and "
              "Radius is that at z = 0",
              {"Radius", "Height", "Inner radius", "Taper angle"},
              taper),
      implant(
        "screw",
        "a pin with a right-handed thread, a wave with the height "
        "Thread depth from valley to crest and Radius in the middle; "
        "Pitch and Starts give its slope",
        {"Radius", "Height", "Inner radius", "Pitch", "Thread depth", "Starts"},
        screw),
      {"ring",
       "a coin with a hole: a ring given by Radius, Inner radius and Height",
       false,
       true,
       {"Radius", "Inner radius", "Height"},
       ring,
       check_ring,
       face_of_ring,
       cells_of_ring},
      {"sleeve",
       "a tube around the side of the implant, given by Outer radius and "
       "Height, whose top is at z = 0; its outer face is held, and its ends as "
       "Ends says, or it stands on a plate with a hole (Support radius)",
       true,
       false,
       {"Outer radius", "Height", "Ends", "Support radius"},
       sleeve,
       check_sleeve,
       nullptr,
       cells_of_sleeve}};
  }
} // namespace Debond
