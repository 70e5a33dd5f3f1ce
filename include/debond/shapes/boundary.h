#pragma once

#include <deal.II/base/types.h>

/** Parts of the boundary of a body: its boundary ids in the triangulation.
 */
namespace Debond::Boundary
{
  using Id = dealii::types::boundary_id;

  constexpr Id free     = 0;
  constexpr Id contact  = 1;
  constexpr Id held     = 2; ///< does not move
  constexpr Id slides_x = 3; ///< held along x only
  constexpr Id slides_y = 4; ///< held along y only
  constexpr Id slides_z = 5; ///< held along z only
  constexpr Id axial    = 6; ///< moves along z only
} // namespace Debond::Boundary
