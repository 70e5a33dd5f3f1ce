// Meshes of hexahedra from files: numbers, areas, volumes and nodes against
// closed forms, whatever the format and the order of nodes; and what is wrong
// with a file.

#include <debond/shapes/boundary.h>
#include <debond/shapes/mesh_builder.h>
#include <debond/shapes/mesh_formats.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <sstream>

#include "checks.h"

namespace
{
  using Debond::BodyMesh;
  using Point = dealii::Point<3>;



  /** A mesh as it is written. Hexahedra have their nodes in the order of
   * Abaqus, and, if they are 27, the middles of faces and of the cell as Gmsh
   * has them. Numbers of nodes begin with 1. */
  struct Written
  {
    std::vector<Point>            nodes;
    std::vector<std::vector<int>> hexahedra;
    struct Face
    {
      int              group; ///< 1 contact, 2 held, 3 slides x, 4 slides y
      int              hexahedron, side; ///< S1 to S6 of Abaqus
      std::vector<int> corners;
    };
    std::vector<Face> faces;
  };

  /** Corners of the sides S1 to S6. */
  const int sides[6][4] = {{0, 1, 2, 3},
                           {4, 7, 6, 5},
                           {0, 4, 5, 1},
                           {1, 5, 6, 2},
                           {2, 6, 7, 3},
                           {3, 7, 4, 0}};

  /** Where the nodes are in [0,2]^3: corners, edges of Abaqus, faces and middle
   * of Gmsh. */
  const int places[27][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0},
                             {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2},
                             {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0},
                             {1, 0, 2}, {2, 1, 2}, {1, 2, 2}, {0, 1, 2},
                             {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1},
                             {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {2, 1, 1},
                             {1, 2, 1}, {1, 1, 2}, {1, 1, 1}};

  /** Where Gmsh has its nodes among these. */
  const int of_gmsh[27] = {0,  1,  2,  3,  4,  5,  6,  7,  8,
                           11, 16, 9,  17, 10, 18, 19, 12, 15,
                           13, 14, 20, 21, 22, 23, 24, 25, 26};



  /** A block of n^3 hexahedra with so many nodes, the unit cube moved by @p
   *  position: contact at z = 0, held at z = 1, slides x and y at x = 0, y = 0.
   */
  Written
  block(const int                                  n,
        const unsigned int                         n_nodes,
        const std::function<Point(const Point &)> &position)
  {
    Written    mesh;
    const int  m    = 2 * n + 1;
    const auto node = [m](const int i, const int j, const int k) {
      return 1 + i + m * (j + m * k);
    };
    for (int k = 0; k < m; ++k)
      for (int j = 0; j < m; ++j)
        for (int i = 0; i < m; ++i)
          mesh.nodes.push_back(
            position(Point(i / (m - 1.), j / (m - 1.), k / (m - 1.))));
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          {
            mesh.hexahedra.emplace_back();
            auto &nodes = mesh.hexahedra.back();
            for (unsigned int a = 0; a < n_nodes; ++a)
              nodes.push_back(node(2 * i + places[a][0],
                                   2 * j + places[a][1],
                                   2 * k + places[a][2]));
            const auto add = [&](const int group, const int side) {
              mesh.faces.push_back(
                {group, int(mesh.hexahedra.size()), side + 1, {}});
              for (const int c : sides[side])
                mesh.faces.back().corners.push_back(nodes[c]);
            };
            if (k == 0)
              add(1, 0);
            if (k == n - 1)
              add(2, 1);
            if (i == 0)
              add(3, 5);
            if (j == 0)
              add(4, 2);
          }
    return mesh;
  }



  Point
  as_it_is(const Point &x)
  {
    return x;
  }

  /** A quarter of a ring, radii 1 and 2, height 1. */
  Point
  ring(const Point &x)
  {
    const double r = 1. + x[0], angle = M_PI / 2. * x[1];
    return {r * std::cos(angle), r * std::sin(angle), x[2]};
  }



  const std::vector<std::string> names{"",
                                       "Contact",
                                       "HELD",
                                       "slides_x",
                                       "slides-y"};

