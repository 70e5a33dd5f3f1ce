#ifndef debond_shapes_revolved_shape_h
#define debond_shapes_revolved_shape_h

#include <debond/shapes/body_geometry.h>
#include <debond/shapes/revolved_mesh.h>

namespace Debond
{
  /** A body of revolution about the z axis, below z = 0, whose contact face is
   *  its side. `Cells' are those around, radial and along. */
  class RevolvedShape : public BodyGeometry
  {
  public:
    bool
    is_lattice() const override
    {
      return false;
    }
    std::shared_ptr<const FileMesh>
    make_mesh(const BodyParameters &body,
              const BodyParameters &implant,
              const std::string    &section) const override;
    NurbsSurface
    contact_face(const BodyParameters &body, Side side) const override;
    double
    thickness(const BodyParameters &body) const override;
    double
    reach(const BodyParameters &body) const override;

  protected:
    virtual RevolvedBody
    revolved(const BodyParameters &body,
             const BodyParameters &implant) const = 0;
    /** Cells around, and entries that other cells than these have. */
    static void
    check_cells(const BodyParameters &body,
                bool                  is_solid,
                const EntryCheck     &refuse);
  };
} // namespace Debond
#endif
