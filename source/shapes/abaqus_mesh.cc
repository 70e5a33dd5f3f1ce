#include <debond/input/allowed_values.h>
#include <debond/shapes/mesh_formats.h>
#include <debond/support/number_text.h>

#include <deal.II/base/geometry_info.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <algorithm>
#include <cmath>
#include <locale>
#include <optional>
#include <unordered_map>

namespace Debond
{
  namespace
  {
    /** Places of the 8 or 20 nodes of a hexahedron, in the order of Abaqus:
     *  corners around the bottom and the top, then the middles of the edges
     *  around them and between them. */
    const std::vector<unsigned int> places_of_nodes{0,  1,  3,  2,  4,  5,  7,
                                                    6,  10, 9,  11, 8,  14, 13,
                                                    15, 12, 16, 17, 19, 18};



    std::string
    upper(const std::string &text)
    {
      return boost::to_upper_copy(text, std::locale::classic());
    }



    std::vector<std::string>
    items_of(const std::string &line)
    {
      std::vector<std::string> items = split(line, ",");
      if (items.size() > 1 && items.back().empty())
        items.pop_back(); // a comma at the end
      return items;
    }



    /** What is read of a file of Abaqus, line by line. */
    class AbaqusFile
    {
    public:
      AbaqusFile(const std::string &text, const FileRefusal &refuse)
        : refuse_file(refuse)
      {
        Classic<std::istringstream> lines(text);
        for (std::string line; std::getline(lines, line);)
          {
            ++line_number;
            boost::trim(line, std::locale::classic());
            if (line.empty() || boost::starts_with(line, "**"))
              continue;
            // a comma at the end of a keyword's line continues it in the next
            const bool goes_on = boost::ends_with(keyword, ",");
            if (line[0] != '*' && !goes_on)
              read_data(line);
            else if (keyword = line[0] == '*' ? line : keyword + line;
                     !boost::ends_with(keyword, ","))
              begin_section(keyword);
          }
        if (!unfinished.empty())
          refuse("it is cut off within an element");
        // surfaces may be those of solids that are refused later
        if (mesh.other_solids.empty() &&
            (mesh.hexahedra.empty() || mesh.tetrahedra.empty()))
          for (const auto &[name, sides] : surfaces)
            for (const auto &side : sides)
              add_faces(side, mesh.groups[name]);
      }

      StoredMesh mesh;

    private:
      /** Elements and their side of a surface. */
      struct Sides
      {
        std::string  elements; ///< a set, or one of them
        unsigned int number;   ///< S1: 1
        unsigned int face;     ///< of deal.II's, of a hexahedron
        unsigned int line;
      };

      void
      refuse(const std::string &why) const
      {
        refuse_file("line " + std::to_string(line_number) + ": " + why);
      }

      void
      begin_section(const std::string &line)
      {
        if (!unfinished.empty())
          refuse("the element before has too few nodes");
        parameters.clear();
        const auto        words  = items_of(line);
        const std::string before = section;
        section                  = upper(words[0]);
        for (auto word = words.begin() + 1; word != words.end(); ++word)
          {
            const auto  equals = std::min(word->find('='), word->size());
            std::string value =
              word->substr(std::min(equals + 1, word->size()));
            boost::trim_if(value, boost::is_any_of(" \t\""));
            parameters[upper(boost::trim_copy(word->substr(0, equals)))] =
              value;
          }
        // loads and output: nothing there makes nodes or elements
        if (before == "*STEP" && section != "*END STEP")
          {
            section = before;
            return;
          }
        check_keyword();
        if (section == "*ELEMENT")
          begin_elements();
        if (section == "*SURFACE")
          {
            const std::string type = parameter("TYPE");
            if (!type.empty() && type != "ELEMENT")
              section.clear();
            else
              surfaces[parameters["NAME"]];
          }
      }