  /** @p version: 2.2 or 4.1. */
  std::string
  gmsh_text(const Written &mesh, const bool is_version_4)
  {
    Debond::Classic<std::ostringstream> text;
    text.precision(17);
    const int type = mesh.hexahedra[0].size() == 8  ? 5 :
                     mesh.hexahedra[0].size() == 20 ? 17 :
                                                      12;
    text << "$MeshFormat\n"
         << (is_version_4 ? "4.1" : "2.2") << " 0 8\n$EndMeshFormat\n"
         << "$PhysicalNames\n5\n";
    for (int g = 1; g <= 4; ++g)
      text << "2 " << g << " \"" << names[g] << "\"\n";
    text << "3 5 \"bone\"\n$EndPhysicalNames\n";
    const std::size_t n_elements = mesh.hexahedra.size() + mesh.faces.size();
    if (is_version_4)
      {
        text << "$Entities\n0 0 4 1\n";
        for (int g = 1; g <= 4; ++g)
          text << g << " 0 0 0 1 1 1 1 " << g << " 0\n";
        text << "1 0 0 0 1 1 1 1 5 0\n$EndEntities\n$Nodes\n1 "
             << mesh.nodes.size() << " 1 " << mesh.nodes.size() << "\n3 1 0 "
             << mesh.nodes.size() << "\n";
        for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
          text << i + 1 << "\n";
        for (const Point &x : mesh.nodes)
          text << x << "\n";
        text << "$EndNodes\n$Elements\n5 " << n_elements << " 1 " << n_elements
             << "\n";
      }
    else
      {
        text << "$Nodes\n" << mesh.nodes.size() << "\n";
        for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
          text << i + 1 << " " << mesh.nodes[i] << "\n";
        text << "$EndNodes\n$Elements\n" << n_elements << "\n";
      }
    int element = 0;
    for (int g = 1; g <= 4; ++g)
      {
        if (is_version_4)
          text << "2 " << g << " 3 "
               << std::count_if(mesh.faces.begin(),
                                mesh.faces.end(),
                                [g](const Written::Face &face) {
                                  return face.group == g;
                                })
               << "\n";
        for (const auto &face : mesh.faces)
          if (face.group == g)
            {
              text << ++element;
              if (!is_version_4)
                text << " 3 2 " << g << " " << g;
              for (const int c : face.corners)
                text << " " << c;
              text << "\n";
            }
      }
    if (is_version_4)
      text << "3 1 " << type << " " << mesh.hexahedra.size() << "\n";
    for (const auto &nodes : mesh.hexahedra)
      {
        text << ++element;
        if (!is_version_4)
          text << " " << type << " 2 5 1";
        for (unsigned int a = 0; a < nodes.size(); ++a)
          text << " " << nodes[of_gmsh[a]];
        text << "\n";
      }
    text << "$EndElements\n";
    return text.str();
  }



  std::string
  abaqus_text(const Written &mesh)
  {
    Debond::Classic<std::ostringstream> text;
    text.precision(17);
    text << "*Heading\n a bone\n** of a test\n*Node\n";
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
      text << "  " << i + 1 << ", " << mesh.nodes[i][0] << ", "
           << mesh.nodes[i][1] << ", " << mesh.nodes[i][2] << "\n";
    text << "*Element, type="
         << (mesh.hexahedra[0].size() == 8 ? "C3D8R" : "C3D20")
         << ", elset=all\n";
    for (std::size_t e = 0; e < mesh.hexahedra.size(); ++e)
      {
        text << e + 1;
        for (std::size_t a = 0; a < mesh.hexahedra[e].size(); ++a)
          text << (a == 12 ? ",\n " : ", ") << mesh.hexahedra[e][a];
        text << "\n";
      }
    for (int g = 1; g <= 4; ++g)
      {
        std::ostringstream sides_of_surface;
        for (int side = 1; side <= 6; ++side)
          {
            std::string elements;
            for (const auto &face : mesh.faces)
              if (face.group == g && face.side == side)
                elements += (elements.empty() ? "" : ", ") +
                            std::to_string(face.hexahedron);
            if (elements.empty())
              continue;
            text << "*Elset, elset=_" << g << "_S" << side << ", internal\n"
                 << elements << "\n";
            sides_of_surface << "_" << g << "_S" << side << ", S" << side
                             << "\n";
          }
        text << "*Surface, type=ELEMENT, name=\"" << names[g] << "\"\n"
             << sides_of_surface.str();
      }
    text << "*Step\n*Static\n1., 1.\n*End Step\n";
    return text.str();
  }



