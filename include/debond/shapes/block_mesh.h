#pragma once

#include <debond/shapes/mesh_formats.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace Debond
{
  /** A lattice of hexahedra of the second order, of any form. */
  struct Block
  {
    /** Place of a node, in halves of cells. */
    using Place = std::array<unsigned int, 3>;

    Place                                          n_cells;
    std::function<dealii::Point<3>(const Place &)> at; ///< a node [mm]
    /** What its six sides are in the files of meshes, in deal.II's order;
     *  empty: nothing, as "free". */
    std::array<std::string, 6> sides;
  };

  /** The cells of several blocks, which share the nodes that are at the same
   *  place. */
  StoredMesh
  mesh_of_blocks(const std::vector<Block> &blocks);

  /** Share of the way over @p n layers at so many halves of layers, graded to
   *  the first or to the last one; nodes between two layers are in their
   *  middle. */
  double
  part_of_way(unsigned int halves,
              unsigned int n,
              bool         to_first,
              double       grading);
} // namespace Debond
