#ifndef debond_interface_bonding_source_h
#define debond_interface_bonding_source_h

#include <debond/geometry/nurbs_surface.h>
#include <debond/interface/bonding_parameters.h>

#include <vector>

namespace Debond
{
  struct BodyParameters;

  /** The patterns expression and image: area means over all elements or, with
   *  that resolution, values at all points of surface_quadrature() with @p n
   *  points per direction and element. Means of expressions take some 200
   *  quadrature points across the face; pictures are first reduced to means
   * over 256 x 256 parts, and then take two points in each direction for every
   * part.
   *  @p remark: what a user should know of it, if anything.
   *
   *  All functions of this file throw EntryError. */
  std::vector<double>
  values_by_place(const BondingParameters &parameters,
                  const BodyParameters    &implant,
                  const NurbsSurface      &surface,
                  unsigned int             n,
                  std::string             &remark);

  /** The pattern file: a value for each of the @p centres of elements or, with
   *  that resolution, quadrature points [mm]. */
  std::vector<double>
  values_from_file(const BondingParameters            &parameters,
                   const NurbsSurface                 &surface,
                   const std::vector<Eigen::Vector2d> &centres);
} // namespace Debond
#endif