  std::shared_ptr<const BodyMesh>
  read(const std::string &text, const std::string &ending)
  {
    const std::string name = "results/mesh" + ending;
    std::ofstream(name, std::ios::binary) << text;
    return Debond::read_mesh_file(name, "Bone / Mesh file");
  }



  /** Volume, area of each name, and the largest distance of a point from its
   *  place, all of the map through the points of second order. */
  struct Measures
  {
    double volume = 0., area[5] = {0., 0., 0., 0., 0.};
  };

  Measures
  measure(const BodyMesh &mesh)
  {
    Measures                result;
    const dealii::FE_Q<3>   element(2);
    const dealii::QGauss<3> in_cell(4);
    const dealii::QGauss<2> on_face(4);
    const auto derivative = [&](const std::vector<Point> &x, const Point &at) {
      dealii::Tensor<2, 3> F;
      for (unsigned int a = 0; a < 27; ++a)
        F += outer_product(x[a], element.shape_grad(a, at));
      return F;
    };
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      {
        const auto x = mesh.points_of_second_order(cell);
        for (unsigned int q = 0; q < in_cell.size(); ++q)
          result.volume +=
            determinant(derivative(x, in_cell.point(q))) * in_cell.weight(q);
        for (unsigned int f = 0; f < 6; ++f)
          if (cell->face(f)->at_boundary())
            for (unsigned int q = 0; q < on_face.size(); ++q)
              {
                Point              at;
                const unsigned int normal = f / 2;
                at[normal]                = f % 2;
                at[(normal + 1) % 3]      = on_face.point(q)[0];
                at[(normal + 2) % 3]      = on_face.point(q)[1];
                const auto           F    = derivative(x, at);
                dealii::Tensor<1, 3> a, b;
                for (unsigned int d = 0; d < 3; ++d)
                  {
                    a[d] = F[d][(normal + 1) % 3];
                    b[d] = F[d][(normal + 2) % 3];
                  }
                result.area[cell->face(f)->boundary_id()] +=
                  cross_product_3d(a, b).norm() * on_face.weight(q);
              }
      }
    return result;
  }



  /** The block is exact in all formats. */
  void
  check_block(const std::string &what, const BodyMesh &mesh)
  {
    const Measures measures = measure(mesh);
    double         error    = std::abs(measures.volume - 1.);
    for (unsigned int g = 1; g <= 4; ++g)
      grow(error, std::abs(measures.area[g] - 1.));
    grow(error, std::abs(measures.area[0] - 2.));
    double off = 0.;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      {
        const auto x = mesh.points_of_second_order(cell);
        for (unsigned int p = 0; p < 27; ++p)
          {
            Point of_corners;
            for (unsigned int c = 0; c < 8; ++c)
              of_corners += dealii::GeometryInfo<3>::d_linear_shape_function(
                              Debond::places_in_hexahedron()[p], c) *
                            cell->vertex(c);
            grow(off, x[p].distance(of_corners));
          }
      }
    std::cout << what << ": order " << mesh.order << ", "
              << mesh.triangulation.n_active_cells() << " cells, "
              << mesh.triangulation.n_vertices() << " vertices" << std::endl;
    report("  error of volume and areas", error, 1e-12);
    report("  points off the trilinear ones", off, 1e-12);
  }



