#pragma once

#include <debond/geometry/surface_geometry.h>
#include <debond/interface/bonding_parameters.h>

#include <string>
#include <vector>

namespace Debond
{
  struct BodyParameters;

  /**
   * phi_0 over the contact face of the implant. The face consists of parts that
   * have one phi_0 each: elements or, with that resolution, quadrature points.
   * Areas are sums of quadrature weights, so that a bonded fraction is met
   * exactly: the patterns disk, annulus and random put the parts into an order,
   * by the radius of their centroids or by chance; parts of equal rank form one
   * group, and the group that crosses the fraction shares the remainder
   * equally, which keeps the symmetry of the mesh.
   */
  class BondingPattern
  {
  public:
    /** @p surface: the contact face of the @p implant, with the points of
     *  surface_quadrature(). Throws EntryError if the expression, the image or
     *  the file is not as it should be. */
    BondingPattern(const BondingParameters     &parameters,
                   const BodyParameters        &implant,
                   const NurbsSurface          &surface,
                   const dealii::Quadrature<1> &along);

    struct Part
    {
      Eigen::Vector3d place = Eigen::Vector3d::Zero(); ///< mean X [mm]
      Eigen::Vector2d centre;    ///< the same on the face, see on_face() [mm]
      double          area  = 0; ///< [mm^2]
      double          phi_0 = 0;
    };
    const std::vector<Part> &
    parts() const
    {
      return all_parts;
    }

    /** phi_0 at a quadrature point, numbered as surface_quadrature() does. */
    double
    at(unsigned int quadrature_point) const
    {
      return all_parts[part_of(quadrature_point)].phi_0;
    }
    /** phi_0 at any point of the surface: that of the quadrature point whose
     *  share of the element contains it. */
    double
    at(const Eigen::Vector2d &xi) const;

    /** Areas and means of the pattern. */
    struct Report
    {
      double       area        = 0; ///< of the contact face [mm^2]
      double       mean        = 0; ///< area mean of phi_0
      double       bonded_area = 0; ///< integral of phi_0 over the face [mm^2]
      unsigned int patches     = 0; ///< see patches()
      double       largest_patch = 0; ///< bonded area of the largest [mm^2]
      std::string  remark;            ///< for the user, if there is one
    };
    const Report &
    report() const
    {
      return summary;
    }

    /** One line for people. */
    std::string
    description() const;

    /** The parts as CSV that the pattern `file` reads again: element (or
     *  point), x_mm, y_mm, area_mm2, phi_0. */
    std::string
    table() const;

  private:
    unsigned int
    part_of(const unsigned int quadrature_point) const
    {
      return by_element ? quadrature_point / (n * n) : quadrature_point;
    }
    void
    fill(const BondingParameters &parameters, const BodyParameters &implant);
    void
    count_patches();
    std::vector<unsigned int>
    parts_beside(unsigned int part) const;
    /** The quadrature point whose share of the element contains xi. */
    unsigned int
    point_at(unsigned int element, const Eigen::Vector2d &xi) const;

    const NurbsSurface         &surface;
    const dealii::Quadrature<1> along;
    const unsigned int          n; ///< of its points
    const bool                  by_element;
    std::vector<Part>           all_parts;
    std::vector<double>         shares; ///< ends of the points' shares of [0,1]
    Report                      summary;
  };

  /** Refuses an expression, an image or a file that gives no pattern on this
   *  implant with these points, before anything runs. Throws EntryError. */
  void
  check_bonding_pattern(const BondingParameters     &parameters,
                        const BodyParameters        &implant,
                        const dealii::Quadrature<1> &along);
} // namespace Debond