      /** What would change nodes, elements or faces, or may do so, is not left
       *  out without a word. */
      void
      check_keyword()
      {
        static const std::vector<std::string> harmless = items_of(
          "*HEADING,*PREPRINT,*PART,*END PART,*ASSEMBLY,*END ASSEMBLY,"
          "*INSTANCE,*END INSTANCE,*NODE,*ELEMENT,*NSET,*ELSET,*SURFACE,"
          "*ORIENTATION,*SOLID SECTION,*SHELL SECTION,*MEMBRANE SECTION,"
          "*SURFACE SECTION,*BEAM SECTION,*SECTION CONTROLS,*DISTRIBUTION,"
          "*DISTRIBUTION TABLE,*MATERIAL,*ELASTIC,*DENSITY,*PLASTIC,"
          "*HYPERELASTIC,*VISCOELASTIC,*EXPANSION,*CONDUCTIVITY,"
          "*SPECIFIC HEAT,*DAMPING,*DEPVAR,*USER MATERIAL,*TRANSFORM,"
          "*AMPLITUDE,*TIME POINTS,*PHYSICAL CONSTANTS,*BOUNDARY,"
          "*INITIAL CONDITIONS,*FRICTION,*SURFACE INTERACTION,"
          "*SURFACE BEHAVIOR,*CONTACT PAIR,*STEP,*END STEP");
        if (!std::count(harmless.begin(), harmless.end(), section))
          refuse(section +
                 " may make, move or join nodes and elements, and is not "
                 "understood: expected all of them in *NODE and *ELEMENT; "
                 "remove it if it does none of this");
        for (const auto &[name, value] : parameters)
          if ((section == "*NODE" || section == "*ELEMENT") && name != "TYPE" &&
              name != "NSET" && name != "ELSET" &&
              !(name == "SYSTEM" && parameter(name) == "R"))
            refuse(section + ", " + name + "=" + value +
                   " is not understood: expected numbers and x, y, z of nodes, "
                   "and the nodes of elements, in this file");
      }

      void
      begin_elements()
      {
        const std::string type   = parameter("TYPE");
        const auto        begins = [&](const char *with) {
          return boost::starts_with(type, with);
        };
        // what Gmsh writes of named lines and faces, or has no stiffness
        resists = !begins("T3D") && !begins("CPS") && !begins("SFM3D");
        const auto end =
          std::min(type.find_first_not_of("0123456789", 3), type.size());
        const std::string n = begins("C3D") ? type.substr(3, end - 3) : "";
        nodes_of_element    = n == "8"  ? 8 :
                              n == "20" ? 20 :
                              n == "4"  ? 4 :
                              n == "10" ? 10 :
                                          0;
      }

      void
      read_data(const std::string &line)
      {
        const auto items = items_of(line);
        if (section == "*NODE")
          read_node(items);
        else if (section == "*ELEMENT" && resists)
          read_element(items);
        else if (section == "*ELSET")
          read_set(items);
        else if (section == "*SURFACE")
          read_surface(items);
        else if (section == "*INSTANCE")
          refuse("this instance is moved: expected a part that is in place");
      }

      void
      read_node(const std::vector<std::string> &items)
      {
        dealii::Point<3> x;
        for (unsigned int d = 0; d < 3; ++d)
          {
            // 1.5D0 is Fortran's
            const auto number =
              d + 1 < items.size() ?
                read_number(
                  boost::replace_all_copy(upper(items[d + 1]), "D", "E")) :
                std::nullopt;
            if (!number)
              refuse("expected a node, its number and x, y, z");
            x[d] = *number;
          }
        if (!node_number.emplace(integer(items[0]), mesh.nodes.size()).second)
          refuse("the second node " + items[0] +
                 ": expected one part only, each number once");
        mesh.nodes.push_back(x);
      }

      void
      read_element(const std::vector<std::string> &items)
      {
        if (nodes_of_element == 0)
          {
            ++mesh.other_solids["elements " + parameter("TYPE")];
            return;
          }
        for (const auto &item : items)
          unfinished.push_back(integer(item));
        if (unfinished.size() < nodes_of_element + 1)
          return; // it goes on in the next line
        std::vector<unsigned int> nodes;
        for (unsigned int n = 1; n < unfinished.size(); ++n)
          {
            const auto found = node_number.find(unfinished[n]);
            if (found == node_number.end())
              refuse("there is no node " + std::to_string(unfinished[n]));
            nodes.push_back(found->second);
          }
        if (nodes.size() > nodes_of_element)
          refuse("expected " + std::to_string(nodes_of_element) +
                 " nodes of an element, not " + std::to_string(nodes.size()));
        const bool is_tetrahedron = nodes.size() == 4 || nodes.size() == 10;
        if (!element_number
               .emplace(unfinished[0],
                        is_tetrahedron ? mesh.tetrahedra.size() :
                                         mesh.hexahedra.size())
               .second)
          refuse("the second element " + std::to_string(unfinished[0]) +
                 ": expected one part only, each number once");
        if (parameters.count("ELSET"))
          sets[parameter("ELSET")].push_back(unfinished[0]);
        unfinished.clear();
        if (is_tetrahedron)
          {
            auto &tetrahedron = mesh.tetrahedra.emplace_back();
            tetrahedron.fill(StoredMesh::none);
            std::copy(nodes.begin(), nodes.end(), tetrahedron.begin());
          }
        else
          mesh.add_hexahedron(nodes, places_of_nodes);
      }