  /** Curved: volume and areas of the ring, to the order of its boundary, and
   *  nodes that are exactly on its circles. */
  void
  check_ring(const std::string &what,
             const BodyMesh    &mesh,
             const bool         has_middles_of_faces)
  {
    const Measures measures = measure(mesh);
    const double   area     = 3. * M_PI / 4.; // of (4 - 1) pi / 4
    double         error    = std::abs(measures.volume / area - 1.);
    grow(error, std::abs(measures.area[1] / area - 1.));
    grow(error, std::abs(measures.area[2] / area - 1.));
    grow(error, std::abs(measures.area[3] / (M_PI / 2.) - 1.));
    grow(error, std::abs(measures.area[4] - 1.));
    grow(error,
         std::abs(measures.area[0] / (M_PI + 1.) - 1.)); // outside, and x = 0
    std::cout << what << ": order " << mesh.order << ", "
              << mesh.triangulation.n_active_cells() << " cells" << std::endl;
    report("  relative error of volume and areas", error, 2e-4);
    double off = 0.;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      {
        const auto x = mesh.points_of_second_order(cell);
        for (unsigned int p = 8; p < (has_middles_of_faces ? 27 : 20); ++p)
          {
            // radii are multiples of 1/8, angles of 90 degrees / 8
            const double r = std::hypot(x[p][0], x[p][1]),
                         t = std::atan2(x[p][1], x[p][0]) / (M_PI / 2.);
            grow(off, std::abs(8. * r - std::round(8. * r)));
            grow(off, std::abs(8. * t - std::round(8. * t)));
          }
      }
    report("  middles off the circles", off, 1e-12);
  }



  /** The same hexahedra with other corners first. */
  Written
  turned(Written mesh)
  {
    for (std::size_t e = 0; e < mesh.hexahedra.size(); ++e)
      {
        // turned about the diagonal by 120 degrees, about z, or mirrored
        const auto before = mesh.hexahedra[e];
        for (std::size_t a = 0; a < before.size(); ++a)
          {
            const int *x     = places[a];
            const int  to[3] = {e % 3 == 0 ? x[1] : 2 - x[1],
                               e % 3 == 0 ? x[2] : x[0],
                               e % 3 == 0 ? x[0] : x[2]};
            const int  mirrored[3] = {x[0], x[1], 2 - x[2]};
            const int *place       = e % 3 == 2 ? mirrored : to;
            for (std::size_t b = 0; b < before.size(); ++b)
              if (std::equal(place, place + 3, places[b]))
                mesh.hexahedra[e][a] = before[b];
          }
      }
    return mesh;
  }



  void
  refused(const std::string &what,
          const std::string &text,
          const std::string &ending = ".msh")
  {
    std::cout << what << ":\n  ";
    try
      {
        read(text, ending);
        std::cout << "READ" << std::endl;
      }
    catch (const Debond::EntryError &error)
      {
        // what Gmsh itself says is that of its version
        const std::string message = error.what(), end = "is damaged: ";
        const auto        found = message.find(end);
        std::cout << (found == std::string::npos ?
                        message :
                        message.substr(0, found + end.size()))
                  << std::endl;
      }
  }

  void
  refused(const std::string &what, const Written &mesh)
  {
    refused(what, gmsh_text(mesh, false));
  }
} // namespace



