#ifndef debond_bonding_pattern_h
#define debond_bonding_pattern_h

#include <debond/nurbs_surface.h>

#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Debond
{
  enum class BondingPatternKind
  {
    homogeneous,
    disk
  };
  enum class BondingResolution
  {
    element,
    quadrature_point
  };

  /** The subsection `Interface / Bonding` of a scene. */
  struct BondingParameters
  {
    BondingPatternKind pattern         = BondingPatternKind::homogeneous;
    double             initial_bonding = 1; ///< multiplies the pattern
    double             bonded_fraction = 1; ///< of the contact area
    BondingResolution  resolution      = BondingResolution::element;

    static void
    declare(dealii::ParameterHandler &prm);
    void
    parse(dealii::ParameterHandler &prm);
  };

  /** A Gauss point of a surface in its reference configuration. */
  struct SurfaceQuadraturePoint
  {
    unsigned int    element = 0;
    Eigen::Vector2d xi; ///< parameters in the patch
    SurfaceBasis    basis;
    Eigen::Vector3d X;       ///< reference position [mm]
    double          JxW = 0; ///< reference area [mm^2]
  };

  /** @p n x @p n Gauss points in every element, element by element, first
   *  parameter fastest. */
  std::vector<SurfaceQuadraturePoint>
  surface_quadrature(const NurbsSurface &surface, unsigned int n);

  /**
   * phi_0 over the contact face of the implant. Its areas are sums of
   * quadrature weights, so that the bonded fraction is met exactly: elements
   * (or quadrature points) are sorted by the radius of their centroid, those of
   * equal radius form one group, and the group that crosses the fraction shares
   * the remainder equally, which keeps the symmetry of the mesh.
   */
  class BondingPattern
  {
  public:
    /** @p n: quadrature points per direction and element. */
    BondingPattern(const BondingParameters &parameters,
                   const NurbsSurface      &implant,
                   unsigned int             n);

    /** phi_0 at a quadrature point, numbered as surface_quadrature() does. */
    double
    at(unsigned int quadrature_point) const
    {
      return phi_0[quadrature_point];
    }
    /** phi_0 at any point of the surface: that of the quadrature point whose
     *  share of the element contains it. */
    double
    at(const Eigen::Vector2d &xi) const;
    double
    area() const
    {
      return total_area;
    } ///< [mm^2]
    double
    mean() const
    {
      return area_mean;
    }

  private:
    const NurbsSurface &surface;
    const unsigned int  n;
    std::vector<double> phi_0;
    std::vector<double> shares; ///< ends of the points' shares of [0,1]
    double              total_area = 0, area_mean = 0;
  };
} // namespace Debond
#endif
