#include <debond/shapes/faces_of_mesh.h>
#include <debond/shapes/mesh_builder.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/pending/disjoint_sets.hpp>

#include <locale>
#include <set>

// The faces of a mesh from a file: who has them, their names, and that they and
// the cells hang together.
namespace Debond
{
  namespace
  {
    /** Which of so many things are connected. */
    using Pieces = boost::disjoint_sets_with_storage<>;

    unsigned int
    number_of(Pieces pieces, const unsigned int n_things)
    {
      return pieces.count_sets(boost::make_counting_iterator(0U),
                               boost::make_counting_iterator(n_things));
    }



    /** Names differ neither by case nor by what stands between words. */
    dealii::types::boundary_id
    id_of_name(std::string name)
    {
      static const std::map<std::string, dealii::types::boundary_id> ids{
        {"contact", Boundary::contact},
        {"held", Boundary::held},
        {"slides x", Boundary::slides_x},
        {"slides y", Boundary::slides_y},
        {"slides z", Boundary::slides_z},
        {"axial", Boundary::axial}};
      boost::to_lower(name, std::locale::classic());
      std::replace(name.begin(), name.end(), '_', ' ');
      std::replace(name.begin(), name.end(), '-', ' ');
      const auto found = ids.find(name);
      return found == ids.end() ? Boundary::free : found->second;
    }
  } // namespace



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
            refuse("the face " + at_place(face.centre) +
                   " is one of three hexahedra: expected two at most");
        }
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
      refuse("a face named '" + name + "', " + at_place(centre) +
             ", is no face of a hexahedron");
    else if (found->second.n_cells > 1)
      refuse("a face named '" + name + "', " + at_place(centre) +
             ", is between two hexahedra: expected one of the boundary");
    else if (found->second.id != Boundary::free && found->second.id != id)
      refuse("the face " + at_place(centre) + " is doubly named, '" + name +
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
               "slides y, slides z, axial if needed; there is " +
               (names.empty() ? "none" : names));
  }



  void
  MeshBuilder::check_pieces()
  {
    Pieces pieces(cells.size());
    for (unsigned int cell = 0; cell < cells.size(); ++cell)
      for (unsigned int p = 20; p < 26; ++p)
        pieces.union_set(cell, faces.at(vertices(cell, p)).cell);
    const unsigned int n = number_of(pieces, cells.size());
    if (n > 1)
      refuse("its hexahedra are in " + std::to_string(n) +
             " pieces that have no face in common: expected one body");
  }



  void
  MeshBuilder::check_contact_face() const
  {
    std::map<unsigned int, unsigned int> n_faces_at_edge;
    for (const auto &[cell, number] :
         cells_at_contact_face(mesh->triangulation))
      for (const unsigned int l : cell->face(number)->line_indices())
        if (const auto line = cell->face(number)->line(l);
            ++n_faces_at_edge[line->index()] > 2)
          refuse("more than two faces named contact meet at the edge " +
                 at_place(line->center()) + ": expected a surface");
  }
} // namespace Debond