int
main()
{
  std::filesystem::create_directories("results");
  const Written first_order = block(2, 8, as_it_is);
  check_block(".msh 2.2", *read(gmsh_text(first_order, false), ".msh"));
  check_block(".msh 4.1", *read(gmsh_text(first_order, true), ".MSH"));
  check_block(".inp", *read(abaqus_text(first_order), ".inp"));
  std::string written = abaqus_text(first_order);
  const auto  in_abaqus =
    [](std::string text, const std::string &from, const std::string &to) {
      const std::size_t at = text.find(from);
      AssertThrow(at != std::string::npos, dealii::ExcInternalError());
      return text.replace(at, from.size(), to);
    };
  // a keyword over two lines, numbers of Fortran, what is known to be harmless
  written =
    in_abaqus(written, "*Node\n", "*Node,\n** all\n nset=all, system=r\n");
  written = in_abaqus(written, "125, 1, 1, 1\n", "125, 1D0, 1.d+00, 0.1D1\n");
  written = in_abaqus(written,
                      "*Step",
                      "*Solid section, elset=all,\nmaterial=bone\n1.,\n*Step");
  written = in_abaqus(written, "*Static", "*Static\n*Cload\n1, 1, 1.");
  for (const std::string type : {"T3D2", "CPS4", "SFM3D4R"}) // of named faces
    written = in_abaqus(written,
                        "*Element, type=C3D8",
                        "*Element, type=" + type +
                          "\n1, 1, 2, 3, 4\n*Element, type=C3D8");
  check_block(".inp of another hand", *read(written, ".inp"));
  check_block("turned", *read(gmsh_text(turned(first_order), true), ".msh"));
  check_block("20 nodes",
              *read(gmsh_text(block(2, 20, as_it_is), false), ".msh"));

  const Written of_20 = block(4, 20, ring), of_27 = block(4, 27, ring);
  check_ring(".msh, 27 nodes", *read(gmsh_text(of_27, true), ".msh"), true);
  check_ring("turned", *read(gmsh_text(turned(of_27), false), ".msh"), true);
  check_ring(".msh, 20 nodes", *read(gmsh_text(of_20, false), ".msh"), false);
  check_ring("turned", *read(gmsh_text(turned(of_20), true), ".msh"), false);
  check_ring(".inp, 20 nodes", *read(abaqus_text(of_20), ".inp"), false);

  // a program that uses Gmsh keeps what it has
  gmsh::initialize();
  gmsh::option::setNumber("General.Terminal", 1.);
  gmsh::model::add("mine");
  read(gmsh_text(first_order, true), ".msh");
  std::string model;
  double      terminal;
  gmsh::model::getCurrent(model);
  gmsh::option::getNumber("General.Terminal", terminal);
  gmsh::option::setNumber("General.Terminal", 0.);
  gmsh::finalize();
  report("the model of the program is there", model == "mine");
  report("so are its options", terminal == 1.);

  const std::string version_2 = gmsh_text(first_order, false),
                    version_4 = gmsh_text(first_order, true);
  unsigned int n_read         = 0;
  std::cout << "Files that are cut off and read: ";
  for (const auto &[text, ending] :
       std::vector<std::pair<std::string, std::string>>{{version_2, ".msh"},
                                                        {version_4, ".msh"}})
    for (unsigned int i = 0; i < 20; ++i)
      try
        {
          read(text.substr(0, text.size() * i / 20), ending);
          ++n_read;
        }
      catch (const Debond::EntryError &)
        {}
  std::cout << n_read << std::endl;

  std::filesystem::remove("results/mesh.none");
  for (const std::string name : {"nowhere/mesh.msh", "results", "results/mesh"})
    try
      {
        Debond::read_mesh_file(name, "Bone / Mesh file");
      }
    catch (const Debond::EntryError &error)
      {
        std::cout << error.what() << std::endl;
      }
  refused("empty", "");
  refused("another program", "Point(1) = {0, 0, 0};\n");
  refused("cut off", version_2.substr(0, version_2.size() / 2));
  std::string text = version_2;
  text.replace(text.find(" 5 2 5 1 ") + 9, 1, "888");
  refused("a node that is not there", text);
  text = version_2;
  text.replace(text.find("\n1 0 0 0\n"), 9, "\n1 nan 0 0\n");
  refused("no number", text);

  // one hexahedron more that is a tetrahedron
  text = version_2;
  text.replace(text.find("$Elements\n") + 10, 2, "25");
  text.insert(text.find("$EndElements"), "25 4 2 5 1 1 2 6 30\n");
  refused("tetrahedra", text);
  text = version_2;
  text.replace(text.find("$Elements\n") + 10, 2, "25");
  text.insert(text.find("$EndElements"),
              "25 12 2 5 2"
              " 1 3 13 11 51 53 63 61 2 6 26 8 28 12 38 36 52 56 58 62 7 27 "
              "31 33 37 57 32\n");
  refused("two orders", text);
  Written mesh = first_order;
  mesh.hexahedra.clear();
  mesh.hexahedra.resize(1, std::vector<int>{1, 3, 13, 11, 51, 53, 63, 63});
  refused("a corner twice", mesh);

  const auto renamed = [&](const std::string &from, const std::string &to) {
    std::string result = version_2;
    result.replace(result.find(from), from.size(), to);
    return result;
  };
  refused("no contact", renamed("Contact", "kontakt"));
  refused("no held", renamed("HELD", "holt"));
  mesh = first_order;
  for (auto &face : mesh.faces)
    if (face.group == 1)
      {
        mesh.faces.push_back(face);
        mesh.faces.back().group = 2;
        break;
      }
  refused("doubly named", mesh);
  mesh                      = first_order;
  mesh.faces.back().corners = {3, 13, 63, 53};
  refused("between two hexahedra", mesh);
  mesh.faces.back().corners = {1, 3, 13, 63};
  refused("no face", mesh);

  mesh           = first_order;
  mesh.nodes[62] = Point(-0.5, -0.5, -0.5); // the one in the middle
  refused("tangled", mesh);
  mesh           = block(2, 27, as_it_is);
  mesh.nodes[31] = Point(0.25, 0.25, -0.9); // the middle of the first one
  refused("tangled by a middle", mesh);
  mesh = block(2, 27, as_it_is);
  mesh.nodes.push_back(mesh.nodes[2 + 5] + Point(0.1, 0., 0.));
  std::replace(mesh.hexahedra[0].begin(),
               mesh.hexahedra[0].end(),
               8,
               int(mesh.nodes.size()));
  refused("two middles", mesh);

  mesh = first_order;
  mesh.nodes.push_back(mesh.nodes[2]);
  for (const unsigned int e : {1, 3, 5, 7})
    std::replace(mesh.hexahedra[e].begin(),
                 mesh.hexahedra[e].end(),
                 3,
                 int(mesh.nodes.size()));
  refused("duplicate nodes", mesh);
  mesh                     = first_order;
  const std::size_t before = mesh.nodes.size();
  for (std::size_t i = 0; i < before; ++i)
    mesh.nodes.push_back(mesh.nodes[i] + Point(3., 0., 0.));
  mesh.hexahedra.push_back(mesh.hexahedra[0]);
  for (int &node : mesh.hexahedra.back())
    node += before;
  refused("two pieces", mesh);


  std::string abaqus = abaqus_text(first_order);
  for (const std::string keyword : {"*System\n1, 0, 0\n",
                                    "*Elgen\n1, 2, 1, 1\n",
                                    "*Ngen\n1, 5, 1\n",
                                    "*Include, input=a.inp\n",
                                    "*Tie, name=a\nb, c\n",
                                    "*Node,\nsystem=C\n",
                                    "*Node, input=a.inp\n",
                                    "*Element, type=C3D8, offset=2\n"})
    refused(keyword.substr(0, keyword.find('\n')),
            in_abaqus(abaqus, "*Node\n", keyword + "*Node\n"),
            ".inp");
  refused("node twice", "*Node\n1, 0, 0, 0\n1, 0, 0, 1\n", ".inp");
  refused("no coordinates", "*Node\n1, 0, 0\n", ".inp");
  // also where faces of them are named, before or after
  for (const std::string type : {"C3D6", "S4R"})
    refused("faces of " + type,
            "*Surface, name=contact, type=element\n1, S1\n*Element, type=" +
              type + "\n1, 1, 2, 3, 4\n",
            ".inp");
  // whatever else resists is as little left out; what only names faces is
  for (const std::string type :
       {"SC8R", "COH3D8", "S4R", "M3D4", "R3D4", "B31", "SPRINGA", "U1"})
    refused(type,
            in_abaqus(abaqus,
                      "*Element, type=C3D8R",
                      "*Element, type=" + type +
                        "\n1000, 1, 2, 3, 4, 5, 6, 7, 8\n*Element, type=C3D8R"),
            ".inp");
  refused("no such node",
          "*Node\n1, 0, 0, 0\n*Element, type=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n",
          ".inp");
  refused("cut off", "*Element, type=C3D8\n1, 1, 2, 3\n", ".inp");
  abaqus.replace(abaqus.find(", S1"), 4, ", S7");
  refused("no such side", abaqus, ".inp");
  refused("of VTK", "# vtk DataFile Version 3.0\n", ".vtk");
}
