#ifndef debond_shapes_body_geometry_h
#define debond_shapes_body_geometry_h

#include <debond/geometry/nurbs_surface.h>
#include <debond/shapes/side.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Debond
{
  struct BodyParameters;
  struct BodyMesh;

  /**
   * A shape of a body: its contact face, its size, and what the scene says of
   * it. There is one of each shape, in a file of its own; the numbers are those
   * of the body's parameters.
   *
   * A shape without a mesh of its own has a contact face of cells[0] x
   * cells[1] elements, which touches z = 0 with its centre at the origin, and a
   * flat far face at the distance thickness(). Its cells stand in columns
   * between them.
   */
  class BodyGeometry
  {
  public:
    virtual ~BodyGeometry() = default;

    /** @name As scenes know it */
    //@{
    /** Choice of the entry `Shape`. */
    virtual std::string
    name() const = 0;
    /** What that choice means. */
    virtual std::string
    description() const = 0;
    virtual bool
    is_for_bone() const
    {
      return false;
    }
    virtual bool
    is_for_implant() const
    {
      return true;
    }
    /** Entries that give its size; the first one says how wide it is. */
    virtual std::vector<std::string>
    entries() const = 0;
    /** Throws if an entry has a mistake, with a message. */
    using EntryCheck = std::function<
      void(bool, const std::string &entry, const std::string &message)>;
    virtual void
    check(const BodyParameters &, const EntryCheck &) const
    {}
    //@}

    /** @name Size [mm] */
    //@{
    /** Of the contact face along x (0) or y (1), seen from above. */
    virtual double
    width(const BodyParameters &body, unsigned int direction) const = 0;
    /** On the axis. */
    virtual double
    thickness(const BodyParameters &body) const = 0;
    /** How far it reaches from the axis while it turns. */
    virtual double
    reach(const BodyParameters &body) const;
    /** Height of the chuck's centre. */
    virtual double
    chuck_height(const BodyParameters &body) const
    {
      return thickness(body);
    }
    /** Radius of the contact face at the height @p z, and at an @p angle from
     *  the x axis [rad], of an implant that is in the bone with its side; 0 of
     *  others. */
    virtual double
    radius_of_side(const BodyParameters &, double /*z*/, double /*angle*/) const
    {
      return 0.;
    }
    /** Height of the centre of a contact face that is a sphere of the body's
     *  radius [mm]. */
    virtual std::optional<double>
    centre_of_sphere(const BodyParameters &) const
    {
      return {};
    }
    /** Whether an implant is in the bone, with its side or its sphere. */
    bool
    is_in_bore(const BodyParameters &body) const
    {
      return radius_of_side(body, 0., 0.) > 0. || centre_of_sphere(body);
    }
    /** How a point @p X of that face, or one of its control points, moves while
     *  the radius grows, per length. */
    virtual Eigen::Vector3d
    outwards(const BodyParameters &body, const Eigen::Vector3d &X) const
    {
      return Eigen::Vector3d(X[0], X[1], 0.) /
             radius_of_side(body, X[2], std::atan2(X[1], X[0]));
    }
    /** Where a point of the contact face is in the face's own two coordinates
     *  [mm], for patterns and maps: x and y, around a side and along z, or
     * along a sphere from its lowest point. */
    virtual Eigen::Vector2d
    on_face(const BodyParameters &, const Eigen::Vector3d &X) const
    {
      return X.head<2>();
    }
    /** The rectangle around the face in these. */
    virtual std::array<Eigen::Vector2d, 2>
    box_of_face(const BodyParameters &body) const;
    /** Whether there is a face at a place of that rectangle; maps ask. */
    virtual bool
    has_face_at(const BodyParameters &body, const Eigen::Vector2d &place) const;
    /** Area of the contact face [mm^2] where there is a closed form; 0: the sum
     *  of its elements. */
    virtual double
    area(const BodyParameters &) const
    {
      return 0.;
    }
    /** Area of the contact face, seen from above, over that of the rectangle
     *  around it. */
    virtual double
    share_of_rectangle() const
    {
      return 1.;
    }
    //@}

    /** Whether its cells stand in columns: it has no mesh. */
    virtual bool
    is_lattice() const
    {
      return true;
    }
    /** Refuses cells that do not show a side of some height. */
    virtual void
    check_cells_of_side(const BodyParameters &,
                        double /*height*/,
                        const std::array<unsigned int, 3> &,
                        const EntryCheck &) const
    {}
    /** Whether a side is round. */
    virtual bool
    is_round_about_axis() const
    {
      return true;
    }
    /** Whether the contact face is a circle in these coordinates. */
    virtual bool
    is_round() const
    {
      return false;
    }
    /** Whether closed forms and the forecast know it. */
    virtual bool
    has_closed_forms() const
    {
      return false;
    }

    /** The cells of a shape that are no lattice, else null. A bone may have a
     *  bore for the @p implant. Throws EntryError; @p section is "Bone" or
     *  "Implant". */
    virtual std::shared_ptr<const BodyMesh>
    make_mesh(const BodyParameters &body,
              const BodyParameters &implant,
              const std::string    &section) const;

    /** The contact face in the reference configuration, once there are cells.
     */
    virtual NurbsSurface
    contact_face(const BodyParameters &body, Side side) const = 0;
  };

  /** Refuses what belongs to cells in columns, with the @p reason why the
   *  shape of @p body has none, or a shape that has them else has others. */
  void
  refuse_entries_of_lattices(const BodyParameters           &body,
                             const std::string              &reason,
                             const BodyGeometry::EntryCheck &refuse);

  /** All shapes, in the order of BodyShape. */
  const std::vector<const BodyGeometry *> &
  body_geometries();
} // namespace Debond
#endif
