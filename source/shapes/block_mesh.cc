#include <debond/shapes/block_mesh.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/numerics/rtree.h>

#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace Debond
{
  namespace
  {
    using Point = dealii::Point<3>;

    /** Nodes at the sides of blocks, and their numbers. */
    using NodesAtSides = dealii::RTree<std::pair<Point, unsigned int>>;



    /** Numbers of the nodes of a block, the first index fastest. */
    std::vector<unsigned int>
    add_nodes(const Block &block, NodesAtSides &known, StoredMesh &mesh)
    {
      const auto [n_x, n_y, n_z] = block.n_cells;
      const Block::Place last{{2 * n_x, 2 * n_y, 2 * n_z}};
      const double       tolerance =
        1e-9 * block.at({{0, 0, 0}}).distance(block.at(last));
      std::vector<unsigned int>                   numbers;
      std::vector<std::pair<Point, unsigned int>> nearest;
      Block::Place                                p;
      for (p[2] = 0; p[2] <= last[2]; ++p[2])
        for (p[1] = 0; p[1] <= last[1]; ++p[1])
          for (p[0] = 0; p[0] <= last[0]; ++p[0])
            {
              const Point x = block.at(p);
              numbers.push_back(mesh.nodes.size());
              bool is_at_side = false;
              for (unsigned int d = 0; d < 3; ++d)
                is_at_side = is_at_side || p[d] == 0 || p[d] == last[d];
              nearest.clear();
              if (is_at_side)
                known.query(boost::geometry::index::nearest(x, 1),
                            std::back_inserter(nearest));
              if (!nearest.empty() && nearest[0].first.distance(x) < tolerance)
                {
                  numbers.back() = nearest[0].second;
                  continue;
                }
              if (is_at_side)
                known.insert({x, numbers.back()});
              mesh.nodes.push_back(x);
            }
      return numbers;
    }



    void
    add_block(const Block &block, NodesAtSides &known, StoredMesh &mesh)
    {
      using Cell                        = dealii::GeometryInfo<3>;
      const auto [n_x, n_y, n_z]        = block.n_cells;
      const auto                numbers = add_nodes(block, known, mesh);
      std::vector<unsigned int> nodes(27), places(27);
      std::iota(places.begin(), places.end(), 0);
      for (unsigned int k = 0; k < n_z; ++k)
        for (unsigned int j = 0; j < n_y; ++j)
          for (unsigned int i = 0; i < n_x; ++i)
            {
              for (const unsigned int p : places)
                {
                  const Point x =
                    2. * (places_in_hexahedron()[p] + Point(i, j, k));
                  nodes[p] = numbers[std::lround(
                    x[0] + (2 * n_x + 1) * (x[1] + (2 * n_y + 1) * x[2]))];
                }
              mesh.add_hexahedron(nodes, places);
              const bool is_at[]{i == 0,
                                 i == n_x - 1,
                                 j == 0,
                                 j == n_y - 1,
                                 k == 0,
                                 k == n_z - 1};
              for (unsigned int f = 0; f < 6; ++f)
                if (is_at[f] && !block.sides[f].empty())
                  {
                    auto &face = mesh.groups[block.sides[f]].emplace_back();
                    for (unsigned int v = 0; v < 4; ++v)
                      face[v] = nodes[Cell::face_to_cell_vertices(f, v)];
                  }
            }
    }
  } // namespace



  StoredMesh
  mesh_of_blocks(const std::vector<Block> &blocks)
  {
    StoredMesh   mesh;
    NodesAtSides known;
    for (const Block &block : blocks)
      add_block(block, known, mesh);
    return mesh;
  }



  double
  part_of_way(const unsigned int halves,
              const unsigned int n,
              const bool         to_first,
              const double       grading)
  {
    const auto end = [&](const unsigned int layer) {
      const double part = static_cast<double>(layer) / n;
      return to_first ? std::pow(part, grading) :
                        1. - std::pow(1. - part, grading);
    };
    return 0.5 * (end(halves / 2) + end((halves + 1) / 2));
  }
} // namespace Debond
