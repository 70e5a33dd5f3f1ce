#include <debond/input/allowed_values.h>
#include <debond/shapes/mesh_formats.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <algorithm>
#include <cmath>
#include <locale>
#include <optional>

namespace Debond
{
  namespace
  {
    /** What is read of a legacy file of VTK, word by word. */
    class VtkFile
    {
    public:
      VtkFile(const std::string &text, const FileRefusal &refuse)
        : refuse(refuse)
      {
        Classic<std::istringstream> stream(text);
        std::string                 version, title, kind;
        std::getline(stream, version);
        std::getline(stream, title);
        std::getline(stream, kind);
        if (!boost::starts_with(version, "# vtk DataFile Version ") ||
            boost::trim_copy(kind, std::locale::classic()) != "ASCII")
          refuse("its third line is '" + shortened(kind) +
                 "': expected a legacy file of VTK in ASCII");
        for (std::string word; stream >> word;)
          words.push_back(word);
        if (!find("UNSTRUCTURED_GRID"))
          refuse("it has no UNSTRUCTURED_GRID");
        read_nodes();
        read_cells();
        read_types();
        read_faces();
      }

      StoredMesh mesh;

    private:
      /** Goes on behind the next such word, if there is one. */
      bool
      find(const std::string &word)
      {
        const auto found = std::find(words.begin() + at, words.end(), word);
        if (found == words.end())
          return false;
        at      = found - words.begin() + 1;
        section = word;
        return true;
      }
      double
      number()
      {
        if (at == words.size())
          refuse("it is cut off in " + section);
        const auto result =
          at < words.size() ? read_number(words[at]) : std::nullopt;
        if (at < words.size() && !result)
          refuse("'" + shortened(words[at]) + "' in " + section +
                 ": expected a number");
        ++at;
        return result.value_or(0.);
      }
      unsigned int
      count(const double largest = 1e9)
      {
        const double n = number();
        if (!(n >= 0. && n <= largest && n == std::floor(n)))
          refuse(to_text(n) + " in " + section + ": expected from 0 to " +
                 to_text(largest));
        return n;
      }

      void
      read_nodes()
      {
        if (!find("POINTS"))
          refuse("it has no POINTS");
        const unsigned int n = count();
        ++at; // float
        for (unsigned int i = 0; i < n; ++i)
          {
            const double x = number(), y = number(), z = number();
            mesh.nodes.emplace_back(x, y, z);
          }
      }

      void
      read_cells()
      {
        if (!find("CELLS"))
          refuse("it has no CELLS");
        unsigned int n = count();
        number();
        if (at < words.size() && words[at] == "OFFSETS") // since version 5
          {
            at += 2;
            std::vector<unsigned int> ends;
            while (n-- > 0)
              ends.push_back(count());
            find("CONNECTIVITY");
            ++at;
            for (unsigned int c = 1; c < ends.size(); ++c)
              read_cell(double(ends[c]) - ends[c - 1]);
          }
        else
          while (n-- > 0)
            read_cell(count());
      }
      void
      read_cell(const double n)
      {
        cells.emplace_back();
        for (double i = 0.; i < n; ++i)
          cells.back().push_back(count(mesh.nodes.size() - 1.));
      }

      void
      read_types()
      {
        if (!find("CELL_TYPES"))
          refuse("it has no CELL_TYPES");
        if (count() != cells.size())
          refuse("it has not as many CELL_TYPES as CELLS");
        for (const auto &cell : cells)
          {
            const unsigned int type = count();
            types.push_back(type);
            if ((type == 12 && cell.size() == 8) ||
                (type == 25 && cell.size() == 20))
              mesh.add_hexahedron(cell, common_places());
            else if ((type >= 10 && type <= 14) ||
                     (type >= 24 && type != 28 && type != 30 && type <= 33))
              ++mesh
                  .other_solids["cells of VTK's type " + std::to_string(type)];
          }
      }

      /** As SCALARS with a LOOKUP_TABLE or in a FIELD. */
      void
      read_faces()
      {
        static const std::vector<std::string> names{
          "", "contact", "held", "slides x", "slides y", "slides z", "axial"};
        if (!find("CELL_DATA") || !find("MaterialID"))
          return;
        const bool is_field = at < words.size() && words[at] == "1";
        if (is_field)
          at += 3;
        else if (find("LOOKUP_TABLE"))
          ++at;
        section = "MaterialID";
        for (unsigned int c = 0; c < cells.size(); ++c)
          {
            const unsigned int id = count();
            if (types[c] != 9 && types[c] != 23 && types[c] != 28)
              continue;
            if (id > 0 && id < names.size() && cells[c].size() >= 4)
              mesh.groups[names[id]].push_back(
                {{cells[c][0], cells[c][1], cells[c][2], cells[c][3]}});
          }
      }

      const FileRefusal                     &refuse;
      std::vector<std::string>               words;
      std::size_t                            at = 0;
      std::string                            section; ///< for messages
      std::vector<std::vector<unsigned int>> cells;   ///< their nodes
      std::vector<unsigned int>              types;
    };
  } // namespace



  StoredMesh
  read_vtk_mesh(const std::string &filename, const FileRefusal &refuse)
  {
    VtkFile file(plain_text(read_input_bytes(filename, refuse, largest_mesh_MB),
                            refuse),
                 refuse);
    return std::move(file.mesh);
  }
} // namespace Debond
