#ifndef debond_shapes_cell_collector_h
#define debond_shapes_cell_collector_h

#include <debond/shapes/mesh_formats.h>

#include <array>
#include <functional>
#include <map>
#include <string>

namespace Debond
{
  /** Hexahedra of the second order whose nodes have keys: cells that name the
   *  same key share a node. Nodes are counted in halves of cells. */
  class CellCollector
  {
  public:
    using Key   = std::array<unsigned int, 4>;
    using Place = std::array<unsigned int, 3>;

    StoredMesh stored;

  protected:
    ~CellCollector() = default;
    /** Of a node [mm]. */
    virtual dealii::Point<3>
    position(const Key &key) const = 0;

    /** Adds a cell, two halves long in each direction from @p first on. */
    void
    add(const Place &first, const std::function<Key(const Place &)> &key_of);
    /** Puts a face of the cell that was added last into a @p group. */
    void
    name(const std::string &group, const std::array<unsigned int, 4> &corners);
    /** Makes the edge between two corners of that cell an arc. */
    void
    add_arc(unsigned int corner, unsigned int other, double weight);
    const dealii::Point<3> &
    corner(const unsigned int number) const
    {
      return stored.nodes[stored.hexahedra.back()[number]];
    }

  private:
    std::map<Key, unsigned int> number;
  };

  /** Share of the way over @p n layers at so many halves of layers, graded to
   *  the first or to the last one; nodes between two layers are in their
   *  middle. */
  double
  part_of_way(unsigned int halves,
              unsigned int n,
              bool         to_first,
              double       grading);
} // namespace Debond
#endif
