#ifndef debond_geometry_closest_point_h
#define debond_geometry_closest_point_h

#include <debond/geometry/surface_geometry.h>

namespace Debond
{
  struct ClosestPoint
  {
    Eigen::Vector2d xi = Eigen::Vector2d::Zero();
    /** |x - y(xi)| [mm] */
    double distance = 0;
    /** True if x - y(xi) is normal to the surface at xi (to @p tolerance), be
     *  it inside or exactly on the border; false if the closest point lies on
     *  the border and the point is beyond it. */
    bool is_orthogonal = false;
    bool converged     = false;
  };

  /**
   * Projection of @p x on the deformed surface.
   * With @p guess: Newton from there, falling back on the global search.
   * Without: global start (nearest of a coarse set of sample points of every
   * element that can still win), then Newton safeguarded by line search,
   * constrained to [0,1]^2.
   * The singular corners of the disk are met only as a border result; there the
   * iteration may converge linearly but must end.
   */
  ClosestPoint
  closest_point(const NurbsSurface    &surface,
                const ControlNet      &control_points,
                const Eigen::Vector3d &x,
                const Eigen::Vector2d *guess = nullptr);
} // namespace Debond
#endif
