#include <debond/shapes/mesh_builder.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_tools.h>

namespace Debond
{
  std::string
  at_place(const dealii::Point<3> &x)
  {
    return "at (" + to_text(x[0], 4) + ", " + to_text(x[1], 4) + ", " +
           to_text(x[2], 4) + ") mm";
  }



  MeshBuilder::MeshBuilder(const StoredMesh &stored, const FileRefusal &refuse)
    : stored(stored)
    , refuse(refuse)
  {
    check_kinds();
    place_points();
    number_vertices();
    check_coincident_vertices();
    find_faces();
    name_faces();
    check_pieces();
    number_simplices();
    build();
    check_contact_face();
  }



  void
  MeshBuilder::check_kinds() const
  {
    if (!stored.other_solids.empty())
      {
        std::string others;
        for (const auto &[kind, n] : stored.other_solids)
          others +=
            (others.empty() ? "" : ", ") + std::to_string(n) + " " + kind;
        refuse("it has other elements than solid hexahedra with 8, 20 or 27 "
               "nodes, or tetrahedra with 4 or 10 (" +
               others + "): expected these only");
      }
    if (!stored.tetrahedra.empty() &&
        stored.hexahedra.size() != 4 * stored.tetrahedra.size())
      refuse("it has hexahedra and tetrahedra: expected one kind");
    if (stored.hexahedra.empty())
      refuse("it has no hexahedra or tetrahedra");
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
        if (is_tangled(x))
          refuse("the hexahedron " + at_place(x[26]) +
                 " is tangled or flat (the determinant of the Jacobian changes "
                 "its sign)");
        if (mesh->order == 2 && mesh->has_cells_of_corners)
          mesh->has_cells_of_corners = !is_tangled(without_middles(x));
      }
  }



  MeshBuilder::Points
  MeshBuilder::without_middles(const Points &x) const
  {
    Points result = x;
    for (unsigned int p = 8; p < 27; ++p)
      {
        result[p]       = Point();
        const auto &own = corners_of_places()[p];
        for (const unsigned int c : own)
          result[p] += x[c] * (1. / own.size());
      }
    return result;
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
      }
  }



  void
  MeshBuilder::number_simplices()
  {
    if (stored.middles.empty())
      return;
    for (unsigned int v = 0; v < vertex_points.size(); ++v)
      mesh->ends.push_back({v});
    for (const auto &[nodes, middle] : stored.middles)
      {
        if (vertex[middle] == StoredMesh::none)
          continue; // of a face that is none of the body
        auto &own = mesh->ends[vertex[middle]];
        own.clear();
        for (const unsigned int node : nodes)
          own.push_back(vertex[node]);
        std::sort(own.begin(), own.end());
        mesh->between[own] = vertex[middle];
      }
  }



  namespace
  {
    /** The functions of FE_Q<3>(2) have these gradients at the corners of a
     *  cell and at the points of integration. */
    const std::vector<std::array<dealii::Tensor<1, 3>, 27>> &
    gradients()
    {
      static const auto table = []() {
        const dealii::FE_Q<3>         element(2);
        std::vector<dealii::Point<3>> at(places_in_hexahedron().begin(),
                                         places_in_hexahedron().begin() + 8);
        const dealii::QGauss<3>       quadrature(3);
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



    /** Of the map of a cell with these points, at place @p q of the table. */
    double
    jacobian(const std::array<dealii::Point<3>, 27> &x, const unsigned int q)
    {
      dealii::Tensor<2, 3> F;
      for (unsigned int a = 0; a < 27; ++a)
        F += outer_product(x[a], gradients()[q][a]);
      return determinant(F);
    }
  } // namespace



  // All determinants may be negative: such a cell is turned around.
  bool
  MeshBuilder::is_tangled(const Points &x) const
  {
    const double size = x[0].distance(x[7]),
                 sign = jacobian(x, 0) > 0. ? 1. : -1.;
    for (unsigned int q = 0; q < gradients().size(); ++q)
      if (!(sign * jacobian(x, q) > 1e-9 * size * size * size))
        return true;
    return false;
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
    for (std::size_t i = 0; i < sorted.size(); ++i)
      for (std::size_t j = i + 1;
           j < sorted.size() && sorted[j].first < sorted[i].first + tolerance;
           ++j)
        {
          const Point &a = vertex_points[sorted[i].second];
          if (a.distance(vertex_points[sorted[j].second]) < tolerance)
            refuse("two nodes of hexahedra coincide, " + at_place(a) +
                   ": merge duplicate nodes");
        }
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
                     at_place(x) + " and " + at_place(given.first->second) +
                     ": merge duplicate nodes");
          }
    mesh->has_arcs      = stored.has_arcs;
    mesh->sphere_centre = stored.sphere_centre;
    mesh->sphere_radius = stored.sphere_radius;
    std::vector<Point> on_face;
    for (const auto &[corners, face] : faces)
      if (face.id == Boundary::contact)
        for (unsigned int c = 0; c < 4; ++c)
          on_face.push_back(vertex_points[corners[c]]);
    mesh->box             = dealii::BoundingBox<3>(vertex_points);
    mesh->box_of_face     = dealii::BoundingBox<3>(on_face);
    mesh->n_contact_faces = on_face.size() / 4;
    // the map of all nodes says which way round a cell is, not that of the
    // corners, which may be tangled
    for (unsigned int cell = 0; cell < cells.size(); ++cell)
      if (auto &corners = cells[cell].vertices; jacobian(points[cell], 0) < 0.)
        std::rotate(corners.begin(), corners.begin() + 4, corners.end());
    dealii::GridTools::consistently_order_cells(cells);
    mesh->triangulation.create_triangulation(vertex_points,
                                             cells,
                                             dealii::SubCellData());
    for (const auto &cell : mesh->triangulation.active_cell_iterators())
      for (const auto f : dealii::GeometryInfo<3>::face_indices())
        if (cell->face(f)->at_boundary())
          cell->face(f)->set_boundary_id(
            faces
              .at(vertices_of(corners_of_places()[20 + f],
                              [&](const unsigned int c) {
                                return cell->vertex_index(c);
                              }))
              .id);
  }



  std::shared_ptr<const BodyMesh>
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
