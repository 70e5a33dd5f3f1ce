#include <debond/shapes/body_mesh.h>
#include <debond/shapes/body_parameters.h>
#include <debond/shapes/bowl_mesh.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    BodyGeometry
    cup(const BodyParameters &body)
    {
      const double R = body.radius, h = body.height;
      BodyGeometry result = BodyGeometry::round(std::sqrt(h * (2. * R - h)), h);
      result.chuck_height = 0.;
      result.area         = 2. * M_PI * R * h;
      result.centre_of_sphere = R - h;
      result.radius           = R;
      return result;
    }

    void
    check_cup(const BodyParameters &body, const EntryCheck &refuse)
    {
      check_cells_around(body, true, refuse);
      refuse(body.height > body.radius,
             "Height",
             "a cup is half a sphere at most: expected no more than its "
             "Radius, " +
               to_text(body.radius) + " mm");
      const double centre = body.radius - body.height;
      refuse(body.inner_radius > 0. &&
               !(body.inner_radius > centre && body.inner_radius < body.radius),
             "Inner radius",
             "expected 0, of a solid cup, or a shell's, between " +
               to_text(centre, 6) + " (Radius less Height) and " +
               to_text(body.radius) + " mm");
    }

    StoredMesh
    cells_of_cup(const BodyParameters &body, const BodyParameters &)
    {
      const BodyGeometry geometry = body.geometry();
      const double       half     = 0.4 * geometry.width[0];
      Bowl               bowl;
      bowl.cells        = body.cells;
      bowl.grading      = body.layer_grading;
      bowl.outer.radius = body.radius;
      bowl.inner.radius = body.inner_radius;
      bowl.inner.centre = bowl.outer.centre = *geometry.centre_of_sphere;
      bowl.inner.box                        = {{half, half, 0.4 * body.height}};
      bowl.is_solid                         = body.inner_radius == 0.;
      bowl.rim                              = "held";
      return mesh_of_bowl(bowl);
    }



    bool
    is_shell(const BodyParameters &body)
    {
      return body.outer_radius > 0.;
    }

    BodyGeometry
    cavity(const BodyParameters &body)
    {
      BodyGeometry result =
        BodyGeometry::round(body.outer_radius,
                            body.mesh ? body.mesh->box.side_length(2) :
                                        body.height);
      if (!is_shell(body))
        result.width = {{body.size[0], body.size[1]}};
      return result;
    }

    void
    check_cavity(const BodyParameters &body, const EntryCheck &refuse)
    {
      check_cells_around(body, true, refuse);
      refuse(is_shell(body) && body.size != BodyParameters().size,
             "Size",
             "a cavity has an Outer radius or a Size, not both");
    }

    /** Refuses a cavity that the implant does not fit in. */
    void
    check_room(const BodyParameters &body, const BodyParameters &implant)
    {
      const BodyGeometry inside = implant.geometry();
      if (!inside.centre_of_sphere)
        throw EntryError("Bone / Shape",
                         "a cavity is around the sphere of a cup, and the "
                         "implant is a " +
                           implant.shape_row().name +
                           ": expected Implant / Shape = cup");
      if (is_shell(body) && !(body.outer_radius > implant.radius))
        throw EntryError("Bone / Outer radius",
                         "the implant fills it: expected more than " +
                           to_text(implant.radius) + " mm",
                         to_text(body.outer_radius));
      const double wide = inside.width[0];
      if (!is_shell(body) && !(std::min(body.size[0], body.size[1]) > wide &&
                               body.size[2] > implant.height))
        throw EntryError("Bone / Size",
                         "the implant fills it: expected more than " +
                           to_text(wide, 6) + " mm across and " +
                           to_text(implant.height) + " mm in height",
                         to_text(body.size[0]) + ", " + to_text(body.size[1]) +
                           ", " + to_text(body.size[2]));
    }

    StoredMesh
    cells_of_cavity(const BodyParameters &body, const BodyParameters &implant)
    {
      check_room(body, implant);
      Bowl bowl;
      bowl.cells            = body.cells;
      bowl.grading          = body.layer_grading;
      bowl.contact_is_inner = true;
      bowl.inner.radius     = implant.radius;
      bowl.outer.radius     = body.outer_radius;
      bowl.outer.box        = body.size;
      bowl.inner.centre     = bowl.outer.centre =
        *implant.geometry().centre_of_sphere;
      bowl.rim    = body.ends;
      bowl.bottom = "held";
      if (is_shell(body))
        bowl.sides = {{"held", "held"}};
      else
        bowl.sides = {{"slides x", "slides y"}};
      return mesh_of_bowl(bowl);
    }
  } // namespace



  std::vector<ShapeRow>
  bowl_shapes()
  {
    return {{"cup",
             "half a sphere of Radius in the bone, or its lowest part of the "
             "given Height, whose sphere is the contact face; with an Inner "
             "radius it is a shell. Its rim is at z = 0, where the chuck holds "
             "it",
             false,
             true,
             {"Radius", "Height", "Inner radius"},
             cup,
             check_cup,
             nullptr,
             cells_of_cup},
            {"cavity",
             "bone around the sphere of a cup, whose top is at z = 0: a shell "
             "if Outer radius is given, which is held at its outer face, "
             "otherwise a block of Size, whose bottom is held and whose sides "
             "move in their own planes only; its top is held as Ends says",
             true,
             false,
             {"Size", "Outer radius", "Ends"},
             cavity,
             check_cavity,
             nullptr,
             cells_of_cavity}};
  }
} // namespace Debond
