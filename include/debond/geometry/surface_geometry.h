#pragma once

#include <debond/geometry/nurbs_surface.h>

#include <deal.II/base/quadrature_lib.h>

#include <type_traits>
#include <vector>

namespace Debond
{
  /** Position, tangents and second derivatives of a surface at a point. */
  struct SurfaceGeometry
  {
    Eigen::Vector3d y, a1, a2;     ///< position [mm], a_alpha, Eq. (23)
    Eigen::Vector3d a11, a12, a22; ///< second derivatives
  };

  /** Contracts a basis with a control net (any: positions, velocities...), to
   *  second derivatives if it has them; else these are 0. */
  template <class Basis>
  void
  contract(const Basis      &basis,
           const ControlNet &control_points,
           SurfaceGeometry  &geometry)
  {
    using Eigen::Vector3d;
    Vector3d y = Vector3d::Zero(), a1 = y, a2 = y, a11 = y, a12 = y, a22 = y;
    for (unsigned int k = 0; k < basis.size; ++k)
      {
        const Vector3d p = control_points.col(basis.control_point[k]);
        y += basis.N[k] * p;
        a1 += basis.N_1[k] * p;
        a2 += basis.N_2[k] * p;
        if constexpr (std::is_same_v<Basis, CurvedBasis>)
          {
            a11 += basis.N_11[k] * p;
            a12 += basis.N_12[k] * p;
            a22 += basis.N_22[k] * p;
          }
      }
    geometry = {y, a1, a2, a11, a12, a22};
  }

  /** Adds N_a @p value to every control point: what a force at the point of the
   *  surface amounts to at the control points. */
  void
  spread(const SurfaceBasis    &basis,
         const Eigen::Vector3d &value,
         ControlNet            &control_points);

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

  /** In every element, element by element, the points of @p along in both
   *  parameters, the first one fastest. */
  std::vector<SurfaceQuadraturePoint>
  surface_quadrature(const NurbsSurface          &surface,
                     const dealii::Quadrature<1> &along);



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
   * Of a surface of several pieces those count where a_1 x a_2 is less than 60
   * degrees off the direction @p towards, a unit vector; without it that of the
   * guess.
   * The singular corners of the disk are met only as a border result; there the
   * iteration may converge linearly but must end.
   */
  ClosestPoint
  closest_point(const NurbsSurface    &surface,
                const ControlNet      &control_points,
                const Eigen::Vector3d &x,
                const Eigen::Vector2d *guess   = nullptr,
                const Eigen::Vector3d *towards = nullptr);



  /** The matrix of the cross product: skew(a) b = a x b. */
  inline Eigen::Matrix3d
  skew(const Eigen::Vector3d &a)
  {
    Eigen::Matrix3d S;
    S << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
    return S;
  }
} // namespace Debond
