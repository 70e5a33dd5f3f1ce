#pragma once

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace Debond
{
  /** A body as a file has it, tetrahedra as hexahedra. Lengths are in mm. */
  struct BodyMesh
  {
    /** One piece, whose vertices are the corners of the hexahedra. Boundary ids
     *  are those of Boundary: faces named contact, held, slides x and slides y,
     *  all others free. */
    dealii::Triangulation<3> triangulation;
    /** 1: hexahedra with 8 nodes, 2: with 20 or 27. */
    unsigned int order = 1;
    /** Whether cells are none that are tangled without their other nodes. */
    bool has_cells_of_corners = true;
    /** Around its vertices, and around those of the contact face [mm]. */
    dealii::BoundingBox<3> box, box_of_face;
    unsigned int           n_contact_faces = 0;
    std::string            identity; ///< of the file, see identity_of()

    /** Cells in x, y, z of a lattice that has as many in all and at the contact
     *  face. */
    std::array<unsigned int, 3>
    lattice_of_cells() const;

    /** Where the 27 support points of FE_Q<3>(2) of a cell are, in deal.II's
     *  order. The map of the cell interpolates them; of order 1 it is
     *  trilinear. */
    std::vector<dealii::Point<3>>
    points_of_second_order(
      const dealii::Triangulation<3>::cell_iterator &cell) const;

    /** Whether its cells are parts of tetrahedra. */
    bool
    has_tetrahedra() const
    {
      return !ends.empty();
    }
    /** Of these, or of triangles on the boundary, the part that has these
     *  corners, in deal.II's order. */
    struct PartOfSimplex
    {
      /** Vertices of the mesh at its nodes, in the order of
       *  quadratic_functions(), as axes of the part are. */
      std::vector<unsigned int> nodes;
      unsigned int              first_corner = 0; ///< where vertex 0 is
    };
    PartOfSimplex
    part_of_simplex(const std::vector<unsigned int> &corners) const;

    /** Vertices of an edge, a face or a cell, ascending, then invalid ones:
     *  what tells it from others in whatever order deal.II has its vertices. */
    using Vertices = std::array<unsigned int, 8>;
    /** Nodes in the middle of edges, faces and cells, of order 2. */
    std::map<Vertices, dealii::Point<3>> middles;
    /** Vertices of tetrahedra that each vertex is in the middle of, ascending,
     *  itself at one of these; and which one is. Empty: they are hexahedra. */
    std::vector<std::vector<unsigned int>>            ends;
    std::map<std::vector<unsigned int>, unsigned int> between;
    /** Whether edges of the contact face are arcs of circles, or straight,
     *  exactly. */
    bool has_arcs = false;
    /** Of a contact face that is part of a sphere; a radius of 0: it is none.
     */
    dealii::Point<3> sphere_centre;
    double           sphere_radius = 0.;
  };

  /** Of the corners @p numbers of a cell with these vertices. */
  template <typename Cell>
  BodyMesh::Vertices
  vertices_of(const std::vector<unsigned int> &numbers, const Cell &vertex)
  {
    BodyMesh::Vertices result;
    result.fill(dealii::numbers::invalid_unsigned_int);
    for (unsigned int i = 0; i < numbers.size(); ++i)
      result[i] = vertex(numbers[i]);
    std::sort(result.begin(), result.end());
    return result;
  }
} // namespace Debond
