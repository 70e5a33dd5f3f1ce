#pragma once

#include <debond/shapes/body_mesh.h>
#include <debond/shapes/boundary.h>
#include <debond/shapes/mesh_formats.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  /** "at (1, 2, 3) mm". */
  std::string
  at_place(const dealii::Point<3> &x);



  /** From what a file says to a mesh that a bulk can be made of. */
  class MeshBuilder
  {
  public:
    /** Both live longer than this. */
    MeshBuilder(const StoredMesh &stored, const FileRefusal &refuse);

    std::shared_ptr<BodyMesh> mesh = std::make_shared<BodyMesh>();

  private:
    using Vertices = BodyMesh::Vertices;
    using Point    = dealii::Point<3>;
    /** Of a hexahedron at all its places. */
    using Points = std::array<Point, 27>;

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
    bool
    is_tangled(const Points &x) const;
    Points
    without_middles(const Points &x) const;
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
    number_simplices();
    void
    build();

    Vertices
    vertices(const unsigned int cell, const unsigned int place) const
    {
      return vertices_of(corners_of_places()[place], [&](const unsigned int c) {
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

  /**
   * Reads a mesh of Gmsh (.msh) or Abaqus (.inp), with the names of
   * its groups of faces. Throws an EntryError of @p entry, "Bone / Mesh file",
   * that says what is wrong with the file: what the bulk cannot be made of is
   * refused here.
   */
  std::shared_ptr<const BodyMesh>
  read_mesh_file(const std::string &filename, const std::string &entry);
} // namespace Debond
