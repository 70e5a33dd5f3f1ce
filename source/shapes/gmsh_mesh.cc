#include <debond/shapes/mesh_formats.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <gmsh.h>
#include <sys/resource.h>

#include <algorithm>
#include <exception>
#include <locale>
#include <mutex>
#include <unordered_map>

namespace Debond
{
  namespace
  {
    /** Numbers of C in this thread: Gmsh reads with those of the locale. */
    class LocaleOfC
    {
    public:
      LocaleOfC()
        : c(newlocale(LC_ALL_MASK, "C", nullptr))
        , before(uselocale(c))
      {}
      LocaleOfC(const LocaleOfC &) = delete;
      ~LocaleOfC()
      {
        uselocale(before);
        freelocale(c);
      }

    private:
      const locale_t c, before;
    };



    bool
    gmsh_is_in_use()
    {
#if GMSH_API_VERSION_MAJOR > 4 || GMSH_API_VERSION_MINOR >= 10
      return gmsh::isInitialized();
#else
      double untouched = -1.;
      try
        {
          gmsh::option::getNumber("General.Terminal", untouched);
        }
      catch (const std::string &) // if it has been before
        {}
      return untouched >= 0.;
#endif
    }



    /** A model of Gmsh that is nobody else's. The program that uses this
     *  library, in Python for one, may have its own; what it has set stays as
     *  it is, and so does the environment. */
    class GmshModel
    {
    public:
      GmshModel()
        : is_guest(gmsh_is_in_use())
      {
        if (is_guest)
          gmsh::model::getCurrent(model_of_host);
        else
          {
            // It looks for the two options that keep its hands off PATH and
            // the locale wherever they stand, but ends the program at them
            // unless they are a string and its value.
            static char program[] = "debond", set[] = "-setstring",
                        environment[] = "-noenv", locale[] = "-nolocale";
            char  *arguments[] = {program, set, environment, locale, nullptr};
            rlimit stack; // it would enlarge it
            getrlimit(RLIMIT_STACK, &stack);
            gmsh::initialize(4, arguments, false);
            setrlimit(RLIMIT_STACK, &stack);
          }
        for (unsigned int i = 0; i < 2; ++i)
          {
            gmsh::option::getNumber(options[i], options_of_host[i]);
            gmsh::option::setNumber(options[i], i == 0 ? 0. : 2.);
          }
        gmsh::model::add("debond");
      }
      GmshModel(const GmshModel &) = delete;
      ~GmshModel()
      {
        gmsh::model::remove();
        if (is_guest)
          {
            gmsh::model::setCurrent(model_of_host);
            for (unsigned int i = 0; i < 2; ++i)
              gmsh::option::setNumber(options[i], options_of_host[i]);
          }
        else
          gmsh::finalize();
      }

    private:
      const bool        is_guest;
      std::string       model_of_host;
      double            options_of_host[2];
      const char *const options[2] = {"General.Terminal",
                                      "General.AbortOnError"};
    };



    using NodeNumbers = std::unordered_map<std::size_t, unsigned int>;

