#ifndef debond_geometry_cyclic_symmetry_h
#define debond_geometry_cyclic_symmetry_h

#include <debond/geometry/surface_geometry.h>

#include <array>
#include <optional>
#include <vector>

namespace Debond
{
  /** What the turns by multiples of 360 degrees / n about the z axis make of a
   *  surface that they leave as it is: its control points, and some points of
   *  it, are images of those in one of n sectors. */
  class CyclicSymmetry
  {
  public:
    /** Nothing if those turns do not leave the surface as it is: places and
     *  weights of its control points, and places and functions of the
     *  @p points, which are all of a surface_quadrature(). */
    static std::optional<CyclicSymmetry>
    of(const NurbsSurface                        &surface,
       const std::vector<SurfaceQuadraturePoint> &points,
       unsigned int                               n_sectors);

    /** How one of several things comes from the first of its images. */
    struct Image
    {
      unsigned int first = 0;
      unsigned int turns = 0; ///< that lead from there to here
      unsigned int n = 0; ///< images of it: as many as sectors, on the axis 1
    };
    std::vector<Image> control_points, points;
    /** By 0, 1, ... sectors. */
    std::vector<Eigen::Matrix3d> turn;

    unsigned int
    n_sectors() const
    {
      return turn.size();
    }

    /** Replaces vectors at the control points by their mean over all turns. */
    void
    average(ControlNet &vectors) const;

    /** These control points and all images of them. */
    std::vector<bool>
    with_images(const std::vector<bool> &marked) const;
  };



  /** Of both contact surfaces. */
  using SectorsOfSurfaces = std::array<CyclicSymmetry, 2>;
} // namespace Debond
#endif
