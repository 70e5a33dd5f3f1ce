#ifndef debond_shapes_body_geometry_h
#define debond_shapes_body_geometry_h

#include <debond/geometry/nurbs_surface.h>
#include <debond/shapes/side.h>

#include <functional>
#include <string>
#include <vector>

namespace Debond
{
  struct BodyParameters;

  /**
   * A shape of a body: its contact face, its size, and what the scene says of
   * it. There is one of each shape, in a file of its own; the numbers are those
   * of the body's parameters.
   *
   * A shape that is not that of a mesh has a contact face of cells[0] x
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

    /** Whether the contact face is a circle seen from above. */
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

    /** The contact face in the reference configuration. */
    virtual NurbsSurface
    contact_face(const BodyParameters &body, Side side) const = 0;
  };

  /** All shapes, in the order of BodyShape. */
  const std::vector<const BodyGeometry *> &
  body_geometries();
} // namespace Debond
#endif
