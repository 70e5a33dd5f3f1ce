#include <debond/shapes/body_parameters.h>
#include <debond/shapes/pin.h>
#include <debond/shapes/revolved_mesh.h>
#include <debond/support/number_text.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  std::string
  Pin::name() const
  {
    return "pin";
  }
  std::string
  Pin::description() const
  {
    return "a cylinder along the z axis in the bone, given by Radius and "
           "Height, whose side is the contact face; hollow with an Inner "
           "radius. It ends at z = 0, where the chuck holds it";
  }
  std::vector<std::string>
  Pin::entries() const
  {
    return {"Radius", "Height", "Inner radius"};
  }

  void
  Pin::check(const BodyParameters &body, const EntryCheck &refuse) const
  {
    refuse(body.inner_radius >= thinnest(body),
           "Inner radius",
           "the implant has no wall: expected less than its radius, " +
             to_text(thinnest(body)) + " mm");
    check_cells(body, body.inner_radius == 0., refuse);
  }

  double
  Pin::thinnest(const BodyParameters &body) const
  {
    return std::min(radius_of_side(body, 0., 0.),
                    radius_of_side(body, -body.height, 0.));
  }

  double
  Pin::width(const BodyParameters &body, const unsigned int) const
  {
    return 2. * body.radius;
  }
  double
  Pin::area(const BodyParameters &body) const
  {
    return 2. * M_PI * body.radius * body.height;
  }
  double
  Pin::radius_of_side(const BodyParameters &body,
                      const double,
                      const double) const
  {
    return body.radius;
  }

  Eigen::Vector2d
  Pin::on_face(const BodyParameters &body, const Eigen::Vector3d &X) const
  {
    return {body.radius * std::atan2(X[1], X[0]), X[2]};
  }
  std::array<Eigen::Vector2d, 2>
  Pin::box_of_face(const BodyParameters &body) const
  {
    const double half = M_PI * body.radius;
    return {{{-half, -body.height}, {half, 0.}}};
  }

  StoredMesh
  Pin::stored_mesh(const BodyParameters &body, const BodyParameters &) const
  {
    RevolvedBody result;
    result.cells   = body.cells;
    result.grading = body.layer_grading;
    result.lowest  = -body.height;
    result.height  = body.height;
    result.outer   = [this, &body](const double z, const double angle) {
      return radius_of_side(body, z, angle);
    };
    if (body.inner_radius > 0.)
      result.inner = [&body](double, double) { return body.inner_radius; };
    result.top_name = "held";
    result.is_round = is_round_about_axis();
    return mesh_of_revolution(result);
  }



  const BodyGeometry &
  pin_geometry()
  {
    static const Pin pin;
    return pin;
  }
} // namespace Debond
