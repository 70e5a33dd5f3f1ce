#ifndef debond_bulk_body_partition_h
#define debond_bulk_body_partition_h

#include <debond/bulk/bulk_space.h>

#include <vector>

namespace Debond
{
  /**
   * Which rank owns which node of a body that is dealt out in columns of cells,
   * and the numbers of all nodes in the matrix: those of a rank follow each
   * other, its inner nodes before its control points of the contact surface.
   * Tied vertices are no part of it and have no number.
   *
   * Any rank can number any node: a lattice needs no talk about it.
   */
  class BodyPartition
  {
  public:
    /** @p mesh: that of this rank. */
    explicit BodyPartition(const BulkSpace &mesh);

    /** Nodes of this rank, and of all. */
    unsigned int
    n_owned() const
    {
      return first_node[rank + 1] - first_node[rank];
    }
    unsigned int
    n_nodes() const
    {
      return first_node.back();
    }
    /** Number of the first node of this rank. */
    unsigned int
    first_owned() const
    {
      return first_node[rank];
    }
    /** Number of a node of the mesh of this rank; -1: it is tied. */
    int
    number_of(unsigned int node) const;

  private:
    /** Places of nodes along a direction that a part owns. */
    struct Range
    {
      unsigned int begin, end;

      unsigned int
      size() const
      {
        return end - begin;
      }
    };
    Range
    owned_range(unsigned int direction, unsigned int part, bool on_face) const;
    unsigned int
    part_of_place(unsigned int direction,
                  unsigned int place,
                  bool         on_face) const;

    const BulkSpace          &mesh;
    std::array<unsigned, 2>   n_parts; ///< along x and y
    unsigned int              rank, n_levels;
    std::vector<unsigned int> first_node; ///< of each rank, and the end
  };
} // namespace Debond
#endif
