#pragma once

#include <debond/input/input_file.h>

#include <deal.II/base/point.h>

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace Debond
{
  /** Size of the largest file of a mesh. */
  constexpr unsigned int largest_mesh_MB = 4000;

  /** Where nodes of a hexahedron may be in deal.II's unit cell: the support
   *  points of FE_Q<3>(2), in their order, 8 corners first. */
  const std::vector<dealii::Point<3>> &
  places_in_hexahedron();

  /** Corners of the edge, the face or the cell that each of the places in a
   *  hexahedron is the middle of. */
  const std::vector<std::vector<unsigned int>> &
  corners_of_places();

  /** What a file of a mesh says. */
  struct StoredMesh
  {
    static constexpr unsigned int none = -1;

    std::vector<dealii::Point<3>> nodes;
    /** Of each hexahedron the node at each of its places, or none. */
    std::vector<std::array<unsigned int, 27>> hexahedra;
    /** Of each tetrahedron its vertices, and the middles of these edges or
     *  none. */
    std::vector<std::array<unsigned int, 10>> tetrahedra;
    static constexpr unsigned int             edges[6][2] =
      {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    /** Into how many nodes they have, 8, 20 or 27; all numbers that occur. */
    std::set<unsigned int> nodes_per_hexahedron;
    /** How many solids of other kinds there are. */
    std::map<std::string, unsigned int> other_solids;
    /** Corners of the faces of each named group. Of a triangle the last one is
     *  none. */
    std::map<std::string, std::vector<std::array<unsigned int, 4>>> groups;
    /** Whether edges of the contact face are arcs of circles, or straight,
     *  exactly. */
    bool has_arcs = false;
    /** Of a contact face that is part of a sphere [mm]; a radius of 0: it is
     *  none. */
    dealii::Point<3> sphere_centre;
    double           sphere_radius = 0.;

    /** Where these were cut, ends of the edge, the face or the tetrahedron that
     *  a corner of hexahedra is in the middle of, ascending. */
    std::map<std::vector<unsigned int>, unsigned int> middles;

    /** One with nodes at these places. */
    void
    add_hexahedron(const std::vector<unsigned int> &nodes,
                   const std::vector<unsigned int> &places);
    /** Makes hexahedra of tetrahedra, four each, if there are no others. */
    void
    cut_tetrahedra();
  };

  /** All versions of Gmsh's .msh. */
  StoredMesh
  read_gmsh_mesh(const std::string &filename, const FileRefusal &refuse);

  /** Abaqus' input files, .inp: nodes, elements, sets and surfaces of one part.
   */
  StoredMesh
  read_abaqus_mesh(const std::string &filename, const FileRefusal &refuse);

  /** One of these, by the name of the file. */
  StoredMesh
  read_stored_mesh(const std::string &filename, const FileRefusal &refuse);
} // namespace Debond
