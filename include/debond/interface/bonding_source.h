#ifndef debond_interface_bonding_source_h
#define debond_interface_bonding_source_h

#include <debond/geometry/nurbs_surface.h>
#include <debond/interface/bonding_parameters.h>

#include <vector>

namespace Debond
{
  struct BodyParameters;

  /** The patterns expression, image and file: phi_0 of all elements or, with
   *  that resolution, of all points of surface_quadrature() with @p n points
   *  per direction and element, whose places are the @p centres [mm].
   *
   *  Elements take area means. Those of expressions take some 200 quadrature
   *  points across the face; pictures are first reduced to means over 256 x 256
   *  parts, and then take two points in each direction for every part.
   *  @p remark: what a user should know of it, if anything. Throws EntryError.
   */
  std::vector<double>
  bonding_from_source(const BondingParameters            &parameters,
                      const BodyParameters               &implant,
                      const NurbsSurface                 &surface,
                      unsigned int                        n,
                      const std::vector<Eigen::Vector2d> &centres,
                      std::string                        &remark);
} // namespace Debond
#endif
