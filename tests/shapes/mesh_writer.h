#pragma once

// Writes a body that a scene makes as a file of Gmsh, for Shape = file.

#include <debond/bulk/bulk_space.h>

#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

/** Where a point of the unit cell is, of the cell of this number. */
using PlaceInCell =
  std::function<dealii::Point<3>(unsigned int, const dealii::Point<3> &)>;

/** Of the first or of the second order (27 nodes), with the names of its
 *  boundary. Cells and the corners they begin with are shuffled if asked. */
inline void
write_msh(const dealii::Triangulation<3> &triangulation,
          const PlaceInCell              &place_in_cell,
          const std::string              &filename,
          const unsigned int              order    = 1,
          const bool                      shuffled = false)
{
  using namespace dealii;
  // nodes of Gmsh in coordinates of the unit cell
  std::vector<Point<3>> nodes_of_cell;
  for (const auto &p : std::vector<std::array<double, 3>>{
         {{0, 0, 0}},   {{1, 0, 0}},   {{1, 1, 0}},   {{0, 1, 0}},
         {{0, 0, 1}},   {{1, 0, 1}},   {{1, 1, 1}},   {{0, 1, 1}},
         {{.5, 0, 0}},  {{0, .5, 0}},  {{0, 0, .5}},  {{1, .5, 0}},
         {{1, 0, .5}},  {{.5, 1, 0}},  {{1, 1, .5}},  {{0, 1, .5}},
         {{.5, 0, 1}},  {{0, .5, 1}},  {{1, .5, 1}},  {{.5, 1, 1}},
         {{.5, .5, 0}}, {{.5, 0, .5}}, {{0, .5, .5}}, {{1, .5, .5}},
         {{.5, 1, .5}}, {{.5, .5, 1}}, {{.5, .5, .5}}})
    nodes_of_cell.emplace_back(p[0], p[1], p[2]);
  nodes_of_cell.resize(order == 1 ? 8 : 27);

  std::vector<Point<3>>                       places;
  std::map<std::array<long, 3>, unsigned int> number_of;
  const auto                                  node_at = [&](const Point<3> &p) {
    const std::array<long, 3> key{{std::lround(1e7 * p[0]),
                                   std::lround(1e7 * p[1]),
                                   std::lround(1e7 * p[2])}};
    const auto [found, is_new] = number_of.emplace(key, places.size() + 1);
    if (is_new)
      places.push_back(p);
    return found->second;
  };
  const auto place = [&](const auto &cell, const Point<3> &p) {
    return node_at(place_in_cell(cell->active_cell_index(), p));
  };

  std::vector<std::string> elements;
  const auto add = [&](const int type, const int tag, const auto &nodes) {
    std::string text = std::to_string(type) + " 2 " + std::to_string(tag) +
                       " " + std::to_string(tag);
    for (const unsigned int node : nodes)
      text += " " + std::to_string(node);
    elements.push_back(text);
  };
  unsigned int turn = 0;
  for (const auto &cell : triangulation.active_cell_iterators())
    {
      std::vector<unsigned int> nodes;
      const bool                turned = shuffled && turn++ % 2 == 1;
      for (const Point<3> &p : nodes_of_cell) // a third of a turn
        nodes.push_back(place(cell, turned ? Point<3>(p[2], p[0], p[1]) : p));
      add(order == 1 ? 5 : 12, 9, nodes);
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f) &&
            cell->face(f)->boundary_id() != Debond::Boundary::free)
          {
            const unsigned int d = f / 2, a = (d + 1) % 3, b = (d + 2) % 3;
            std::vector<unsigned int> face;
            for (const auto &[s, t] :
                 std::vector<std::array<double, 2>>{{{0, 0}},
                                                    {{1, 0}},
                                                    {{1, 1}},
                                                    {{0, 1}},
                                                    {{.5, 0}},
                                                    {{1, .5}},
                                                    {{.5, 1}},
                                                    {{0, .5}},
                                                    {{.5, .5}}})
              {
                Point<3> p;
                p[d] = f % 2;
                p[a] = s;
                p[b] = t;
                if (face.size() < (order == 1 ? 4u : 9u))
                  face.push_back(place(cell, p));
              }
            add(order == 1 ? 3 : 10, cell->face(f)->boundary_id(), face);
          }
    }
  if (shuffled)
    std::reverse(elements.begin(), elements.end());

  std::ofstream out(filename);
  out.precision(17);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n"
         "2 1 \"contact\"\n2 2 \"held\"\n2 3 \"slides x\"\n2 4 \"slides y\"\n"
         "3 9 \"body\"\n$EndPhysicalNames\n$Nodes\n"
      << places.size() << '\n';
  for (unsigned int k = 0; k < places.size(); ++k)
    out << k + 1 << ' ' << places[k] << '\n';
  out << "$EndNodes\n$Elements\n" << elements.size() << '\n';
  for (unsigned int k = 0; k < elements.size(); ++k)
    out << k + 1 << ' ' << elements[k] << '\n';
  out << "$EndElements\n";
}



