#include <debond/shapes/body_mesh.h>
#include <debond/shapes/mesh_formats.h>

#include <algorithm>
#include <cmath>

namespace Debond
{
  std::array<unsigned int, 3>
  BodyMesh::lattice_of_cells() const
  {
    const auto rounded = [](const double x) -> unsigned int {
      return std::lround(std::max(1., x));
    };
    const unsigned int across = rounded(std::sqrt(n_contact_faces));
    return {
      {across,
       across,
       rounded(double(triangulation.n_active_cells()) / n_contact_faces)}};
  }



  BodyMesh::PartOfSimplex
  BodyMesh::part_of_simplex(const std::vector<unsigned int> &corners) const
  {
    PartOfSimplex result;
    while (ends[corners[result.first_corner]].size() > 1)
      ++result.first_corner;
    const unsigned int vertex_0 = corners[result.first_corner];
    result.nodes                = {vertex_0};
    for (unsigned int d = 1; d < corners.size(); d *= 2)
      {
        const auto &edge = ends[corners[result.first_corner ^ d]];
        result.nodes.push_back(edge[0] == vertex_0 ? edge[1] : edge[0]);
      }
    for (unsigned int i = 0, n = result.nodes.size(); i < n; ++i)
      for (unsigned int j = i + 1; j < n; ++j)
        {
          const auto [first, last] =
            std::minmax(result.nodes[i], result.nodes[j]);
          result.nodes.push_back(between.at({first, last}));
        }
    return result;
  }



  std::vector<dealii::Point<3>>
  BodyMesh::points_of_second_order(
    const dealii::Triangulation<3>::cell_iterator &cell) const
  {
    std::vector<dealii::Point<3>> result(27);
    for (unsigned int p = 0; p < 27; ++p)
      {
        const auto &corners = corners_of_places()[p];
        if (p >= 8 && order == 2)
          result[p] =
            middles.at(vertices_of(corners, [&](const unsigned int c) {
              return cell->vertex_index(c);
            }));
        else
          for (const unsigned int c : corners)
            result[p] += cell->vertex(c) / double(corners.size());
      }
    return result;
  }
} // namespace Debond
