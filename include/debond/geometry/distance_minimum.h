#ifndef debond_geometry_distance_minimum_h
#define debond_geometry_distance_minimum_h

#include <debond/geometry/surface_geometry.h>

namespace Debond
{
  /** The point @p x and the deformed surface whose distance is minimised. */
  struct DistanceProblem
  {
    const NurbsSurface    &surface;
    const ControlNet      &control_points;
    const Eigen::Vector3d &x;
  };

  /** The distance function and its model at one point of an element. */
  struct DistanceState
  {
    Eigen::Vector2d xi;
    SurfaceGeometry geometry;
    Eigen::Vector3d r;        ///< x - y
    double          f;        ///< |r|^2 / 2
    Eigen::Vector2d gradient; ///< of f
    Eigen::Vector2d noise;    ///< size of round-off in the gradient
  };

  /** At @p xi in @p element, which may lie on its sides. */
  DistanceState
  evaluate_distance(const DistanceProblem &problem,
                    unsigned int           element,
                    const Eigen::Vector2d &xi);

  /** Minimum of the distance over the patch that is reached from @p s in
   *  @p element, going down from element to element. Both are updated. Returns
   *  whether it was found. */
  bool
  minimise_distance(const DistanceProblem &problem,
                    unsigned int          &element,
                    DistanceState         &s);
} // namespace Debond
#endif
