#ifndef debond_bonding_source_h
#define debond_bonding_source_h

#include <debond/bonding_parameters.h>
#include <debond/nurbs_surface.h>

#include <functional>
#include <vector>

namespace Debond
{
  struct BodyParameters;

  /** phi_0 as a function of the place (x, y) on the contact face [mm]. */
  using PlaceFunction = std::function<double(const Eigen::Vector2d &)>;

  /** The patterns expression and image. All functions of this file throw
   *  InputError that begins with the name of the entry. */
  PlaceFunction
  place_function(const BondingParameters &parameters,
                 const BodyParameters    &implant);

  /** The area mean of @p function over every element, by at least @p n x @p n
   *  and some 200 quadrature points across the face. */
  std::vector<double>
  element_means(const PlaceFunction &function,
                const NurbsSurface  &surface,
                unsigned int         n);

  /** The values of @p function at all points of surface_quadrature(). */
  std::vector<double>
  point_values(const PlaceFunction &function,
               const NurbsSurface  &surface,
               unsigned int         n);

  /** The pattern file: a value for each of the @p centres of elements or, with
   *  that resolution, quadrature points [mm]. */
  std::vector<double>
  values_from_file(const BondingParameters            &parameters,
                   const NurbsSurface                 &surface,
                   const std::vector<Eigen::Vector2d> &centres);
} // namespace Debond
#endif
