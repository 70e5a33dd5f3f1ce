#ifndef debond_geometry_surface_geometry_h
#define debond_geometry_surface_geometry_h

#include <debond/geometry/nurbs_surface.h>

namespace Debond
{
  /** Position, tangents and second derivatives of a surface at a point. */
  struct SurfaceGeometry
  {
    Eigen::Vector3d y, a1, a2;     ///< position [mm], a_alpha, Eq. (23)
    Eigen::Vector3d a11, a12, a22; ///< second derivatives
  };

  /** Contracts a basis with a control net (any: positions, velocities...).
   *  Second derivatives only if @p second_derivatives. */
  void
  contract(const SurfaceBasis &basis,
           const ControlNet   &control_points,
           bool                second_derivatives,
           SurfaceGeometry    &geometry);

  /** Adds N_a @p value to every control point: what a force at the point of the
   *  surface amounts to at the control points. */
  void
  spread(const SurfaceBasis    &basis,
         const Eigen::Vector3d &value,
         ControlNet            &control_points);
} // namespace Debond
#endif
