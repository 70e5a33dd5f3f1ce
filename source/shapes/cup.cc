#include <debond/shapes/body_parameters.h>
#include <debond/shapes/bowl_mesh.h>
#include <debond/shapes/meshed_shape.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  namespace
  {
    /** Part of a sphere that is in the bone up to z = 0. */
    class Cup : public MeshedShape
    {
    public:
      std::string
      name() const override
      {
        return "cup";
      }
      std::string
      description() const override
      {
        return "half a sphere of Radius in the bone, or its lowest part of "
               "the given Height, whose sphere is the contact face; with an "
               "Inner radius it is a shell. Its rim is at z = 0, where the "
               "chuck holds it";
      }
      std::vector<std::string>
      entries() const override
      {
        return {"Radius", "Height", "Inner radius"};
      }

      void
      check(const BodyParameters &body, const EntryCheck &refuse) const override
      {
        check_cells(body, true, refuse);
        refuse(body.height > body.radius,
               "Height",
               "a cup is half a sphere at most: expected no more than its "
               "Radius, " +
                 to_text(body.radius) + " mm");
        const double centre = *centre_of_sphere(body);
        refuse(body.inner_radius > 0. && !(body.inner_radius > centre &&
                                           body.inner_radius < body.radius),
               "Inner radius",
               "expected 0, of a solid cup, or a shell's, between " +
                 to_text(centre, 6) + " (Radius less Height) and " +
                 to_text(body.radius) + " mm");
      }

      double
      width(const BodyParameters &body, const unsigned int) const override
      {
        return 2. * std::sqrt(body.height * (2. * body.radius - body.height));
      }
      double
      area(const BodyParameters &body) const override
      {
        return 2. * M_PI * body.radius * body.height;
      }
      double
      chuck_height(const BodyParameters &) const override
      {
        return 0.;
      }
      std::optional<double>
      centre_of_sphere(const BodyParameters &body) const override
      {
        return body.radius - body.height;
      }
      bool
      is_round() const override
      {
        return true;
      }

      Eigen::Vector3d
      outwards(const BodyParameters  &body,
               const Eigen::Vector3d &X) const override
      {
        return from_centre(body, X) / body.radius;
      }
      // as far from the middle as along the sphere from its lowest point
      Eigen::Vector2d
      on_face(const BodyParameters  &body,
              const Eigen::Vector3d &X) const override
      {
        const Eigen::Vector3d d      = from_centre(body, X);
        const double          across = std::hypot(d[0], d[1]);
        const double          way    = body.radius * std::atan2(across, -d[2]);
        return across > 0. ? Eigen::Vector2d(way / across * d.head<2>()) :
                             Eigen::Vector2d(0., 0.);
      }
      std::array<Eigen::Vector2d, 2>
      box_of_face(const BodyParameters &body) const override
      {
        const double way =
          body.radius * std::acos(1. - body.height / body.radius);
        return {{{-way, -way}, {way, way}}};
      }

    protected:
      StoredMesh
      stored_mesh(const BodyParameters &body,
                  const BodyParameters &) const override
      {
        Bowl bowl;
        bowl.cells        = body.cells;
        bowl.grading      = body.layer_grading;
        bowl.outer.radius = body.radius;
        bowl.inner.radius = body.inner_radius;
        bowl.outer.centre = bowl.inner.centre = *centre_of_sphere(body);
        bowl.is_solid                         = body.inner_radius == 0.;
        const double half                     = 0.4 * width(body, 0);
        bowl.inner.box = {{half, half, 0.4 * body.height}};
        bowl.rim       = "held";
        return mesh_of_bowl(bowl);
      }

    private:
      Eigen::Vector3d
      from_centre(const BodyParameters &body, const Eigen::Vector3d &X) const
      {
        return X - Eigen::Vector3d(0., 0., *centre_of_sphere(body));
      }
    };
  } // namespace



  const BodyGeometry &
  cup_geometry()
  {
    static const Cup cup;
    return cup;
  }
} // namespace Debond