/** A body as a scene makes it. */
inline void
write_msh(const Debond::BulkSpace &body,
          const std::string       &filename,
          const unsigned int       order    = 1,
          const bool               shuffled = false)
{
  write_msh(
    body.dof_handler().get_triangulation(),
    [&](const unsigned int cell, const dealii::Point<3> &p) {
      const Eigen::Vector3d X =
        Debond::CellFunctions(body, body.cells()[cell]).position(p);
      return dealii::Point<3>(X[0], X[1], X[2]);
    },
    filename,
    order,
    shuffled);
}



/** A coin of radius R and height H of cells in a square and four rings around
 *  it, halved @p n times, with its contact face at the height @p lift, @p
 * within a radius; the ring around that has no name. */
inline void
write_coin(const std::string &filename,
           const double       R,
           const double       H,
           const unsigned int n,
           const unsigned int order,
           const double       lift   = 0.,
           const double       within = 1e9)
{
  using namespace dealii;
  Triangulation<2> disk;
  GridGenerator::hyper_ball(disk, {}, R);
  TransfiniteInterpolationManifold<2> inside;
  for (const auto &cell : disk.active_cell_iterators())
    cell->set_manifold_id(1);
  inside.initialize(disk);
  disk.set_manifold(1, inside);
  disk.refine_global(n);
  Triangulation<3> coin;
  GridGenerator::extrude_triangulation(disk, 3, H, coin);
  for (const auto &face : coin.active_face_iterators())
    if (face->at_boundary())
      face->set_boundary_id(
        face->center()[2] < 1e-9 * H &&
            std::hypot(face->center()[0], face->center()[1]) < within ?
          Debond::Boundary::contact :
        face->center()[2] > (1. - 1e-9) * H ? Debond::Boundary::held :
                                              Debond::Boundary::free);
  // each cell stands on one of the disk
  const MappingQ<2>                                   mapping(order);
  std::vector<Triangulation<2>::active_cell_iterator> bases;
  std::vector<double>                                 bottoms;
  for (const auto &cell : coin.active_cell_iterators())
    {
      bottoms.push_back(cell->vertex(0)[2]);
      for (const auto &base : disk.active_cell_iterators())
        {
          bool is_base = true;
          for (const unsigned int v : base->vertex_indices())
            is_base =
              is_base &&
              std::hypot(base->vertex(v)[0] - cell->vertex(v)[0],
                         base->vertex(v)[1] - cell->vertex(v)[1]) < 1e-10;
          if (is_base)
            bases.push_back(base);
        }
    }
  AssertThrow(bases.size() == coin.n_active_cells(), ExcInternalError());
  write_msh(
    coin,
    [&](const unsigned int cell, const Point<3> &p) {
      const Point<2> x =
        mapping.transform_unit_to_real_cell(bases[cell], {p[0], p[1]});
      return Point<3>(x[0], x[1], lift + bottoms[cell] + 0.5 * H * p[2]);
    },
    filename,
    order);
}
