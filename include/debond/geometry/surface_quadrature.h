#ifndef debond_geometry_surface_quadrature_h
#define debond_geometry_surface_quadrature_h

#include <debond/geometry/nurbs_surface.h>

#include <vector>

namespace dealii
{
  template <int dim>
  class Quadrature;
}

namespace Debond
{
  /** A quadrature point of a surface in its reference configuration. */
  struct SurfaceQuadraturePoint
  {
    unsigned int    element = 0;
    Eigen::Vector2d xi; ///< parameters in the patch
    SurfaceBasis    basis;
    Eigen::Vector3d X;       ///< reference position [mm]
    double          JxW = 0; ///< reference area [mm^2]
  };

  /** The points of @p quadrature on [0,1]^2 in one element. */
  std::vector<SurfaceQuadraturePoint>
  element_quadrature(const NurbsSurface          &surface,
                     unsigned int                 element,
                     const dealii::Quadrature<2> &quadrature);

  /** @p n x @p n Gauss points in every element, element by element, first
   *  parameter fastest. */
  std::vector<SurfaceQuadraturePoint>
  surface_quadrature(const NurbsSurface &surface, unsigned int n);
} // namespace Debond
#endif
