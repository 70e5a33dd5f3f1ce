#include <debond/shapes/body_mesh.h>
#include <debond/shapes/mesh_formats.h>

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
