#include <debond/shapes/mesh_formats.h>

#include <deal.II/fe/fe_q.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <locale>

namespace Debond
{
  const std::vector<dealii::Point<3>> &
  places_in_hexahedron()
  {
    static const std::vector<dealii::Point<3>> places =
      dealii::FE_Q<3>(2).get_unit_support_points();
    return places;
  }



  void
  StoredMesh::add_hexahedron(const std::vector<unsigned int> &nodes,
                             const std::vector<unsigned int> &places)
  {
    nodes_per_hexahedron.insert(nodes.size());
    hexahedra.emplace_back();
    hexahedra.back().fill(StoredMesh::none);
    for (unsigned int n = 0; n < nodes.size(); ++n)
      hexahedra.back()[places[n]] = nodes[n];
  }



  const std::vector<std::vector<unsigned int>> &
  corners_of_places()
  {
    static const auto corners = []() {
      std::vector<std::vector<unsigned int>> result;
      for (const dealii::Point<3> &place : places_in_hexahedron())
        {
          result.emplace_back();
          for (unsigned int c = 0; c < 8; ++c)
            {
              const auto from = places_in_hexahedron()[c] - place;
              if (std::max(
                    {std::abs(from[0]), std::abs(from[1]), std::abs(from[2])}) <
                  0.6)
                result.back().push_back(c);
            }
        }
      return result;
    }();
    return corners;
  }



  StoredMesh
  read_stored_mesh(const std::string &filename, const FileRefusal &refuse)
  {
    const std::string ending =
      boost::to_lower_copy(std::filesystem::path(filename).extension().string(),
                           std::locale::classic());
    StoredMesh mesh;
    if (ending == ".inp")
      mesh = read_abaqus_mesh(filename, refuse);
    else if (ending == ".msh")
      mesh = read_gmsh_mesh(filename, refuse);
    else
      refuse(std::string("expected a file .msh of Gmsh or .inp of Abaqus") +
             (ending == ".vtk" ? ": Gmsh or meshio write .msh of it" : ""));
    mesh.cut_tetrahedra();
    return mesh;
  }
} // namespace Debond
