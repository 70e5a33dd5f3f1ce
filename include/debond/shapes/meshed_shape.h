#ifndef debond_shapes_meshed_shape_h
#define debond_shapes_meshed_shape_h

#include <debond/shapes/body_geometry.h>
#include <debond/shapes/mesh_formats.h>

namespace Debond
{
  /** A shape with cells of its own about the z axis. `Cells' are those around,
   *  radial and along. */
  class MeshedShape : public BodyGeometry
  {
  public:
    bool
    is_lattice() const override
    {
      return false;
    }
    std::shared_ptr<const BodyMesh>
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
    /** Throws EntryError. */
    virtual StoredMesh
    stored_mesh(const BodyParameters &body,
                const BodyParameters &implant) const = 0;
    /** Cells around, and entries that other cells than these have. @p
     * has_square: whether there is a square with a quarter of them on each
     * edge. */
    static void
    check_cells(const BodyParameters &body,
                bool                  has_square,
                const EntryCheck     &refuse);
  };
} // namespace Debond
#endif
