#include <debond/geometry/quadratic_simplex.h>
#include <debond/shapes/mesh_formats.h>

#include <deal.II/base/geometry_info.h>

#include <Eigen/Core>

#include <algorithm>

// A tetrahedron is four hexahedra: each has one of its vertices, the middles of
// three edges and of three faces, and the centre of it all.
namespace Debond
{
  namespace
  {
    /** Barycentric coordinates in a tetrahedron. */
    using Weights = Eigen::Vector4d;

    /** Those of the places in the hexahedron at a vertex, each a product of
     *  three coordinates. */
    std::vector<Weights>
    weights_in_hexahedron(const unsigned int vertex)
    {
      const auto           corners = barycentric_corners<3>(0);
      std::vector<Weights> result;
      for (const dealii::Point<3> &place : places_in_hexahedron())
        {
          Weights own = Weights::Zero(); // of the vertices after this one
          for (unsigned int c = 0; c < 8; ++c)
            own += dealii::GeometryInfo<3>::d_linear_shape_function(place, c) *
                   corners.col(c);
          Weights &w = result.emplace_back();
          for (unsigned int v = 0; v < 4; ++v)
            w[(vertex + v) % 4] = own[v];
        }
      return result;
    }



    /** Makes the nodes of the hexahedra. Corners are shared, and known by the
     *  vertices that they are in the middle of. */
    class Cut
    {
    public:
      explicit Cut(StoredMesh &mesh)
        : mesh(mesh)
      {}

      /** The middle of one to four vertices, at @p x if it is new. */
      unsigned int
      corner(std::vector<unsigned int> vertices, const dealii::Point<3> &x)
      {
        if (vertices.size() == 1)
          return vertices[0];
        std::sort(vertices.begin(), vertices.end());
        const auto [found, is_new] =
          mesh.middles.emplace(vertices, mesh.nodes.size());
        if (is_new)
          mesh.nodes.push_back(x);
        return found->second;
      }

      void
      add_hexahedra(const std::array<unsigned int, 10> &nodes)
      {
        const bool                is_curved = nodes[4] != StoredMesh::none;
        std::vector<unsigned int> places(is_curved ? 27 : 8),
          own(places.size());
        for (unsigned int p = 0; p < places.size(); ++p)
          places[p] = p;
        for (unsigned int vertex = 0; vertex < 4; ++vertex)
          {
            const auto weights = weights_of[vertex];
            for (unsigned int p = 0; p < places.size(); ++p)
              {
                const dealii::Point<3> x = position(nodes, weights[p]);
                if (p >= 8)
                  {
                    own[p] = mesh.nodes.size();
                    mesh.nodes.push_back(x);
                    continue;
                  }
                std::vector<unsigned int> of;
                for (unsigned int v = 0; v < 4; ++v)
                  if (weights[p][v] > 0.)
                    of.push_back(nodes[v]);
                own[p] = corner(of, x);
              }
            mesh.add_hexahedron(own, places);
          }
      }

      /** The three faces into which hexahedra cut a triangle. */
      void
      add_faces(const std::array<unsigned int, 4>        &triangle,
                std::vector<std::array<unsigned int, 4>> &faces)
      {
        for (unsigned int v = 0; v < 3; ++v)
          {
            const unsigned int a = triangle[v], b = triangle[(v + 1) % 3],
                               c = triangle[(v + 2) % 3];
            const auto middle    = [&](const std::vector<unsigned int> &of) {
              dealii::Point<3> x;
              for (const unsigned int node : of)
                x += mesh.nodes[node] * (1. / of.size());
              return corner(of, x);
            };
            faces.push_back(
              {{a, middle({a, b}), middle({a, c}), middle({a, b, c})}});
          }
      }

    private:
      // Of ten nodes the functions are those of the second order, the last six
      // of which belong to edges.
      dealii::Point<3>
      position(const std::array<unsigned int, 10> &nodes,
               const Weights                      &w) const
      {
        const bool       is_curved = nodes[4] != StoredMesh::none;
        dealii::Point<3> x;
        for (unsigned int v = 0; v < 4; ++v)
          x +=
            mesh.nodes[nodes[v]] * (is_curved ? w[v] * (2. * w[v] - 1.) : w[v]);
        for (unsigned int e = 0; is_curved && e < 6; ++e)
          x += mesh.nodes[nodes[4 + e]] *
               (4. * w[StoredMesh::edges[e][0]] * w[StoredMesh::edges[e][1]]);
        return x;
      }

      StoredMesh                               &mesh;
      const std::array<std::vector<Weights>, 4> weights_of{
        {weights_in_hexahedron(0),
         weights_in_hexahedron(1),
         weights_in_hexahedron(2),
         weights_in_hexahedron(3)}};
    };
  } // namespace



  void
  StoredMesh::cut_tetrahedra()
  {
    if (tetrahedra.empty() || !hexahedra.empty() || !other_solids.empty())
      return; // what is not of one kind is refused
    Cut cut(*this);
    for (const auto &nodes : tetrahedra)
      cut.add_hexahedra(nodes);
    for (auto &[name, group] : groups)
      {
        std::vector<std::array<unsigned int, 4>> faces;
        for (const auto &face : group)
          if (face[3] == none)
            cut.add_faces(face, faces);
          else
            faces.push_back(face);
        group.swap(faces);
      }
  }
} // namespace Debond
