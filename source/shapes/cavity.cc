#include <debond/shapes/body_parameters.h>
#include <debond/shapes/bowl_mesh.h>
#include <debond/shapes/meshed_shape.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <algorithm>

namespace Debond
{
  namespace
  {
    /** Bone around the sphere of an implant. */
    class Cavity : public MeshedShape
    {
    public:
      std::string
      name() const override
      {
        return "cavity";
      }
      std::string
      description() const override
      {
        return "bone around the sphere of a cup, whose top is at z = 0: a "
               "shell if Outer radius is given, which is held at its outer "
               "face, otherwise a block of Size, whose bottom is held and "
               "whose sides move in their own planes only; its top is held "
               "as Ends says";
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
        return {"Size", "Outer radius", "Ends"};
      }

      void
      check(const BodyParameters &body, const EntryCheck &refuse) const override
      {
        check_cells(body, true, refuse);
        refuse(is_shell(body) && body.size != BodyParameters().size,
               "Size",
               "a cavity has an Outer radius or a Size, not both");
      }

      double
      width(const BodyParameters &body,
            const unsigned int    direction) const override
      {
        return is_shell(body) ? 2. * body.outer_radius : body.size[direction];
      }

    protected:
      StoredMesh
      stored_mesh(const BodyParameters &body,
                  const BodyParameters &implant) const override
      {
        const std::optional<double> centre =
          implant.geometry().centre_of_sphere(implant);
        if (!centre)
          throw EntryError("Bone / Shape",
                           "a cavity is around the sphere of a cup, and the "
                           "implant is a " +
                             implant.geometry().name() +
                             ": expected Implant / Shape = cup");
        Bowl bowl;
        bowl.cells            = body.cells;
        bowl.grading          = body.layer_grading;
        bowl.contact_is_inner = true;
        bowl.inner.radius     = implant.radius;
        bowl.inner.centre = bowl.outer.centre = *centre;
        bowl.rim                              = name_of(body.ends);
        bowl.bottom                           = "held";
        if (is_shell(body))
          {
            bowl.outer.radius = body.outer_radius;
            bowl.sides        = {{"held", "held"}};
          }
        else
          {
            bowl.outer.box = body.size;
            bowl.sides     = {{"slides x", "slides y"}};
          }
        check_room(body, implant);
        return mesh_of_bowl(bowl);
      }

    private:
      static bool
      is_shell(const BodyParameters &body)
      {
        return body.outer_radius > 0.;
      }
      void
      check_room(const BodyParameters &body,
                 const BodyParameters &implant) const
      {
        if (is_shell(body) && !(body.outer_radius > implant.radius))
          throw EntryError("Bone / Outer radius",
                           "the implant fills it: expected more than " +
                             to_text(implant.radius) + " mm",
                           to_text(body.outer_radius));
        const double wide = implant.geometry().width(implant, 0);
        if (!is_shell(body) && !(std::min(body.size[0], body.size[1]) > wide &&
                                 body.size[2] > implant.height))
          throw EntryError("Bone / Size",
                           "the implant fills it: expected more than " +
                             to_text(wide, 6) + " mm across and " +
                             to_text(implant.height) + " mm in height",
                           to_text(body.size[0]) + ", " +
                             to_text(body.size[1]) + ", " +
                             to_text(body.size[2]));
      }
    };
  } // namespace



  const BodyGeometry &
  cavity_geometry()
  {
    static const Cavity cavity;
    return cavity;
  }
} // namespace Debond
