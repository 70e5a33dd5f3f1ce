#include <debond/shapes/boundary.h>
#include <debond/shapes/mesh_file.h>
#include <debond/shapes/mesh_formats.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_tools.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <filesystem>
#include <locale>
#include <numeric>

namespace Debond
{
  const std::vector<dealii::Point<3>> &
  places_in_hexahedron()
  {
    static const std::vector<dealii::Point<3>> places =
      dealii::FE_Q<3>(2).get_unit_support_points();
    return places;
  }



  const std::vector<unsigned int> &
  common_places()
  {
    static const std::vector<unsigned int> all = []() {
      const std::vector<unsigned int> corners{0, 1, 3, 2, 4, 5, 7, 6};
      std::vector<unsigned int>       places = corners;
      for (const auto &[a, b] : std::vector<std::pair<int, int>>{{0, 1},
                                                                 {1, 2},
                                                                 {2, 3},
                                                                 {3, 0},
                                                                 {4, 5},
                                                                 {5, 6},
                                                                 {6, 7},
                                                                 {7, 4},
                                                                 {0, 4},
                                                                 {1, 5},
                                                                 {2, 6},
                                                                 {3, 7}})
        for (unsigned int p = 8; p < 20; ++p)
          if ((places_in_hexahedron()[corners[a]] +
               places_in_hexahedron()[corners[b]])
                .distance(2. * places_in_hexahedron()[p]) < 0.1)
            places.push_back(p);
      return places;
    }();
    return all;
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



  namespace
  {
    using Geometry = dealii::GeometryInfo<3>;
    using Vertices = FileMesh::Vertices;
    using Point    = dealii::Point<3>;
    /** Of a hexahedron at all its places. */
    using Points = std::array<Point, 27>;

    /** Corners of the edge, the face or the cell that each place is the middle
     *  of. */
    const std::vector<std::vector<unsigned int>> &
    corners_of_places()
    {
      static const auto corners = []() {
        std::vector<std::vector<unsigned int>> result;
        for (const Point &place : places_in_hexahedron())
          {
            result.emplace_back();
            for (unsigned int c = 0; c < 8; ++c)
              {
                const auto from = places_in_hexahedron()[c] - place;
                if (std::max({std::abs(from[0]),
                              std::abs(from[1]),
                              std::abs(from[2])}) < 0.6)
                  result.back().push_back(c);
              }
          }
        return result;
      }();
      return corners;
    }



    /** Of the corners @p numbers of a cell with these vertices. */
    template <typename Cell>
    Vertices
    vertices_of(const std::vector<unsigned int> &numbers, const Cell &vertex)
    {
      Vertices result;
      result.fill(dealii::numbers::invalid_unsigned_int);
      for (unsigned int i = 0; i < numbers.size(); ++i)
        result[i] = vertex(numbers[i]);
      std::sort(result.begin(), result.end());
      return result;
    }



    /** Which of so many things are connected. */
    class Pieces
    {
    public:
      explicit Pieces(const unsigned int n)
        : next(n)
      {
        std::iota(next.begin(), next.end(), 0);
      }
      unsigned int
      of(unsigned int i)
      {
        while (next[i] != i)
          i = next[i] = next[next[i]];
        return i;
      }
      void
      join(const unsigned int i, const unsigned int j)
      {
        next[of(i)] = of(j);
      }
      unsigned int
      number() const
      {
        unsigned int n = 0;
        for (unsigned int i = 0; i < next.size(); ++i)
          n += next[i] == i;
        return n;
      }

    private:
      std::vector<unsigned int> next;
    };



    std::string
    at(const Point &x)
    {
      return "at (" + to_text(x[0], 4) + ", " + to_text(x[1], 4) + ", " +
             to_text(x[2], 4) + ") mm";
    }



    /** "1 face", "3 faces". */
    std::string
    counted(const std::size_t  n,
            const std::string &one,
            const std::string &more)
    {
      return std::to_string(n) + " " + (n == 1 ? one : more);
    }



    /** From what a file says to a mesh that a bulk can be made of. */
    class MeshBuilder
    {
    public:
      MeshBuilder(const StoredMesh &stored, const FileRefusal &refuse)
        : stored(stored)
        , refuse(refuse)
      {
        check_kinds();
        place_points();
        number_vertices();
        check_shapes();
        check_coincident_vertices();
        find_faces();
        name_faces();
        check_pieces();
        check_contact_face();
        build();
      }

      std::shared_ptr<FileMesh> mesh = std::make_shared<FileMesh>();

    private:
      struct Face
      {
        unsigned int               n_cells = 0, cell = 0;
        dealii::types::boundary_id id = Boundary::free;
        Point                      centre;
      };

      void
      check_kinds() const;
      void
      place_points();
      void
      number_vertices();
      void
      check_shapes() const;
      void
      check_middles(const Points &x) const;
      bool
      is_tangled(const Points &x) const;
      void
      check_coincident_vertices();
      void
      find_faces();
      void
      name_faces();
      void
      name_face(const std::array<unsigned int, 4> &corners,
                dealii::types::boundary_id         id,
                const std::string                 &name);
      void
      check_pieces();
      void
      check_contact_face() const;
      void
      build();

      Vertices
      vertices(const unsigned int cell, const unsigned int place) const
      {
        return vertices_of(corners_of_places()[place],
                           [&](const unsigned int c) {
                             return cells[cell].vertices[c];
                           });
      }

      const StoredMesh                &stored;
      const FileRefusal               &refuse;
      std::vector<Points>              points; ///< of each cell
      std::vector<unsigned int>        vertex; ///< of each node, or none
      std::vector<Point>               vertex_points;
      std::vector<dealii::CellData<3>> cells;
      double                           shortest_edge = 0.;
      std::map<Vertices, Face>         faces;
    };



    void
    MeshBuilder::check_kinds() const
    {
      if (!stored.other_solids.empty())
        {
          std::string others;
          for (const auto &[kind, n] : stored.other_solids)
            others +=
              (others.empty() ? "" : ", ") + std::to_string(n) + " " + kind;
          refuse(
            "it has solids that are no hexahedra with 8, 20 or 27 nodes (" +
            others + "): expected hexahedra only");
        }
      if (stored.hexahedra.empty())
        refuse("it has no hexahedra");
      if (stored.nodes_per_hexahedron.size() > 1)
        refuse("it has hexahedra with " +
               std::to_string(*stored.nodes_per_hexahedron.begin()) +
               " and with " +
               std::to_string(*stored.nodes_per_hexahedron.rbegin()) +
               " nodes: expected one kind");
    }



    // Of hexahedra with 20 nodes the middles of faces and of the cell follow
    // from the functions of serendipity elements.
    void
    MeshBuilder::place_points()
    {
      mesh->order         = *stored.nodes_per_hexahedron.begin() > 8 ? 2 : 1;
      const auto &corners = corners_of_places();
      for (const auto &nodes : stored.hexahedra)
        {
          points.emplace_back();
          Points &x = points.back();
          for (unsigned int p = 0; p < 27; ++p)
            if (nodes[p] != StoredMesh::none)
              {
                x[p] = stored.nodes[nodes[p]];
                if (!std::isfinite(x[p].norm()))
                  refuse("a node of its hexahedra is no finite point");
              }
            else
              {
                const auto &own = corners[p];
                for (const unsigned int c : own)
                  x[p] += x[c] * (mesh->order == 1 ? 1. / own.size() : -0.25);
                for (unsigned int e = 8; mesh->order == 2 && e < 20; ++e)
                  if (std::includes(own.begin(),
                                    own.end(),
                                    corners[e].begin(),
                                    corners[e].end()))
                    x[p] += x[e] * (own.size() == 4 ? 0.5 : 0.25);
              }
        }
    }



    void
    MeshBuilder::number_vertices()
    {
      vertex.assign(stored.nodes.size(), StoredMesh::none);
      for (unsigned int cell = 0; cell < points.size(); ++cell)
        {
          cells.emplace_back();
          for (unsigned int c = 0; c < 8; ++c)
            {
              unsigned int &v = vertex[stored.hexahedra[cell][c]];
              if (v == StoredMesh::none)
                {
                  v = vertex_points.size();
                  vertex_points.push_back(points[cell][c]);
                }
              cells.back().vertices[c] = v;
            }
          const Vertices all = vertices(cell, 26);
          if (std::adjacent_find(all.begin(), all.end()) != all.end())
            refuse("the hexahedron " + at(points[cell][26]) +
                   " has a corner twice: expected eight corners");
        }
    }



    /** The functions of FE_Q<3>(2) have these gradients at the corners of a
     *  cell and at the points of integration. */
    const std::vector<std::array<dealii::Tensor<1, 3>, 27>> &
    gradients()
    {
      static const auto table = []() {
        const dealii::FE_Q<3>   element(2);
        std::vector<Point>      at(places_in_hexahedron().begin(),
                              places_in_hexahedron().begin() + 8);
        const dealii::QGauss<3> quadrature(3);
        at.insert(at.end(),
                  quadrature.get_points().begin(),
                  quadrature.get_points().end());
        std::vector<std::array<dealii::Tensor<1, 3>, 27>> result(at.size());
        for (unsigned int q = 0; q < at.size(); ++q)
          for (unsigned int a = 0; a < 27; ++a)
            result[q][a] = element.shape_grad(a, at[q]);
        return result;
      }();
      return table;
    }



    // All determinants may be negative: deal.II turns such a cell around.
    bool
    MeshBuilder::is_tangled(const Points &x) const
    {
      const double size = x[0].distance(x[7]);
      double       sign = 0.;
      for (const auto &gradient : gradients())
        {
          dealii::Tensor<2, 3> F;
          for (unsigned int a = 0; a < 27; ++a)
            F += outer_product(x[a], gradient[a]);
          const double det = determinant(F);
          if (sign == 0.)
            sign = det > 0. ? 1. : -1.;
          if (!(sign * det > 1e-9 * size * size * size))
            return true;
        }
      return false;
    }



    void
    MeshBuilder::check_middles(const Points &x) const
    {
      for (unsigned int e = 8; e < 20; ++e)
        {
          const Point &a = x[corners_of_places()[e][0]],
                      &b = x[corners_of_places()[e][1]];
          if (x[e].distance(a + 0.5 * (b - a)) > 0.5 * a.distance(b))
            refuse("the node in the middle of the edge " +
                   at(a + 0.5 * (b - a)) + " is far from it, " + at(x[e]) +
                   ": expected half of its length at most");
        }
    }



    void
    MeshBuilder::check_shapes() const
    {
      unsigned int  n_tangled = 0;
      const Points *first     = nullptr;
      for (const Points &x : points)
        {
          if (mesh->order == 2)
            check_middles(x);
          if (is_tangled(x))
            {
              ++n_tangled;
              first = first ? first : &x;
            }
        }
      if (first)
        refuse(counted(n_tangled, "hexahedron is", "hexahedra are") +
               " tangled or flat (the determinant of the Jacobian changes "
               "its sign), the first one " +
               at((*first)[26]));
    }



    void
    MeshBuilder::check_coincident_vertices()
    {
      shortest_edge = points[0][0].distance(points[0][1]);
      for (const Points &x : points)
        for (unsigned int e = 8; e < 20; ++e)
          shortest_edge = std::min(shortest_edge,
                                   x[corners_of_places()[e][0]].distance(
                                     x[corners_of_places()[e][1]]));
      // along a direction that no mesh has planes across
      const dealii::Tensor<1, 3> along =
        Point(0.6180339887, 0.5436890127, 0.5677143630);
      std::vector<std::pair<double, unsigned int>> sorted;
      for (unsigned int v = 0; v < vertex_points.size(); ++v)
        sorted.emplace_back(vertex_points[v] * along, v);
      std::sort(sorted.begin(), sorted.end());
      const double tolerance = 1e-3 * shortest_edge;
      unsigned int n         = 0;
      const Point *first     = nullptr;
      for (std::size_t i = 0; i < sorted.size(); ++i)
        for (std::size_t j = i + 1;
             j < sorted.size() && sorted[j].first < sorted[i].first + tolerance;
             ++j)
          {
            const Point &a = vertex_points[sorted[i].second];
            if (a.distance(vertex_points[sorted[j].second]) < tolerance)
              {
                ++n;
                first = first ? first : &a;
              }
          }
      if (first)
        refuse("in " + counted(n, "place", "places") +
               " two nodes of hexahedra coincide, " + at(*first) +
               (n > 1 ? " for one" : "") + ": merge duplicate nodes");
    }



    void
    MeshBuilder::find_faces()
    {
      for (unsigned int cell = 0; cell < cells.size(); ++cell)
        for (unsigned int p = 20; p < 26; ++p)
          {
            Face &face  = faces[vertices(cell, p)];
            face.cell   = cell;
            face.centre = points[cell][p];
            if (++face.n_cells > 2)
              refuse("the face " + at(face.centre) +
                     " is one of three hexahedra: expected two at most");
          }
    }



    /** Names differ neither by case nor by what stands between words. */
    dealii::types::boundary_id
    id_of_name(std::string name)
    {
      static const std::map<std::string, dealii::types::boundary_id> ids{
        {"contact", Boundary::contact},
        {"held", Boundary::held},
        {"slides x", Boundary::slides_x},
        {"slides y", Boundary::slides_y}};
      boost::to_lower(name, std::locale::classic());
      std::replace(name.begin(), name.end(), '_', ' ');
      std::replace(name.begin(), name.end(), '-', ' ');
      const auto found = ids.find(name);
      return found == ids.end() ? Boundary::free : found->second;
    }



    void
    MeshBuilder::name_face(const std::array<unsigned int, 4> &corners,
                           const dealii::types::boundary_id   id,
                           const std::string                 &name)
    {
      std::vector<unsigned int> numbers;
      Point                     centre;
      for (unsigned int c = 0; c < 4 && corners[c] != StoredMesh::none; ++c)
        {
          numbers.push_back(c);
          centre += stored.nodes[corners[c]];
        }
      centre /= numbers.size();
      const auto found =
        faces.find(vertices_of(numbers, [&](const unsigned int c) {
          return vertex[corners[c]];
        }));
      if (found == faces.end())
        refuse("a face named '" + name + "', " + at(centre) +
               ", is no face of a hexahedron");
      else if (found->second.n_cells > 1)
        refuse("a face named '" + name + "', " + at(centre) +
               ", is between two hexahedra: expected one of the boundary");
      else if (found->second.id != Boundary::free && found->second.id != id)
        refuse("the face " + at(centre) + " is doubly named, '" + name +
               "' the second time: expected one of the names");
      else
        found->second.id = id;
    }



    void
    MeshBuilder::name_faces()
    {
      std::string                          names;
      std::set<dealii::types::boundary_id> given;
      for (const auto &[name, group] : stored.groups)
        {
          names += (names.empty() ? "'" : ", '") + name + "'";
          const auto id = id_of_name(name);
          if (id == Boundary::free)
            continue;
          for (const auto &corners : group)
            {
              name_face(corners, id, name);
              given.insert(id);
            }
        }
      for (const auto &[id, name] : {std::pair{Boundary::contact, "contact"},
                                     std::pair{Boundary::held, "held"}})
        if (given.count(id) == 0)
          refuse(std::string("no face is named ") + name + ": expected " +
                 "groups of faces named contact and held, and slides x, "
                 "slides y if needed; there is " +
                 (names.empty() ? "none" : names));
    }



    void
    MeshBuilder::check_pieces()
    {
      Pieces pieces(cells.size());
      for (unsigned int cell = 0; cell < cells.size(); ++cell)
        for (unsigned int p = 20; p < 26; ++p)
          pieces.join(cell, faces.at(vertices(cell, p)).cell);
      if (pieces.number() > 1)
        refuse("its hexahedra are in " + std::to_string(pieces.number()) +
               " pieces that have no face in common: expected one body");
    }



    void
    MeshBuilder::check_contact_face() const
    {
      std::map<Vertices, std::vector<unsigned int>> faces_at_edge;
      unsigned int                                  n_faces = 0;
      for (unsigned int cell = 0; cell < cells.size(); ++cell)
        {
          unsigned int n_of_cell = 0;
          for (unsigned int p = 20; p < 26; ++p)
            if (faces.at(vertices(cell, p)).id == Boundary::contact)
              {
                ++n_of_cell;
                for (unsigned int e = 8; e < 20; ++e)
                  if (std::includes(corners_of_places()[p].begin(),
                                    corners_of_places()[p].end(),
                                    corners_of_places()[e].begin(),
                                    corners_of_places()[e].end()))
                    faces_at_edge[vertices(cell, e)].push_back(n_faces);
                ++n_faces;
              }
          if (n_of_cell > 1)
            refuse("the hexahedron " + at(points[cell][26]) + " has " +
                   std::to_string(n_of_cell) +
                   " faces named contact: expected one at most; cut it, or "
                   "name one of them otherwise");
        }
      Pieces pieces(n_faces);
      for (const auto &[edge, beside] : faces_at_edge)
        {
          if (beside.size() > 2)
            refuse("more than two faces named contact meet at the edge " +
                   at(0.5 * (vertex_points[edge[0]] + vertex_points[edge[1]])) +
                   ": expected a surface");
          pieces.join(beside.front(), beside.back());
        }
      if (pieces.number() > 1)
        refuse("its contact face is in " + std::to_string(pieces.number()) +
               " pieces that have no edge in common: expected one");
    }



    void
    MeshBuilder::build()
    {
      if (mesh->order == 2)
        for (unsigned int cell = 0; cell < cells.size(); ++cell)
          for (unsigned int p = 8; p < 27; ++p)
            {
              const Point &x     = points[cell][p];
              const auto   given = mesh->middles.emplace(vertices(cell, p), x);
              if (given.first->second.distance(x) > 1e-3 * shortest_edge)
                refuse("two hexahedra have different nodes in the middle of "
                       "what they share, " +
                       at(x) + " and " + at(given.first->second) +
                       ": merge duplicate nodes");
            }
      std::vector<Point> on_face;
      for (const auto &[corners, face] : faces)
        if (face.id == Boundary::contact)
          for (unsigned int c = 0; c < 4; ++c)
            on_face.push_back(vertex_points[corners[c]]);
      mesh->box             = dealii::BoundingBox<3>(vertex_points);
      mesh->box_of_face     = dealii::BoundingBox<3>(on_face);
      mesh->n_contact_faces = on_face.size() / 4;
      dealii::GridTools::invert_cells_with_negative_measure(vertex_points,
                                                            cells);
      dealii::GridTools::consistently_order_cells(cells);
      mesh->triangulation.create_triangulation(vertex_points,
                                               cells,
                                               dealii::SubCellData());
      for (const auto &cell : mesh->triangulation.active_cell_iterators())
        for (const auto f : Geometry::face_indices())
          if (cell->face(f)->at_boundary())
            cell->face(f)->set_boundary_id(
              faces
                .at(vertices_of(corners_of_places()[20 + f],
                                [&](const unsigned int c) {
                                  return cell->vertex_index(c);
                                }))
                .id);
    }



    StoredMesh
    read_stored_mesh(const std::string &filename, const FileRefusal &refuse)
    {
      const std::string ending = boost::to_lower_copy(
        std::filesystem::path(filename).extension().string(),
        std::locale::classic());
      if (ending == ".inp")
        return read_abaqus_mesh(filename, refuse);
      if (ending == ".vtk")
        return read_vtk_mesh(filename, refuse);
      if (ending != ".msh")
        refuse("expected a file .msh of Gmsh, .inp of Abaqus or .vtk of VTK");
      return read_gmsh_mesh(filename, refuse);
    }
  } // namespace



  std::array<unsigned int, 3>
  FileMesh::lattice_of_cells() const
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
  FileMesh::points_of_second_order(
    const dealii::Triangulation<3>::cell_iterator &cell) const
  {
    std::vector<Point> result(27);
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



  std::shared_ptr<const FileMesh>
  read_mesh_file(const std::string &filename, const std::string &entry)
  {
    const FileRefusal refuse = [&](const std::string &why) {
      throw EntryError(entry, why, filename);
    };
    const std::string identity = identity_of(filename);
    const auto        mesh =
      MeshBuilder(read_stored_mesh(filename, refuse), refuse).mesh;
    mesh->identity = identity;
    return mesh;
  }
} // namespace Debond