      void
      read_set(const std::vector<std::string> &items)
      {
        auto &set = sets[parameter("ELSET")];
        if (parameters.count("GENERATE"))
          {
            const long step = items.size() > 2 ? integer(items[2]) : 1;
            if (items.size() < 2 || step < 1)
              refuse("expected the first and the last element, and a step");
            for (long e = integer(items[0]); e <= integer(items[1]); e += step)
              set.push_back(e);
            return;
          }
        for (const auto &item : items)
          {
            const auto other = sets.find(upper(item));
            if (other == sets.end())
              set.push_back(integer(item));
            else
              {
                const std::vector<long> copy = other->second;
                set.insert(set.end(), copy.begin(), copy.end());
              }
          }
      }

      void
      read_surface(const std::vector<std::string> &items)
      {
        static const std::map<std::string, unsigned int> faces{
          {"S1", 4}, {"S2", 5}, {"S3", 2}, {"S4", 1}, {"S5", 3}, {"S6", 0}};
        const auto face = faces.find(items.size() < 2 ? "" : upper(items[1]));
        if (face == faces.end())
          refuse("expected an element or a set of them and a face, S1 to S6");
        surfaces[parameters["NAME"]].push_back(
          {upper(items[0]),
           static_cast<unsigned int>(face->first[1] - '0'),
           face->second,
           line_number});
      }

      void
      add_faces(const Sides                              &sides,
                std::vector<std::array<unsigned int, 4>> &faces)
      {
        line_number    = sides.line;
        const auto set = sets.find(sides.elements);
        for (const long element : set == sets.end() ?
                                    std::vector<long>{integer(sides.elements)} :
                                    set->second)
          {
            const auto found = element_number.find(element);
            if (found == element_number.end())
              refuse("there is no element " + std::to_string(element));
            auto &face = faces.emplace_back();
            if (!mesh.tetrahedra.empty())
              {
                face = triangle(found->second, sides.number);
                continue;
              }
            for (unsigned int v = 0; v < 4; ++v)
              face[v] = mesh.hexahedra[found->second][dealii::GeometryInfo<
                3>::face_to_cell_vertices(sides.face, v)];
          }
      }

      /** Face S1 to S4 of a tetrahedron, which numbers those without their
       *  vertex 3, 2, 0 and 1. */
      std::array<unsigned int, 4>
      triangle(const unsigned int tetrahedron, const unsigned int number) const
      {
        if (number > 4)
          refuse("a tetrahedron has no face S" + std::to_string(number));
        const auto                 &nodes = mesh.tetrahedra[tetrahedron];
        std::array<unsigned int, 4> result{
          {nodes[0], nodes[1], nodes[2], StoredMesh::none}};
        if (number > 1)
          result[number == 2 ? 2 : number == 3 ? 0 : 1] = nodes[3];
        return result;
      }

      std::string
      parameter(const std::string &name) const
      {
        const auto found = parameters.find(name);
        return found == parameters.end() ? "" : upper(found->second);
      }

      long
      integer(const std::string &item) const
      {
        const auto number = read_number(item);
        if (!number || *number != std::floor(*number) || *number < 0 ||
            *number > 1e12)
          refuse("'" + item + "' is no number of a node or an element");
        return static_cast<long>(*number);
      }

      const FileRefusal                        &refuse_file;
      unsigned int                              line_number = 0;
      std::string                               keyword; ///< its line
      std::string                               section;
      std::map<std::string, std::string>        parameters; ///< of it
      bool                                      resists          = false;
      unsigned int                              nodes_of_element = 0;
      std::vector<long>                         unfinished;
      std::unordered_map<long, unsigned int>    node_number, element_number;
      std::map<std::string, std::vector<long>>  sets;
      std::map<std::string, std::vector<Sides>> surfaces;
    };
  } // namespace



  StoredMesh
  read_abaqus_mesh(const std::string &filename, const FileRefusal &refuse)
  {
    AbaqusFile file(
      plain_text(read_input_bytes(filename, refuse, largest_mesh_MB), refuse),
      refuse);
    return std::move(file.mesh);
  }
} // namespace Debond