    NodeNumbers
    read_nodes(StoredMesh &mesh)
    {
      std::vector<std::size_t> tags;
      std::vector<double>      x, ignored;
      gmsh::model::mesh::getNodes(tags, x, ignored, -1, -1, false, false);
      NodeNumbers number;
      for (std::size_t i = 0; i < tags.size(); ++i)
        if (number.emplace(tags[i], mesh.nodes.size()).second)
          mesh.nodes.emplace_back(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
      return number;
    }



    /** What Gmsh knows of a type of elements. */
    struct ElementType
    {
      explicit ElementType(const int type)
      {
        int dimension, order;
        gmsh::model::mesh::getElementProperties(
          type, name, dimension, order, n_nodes, coordinates, n_corners);
      }
      std::string         name; ///< Hexahedron 8
      int                 n_nodes, n_corners;
      std::vector<double> coordinates; ///< from -1 to 1
    };



    /** Vertices come first; a node in the middle of an edge is known by its
     *  coordinates. */
    void
    read_tetrahedra(const ElementType              &type,
                    const std::size_t               n_elements,
                    const std::vector<std::size_t> &nodes,
                    const NodeNumbers              &number,
                    StoredMesh                     &mesh)
    {
      const auto point = [&](const int n) {
        const double *const x = &type.coordinates[3 * n];
        return dealii::Point<3>(x[0], x[1], x[2]);
      };
      std::vector<unsigned int> place(type.n_nodes);
      for (int n = 0; n < type.n_nodes; ++n)
        {
          place[n] = n;
          for (unsigned int e = 0; n >= 4 && e < 6; ++e)
            if (const auto &[i, j] = StoredMesh::edges[e];
                (point(i) + (point(j) - point(i)) / 2.).distance(point(n)) <
                0.1)
              place[n] = 4 + e;
        }
      for (std::size_t e = 0; e < n_elements; ++e)
        {
          auto &tetrahedron = mesh.tetrahedra.emplace_back();
          tetrahedron.fill(StoredMesh::none);
          for (int n = 0; n < type.n_nodes; ++n)
            tetrahedron[place[n]] = number.at(nodes[e * type.n_nodes + n]);
        }
    }



    void
    read_solids(const NodeNumbers &number, StoredMesh &mesh)
    {
      std::vector<int>                      types;
      std::vector<std::vector<std::size_t>> elements, nodes;
      gmsh::model::mesh::getElements(types, elements, nodes, 3);
      for (unsigned int t = 0; t < types.size(); ++t)
        {
          const ElementType type(types[t]);
          if (type.n_corners == 4 && (type.n_nodes == 4 || type.n_nodes == 10))
            {
              read_tetrahedra(type, elements[t].size(), nodes[t], number, mesh);
              continue;
            }
          if (type.n_corners != 8 ||
              (type.n_nodes != 8 && type.n_nodes != 20 && type.n_nodes != 27))
            {
              mesh.other_solids[type.name + " nodes"] += elements[t].size();
              continue;
            }
          std::vector<unsigned int> place;
          for (int n = 0; n < type.n_nodes; ++n)
            for (unsigned int p = 0; p < 27; ++p)
              {
                const double *const    x = &type.coordinates[3 * n];
                const dealii::Point<3> there(x[0] + 1., x[1] + 1., x[2] + 1.);
                if (there.distance(2. * places_in_hexahedron()[p]) < 0.1)
                  place.push_back(p);
              }
          std::vector<unsigned int> numbers(type.n_nodes);
          for (std::size_t e = 0; e < elements[t].size(); ++e)
            {
              for (int n = 0; n < type.n_nodes; ++n)
                numbers[n] = number.at(nodes[t][e * type.n_nodes + n]);
              mesh.add_hexahedron(numbers, place);
            }
        }
    }



    void
    read_group(const int tag, const NodeNumbers &number, StoredMesh &mesh)
    {
      std::string name;
      gmsh::model::getPhysicalName(2, tag, name);
      if (name.empty())
        name = std::to_string(tag);
      auto            &faces = mesh.groups[name];
      std::vector<int> surfaces;
      gmsh::model::getEntitiesForPhysicalGroup(2, tag, surfaces);
      for (const int surface : surfaces)
        {
          std::vector<int>                      types;
          std::vector<std::vector<std::size_t>> elements, nodes;
          gmsh::model::mesh::getElements(types, elements, nodes, 2, surface);
          for (unsigned int t = 0; t < types.size(); ++t)
            {
              const ElementType type(types[t]);
              for (std::size_t e = 0; e < elements[t].size(); ++e)
                {
                  auto &face = faces.emplace_back();
                  face.fill(StoredMesh::none);
                  for (int n = 0; n < std::min(type.n_corners, 4); ++n)
                    face[n] = number.at(nodes[t][e * type.n_nodes + n]);
                }
            }
        }
    }



    StoredMesh
    mesh_of_gmsh(const std::string &filename)
    {
      const LocaleOfC locale;
      const GmshModel model;
      gmsh::merge(filename);
      StoredMesh        mesh;
      const NodeNumbers number = read_nodes(mesh);
      read_solids(number, mesh);
      gmsh::vectorpair groups;
      gmsh::model::getPhysicalGroups(groups, 2);
      for (const auto &group : groups)
        read_group(group.second, number, mesh);
      return mesh;
    }
  } // namespace



  StoredMesh
  read_gmsh_mesh(const std::string &filename, const FileRefusal &refuse)
  {
    // Gmsh runs what is no mesh as a program of its own language, and takes
    // what is there of a file that is cut off.
    std::string bytes = read_input_bytes(filename, refuse, largest_mesh_MB);
    if (!boost::starts_with(bytes, "$MeshFormat") &&
        !boost::starts_with(bytes, "$Comments") &&
        !boost::starts_with(bytes, "$NOD"))
      refuse("this is no mesh of Gmsh: it does not begin with $MeshFormat");
    boost::trim_right(bytes, std::locale::classic());
    if (!boost::starts_with(bytes.substr(bytes.rfind('\n') + 1), "$End"))
      refuse("this file is cut off: its last line is not $End...");

    static std::mutex                 one_at_a_time; // Gmsh is of globals
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    std::string                       error;
    try
      {
        return mesh_of_gmsh(filename);
      }
    catch (const std::string &what) // of Gmsh
      {
        error = what;
      }
    catch (const std::exception &) // a node or memory that is not there
      {
        error = "its numbers do not fit together";
      }
    refuse("this file is damaged: " + error);
    return {};
  }
} // namespace Debond
