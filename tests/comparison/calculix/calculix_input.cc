// Writes a scene as an input of CalculiX: the same cells, materials, boundary
// conditions and load steps, the interface as surface-to-surface penalty
// contact. See README.md here for what is the same and what is not.

#include <debond/bulk/bulk_space.h>
#include <debond/bulk/chuck.h>
#include <debond/scene/scene.h>
#include <debond/support/input_error.h>
#include <debond/support/runtime.h>
#include <debond/support/written_files.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace
{
  using namespace Debond;

  const char *const help_text =
    R"(usage: calculix_input [OPTIONS] SCENE.prm OUTPUT.inp

Writes a scene of debond as an input of CalculiX.

  --set ENTRY=VALUE   override an entry of the scene; may be repeated
  --element TYPE      element of CalculiX: C3D8 (default), C3D8I, C3D8R, or
                      with quadratic edges, C3D20 or C3D20R
  --help              print this text
)";



  /** Refuses what CalculiX has no counterpart for. */
  void
  check(const Scene &scene)
  {
    const std::string cannot = "calculix_input: cannot translate ";

    const FrictionLaw       &friction = *scene.interface.friction;
    const BondingParameters &bonding  = scene.interface.bonding;
    if (friction.depends_on_rate)
      throw InputError(cannot + "a friction law that depends on the rate");
    if (friction.has_bond() && bonding.initial_bonding != 0 &&
        bonding.bonded_fraction != 0)
      throw InputError(cannot +
                       "a friction coefficient that changes with sliding: "
                       "expected Interface / Friction law = coulomb or "
                       "frictionless, or equal coefficients");
    if (!friction.is_frictionless &&
        scene.interface.friction_starts_at > scene.load_steps.times.front())
      throw InputError(cannot +
                       "Interface / Friction starts at after the first time");

    const std::array<const BodyParameters *, 2> bodies{
      {&scene.bone, &scene.implant}};
    for (const BodyParameters *body : bodies)
      if (body->material == Material::rigid)
        throw InputError(cannot + "Material = rigid of the " +
                         (body == &scene.bone ? "bone" : "implant") +
                         ": expected linear or neo-hookean");
  }



  /** CalculiX reads at most 20 characters of a number. */
  std::string
  to_text(const double number)
  {
    char text[32];
    std::snprintf(text, sizeof(text), "%.12e", number);
    return text;
  }



  /**
   * The nodes of a body and its elements in CalculiX's order, both counted from
   * 0. Quadratic elements have a node on the middle of each edge, and that of
   * an edge along a coin's rim lies on the circle: then the disk is round.
   */
  class Nodes
  {
  public:
    std::vector<Eigen::Vector3d>           positions; // mm
    std::vector<std::vector<unsigned int>> elements;

    Nodes(const BulkSpace &body, const bool quadratic)
    {
      for (unsigned int vertex = 0; vertex < body.n_vertices(); ++vertex)
        positions.push_back(body.reference_position(vertex));

      // deal.II counts vertices lexicographically, CalculiX around the lower
      // and then around the upper face, which are its faces S1 and S2
      constexpr std::array<unsigned int, 8> order{{0, 1, 3, 2, 4, 5, 7, 6}};
      for (const auto &cell : body.cells())
        {
          elements.emplace_back();
          for (const unsigned int v : order)
            elements.back().push_back(cell.vertices[v]);
        }

      if (quadratic)
        for (std::vector<unsigned int> &element : elements)
          add_midpoints(element, body);
    }

  private:
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> midpoints;

    void
    add_midpoints(std::vector<unsigned int> &element, const BulkSpace &body)
    {
      constexpr std::array<std::array<unsigned int, 2>, 12> edges{{{{0, 1}},
                                                                   {{1, 2}},
                                                                   {{2, 3}},
                                                                   {{3, 0}},
                                                                   {{4, 5}},
                                                                   {{5, 6}},
                                                                   {{6, 7}},
                                                                   {{7, 4}},
                                                                   {{0, 4}},
                                                                   {{1, 5}},
                                                                   {{2, 6}},
                                                                   {{3, 7}}}};
      for (const auto &edge : edges)
        {
          const unsigned int a = element[edge[0]], b = element[edge[1]];
          const auto [known, is_new] =
            midpoints.emplace(std::minmax(a, b), positions.size());
          if (is_new)
            positions.push_back(midpoint(positions[a], positions[b], body));
          element.push_back(known->second);
        }
    }

    static Eigen::Vector3d
    midpoint(const Eigen::Vector3d &a,
             const Eigen::Vector3d &b,
             const BulkSpace       &body)
    {
      Eigen::Vector3d       middle    = (a + b) / 2;
      const BodyParameters &coin      = body.parameters();
      const auto            is_on_rim = [&coin](const Eigen::Vector3d &X) {
        return std::abs(X.head<2>().norm() - coin.radius) < 1e-9 * coin.radius;
      };
      if (body.side() == Side::implant && coin.shape == BodyShape::coin &&
          is_on_rim(a) && is_on_rim(b))
        middle.head<2>() *= coin.radius / middle.head<2>().norm();
      return middle;
    }
  };



  /** Both bodies in one numbering: CalculiX counts from 1, bone first. */
  class Input
  {
  public:
    Input(const Scene &scene, const std::string &element)
      : scene(scene)
      , element(element)
      , bone(scene.bone, Side::bone)
      , implant(scene.implant, Side::implant)
      , bone_nodes(bone, is_quadratic(element))
      , implant_nodes(implant, is_quadratic(element))
      , chuck(scene.chuck,
              {0, 0, scene.implant.thickness()},
              scene.implant.characteristic_radius())
      , times(scene.load_steps.planned_times())
    {
      if (!chuck.unknowns().empty())
        throw InputError(
          "calculix_input: cannot translate Chuck / " +
          std::string(ChuckParameters::names[chuck.unknowns().front()]) +
          " being loaded or compliant: expected a prescribed "
          "value");
      if (!chuck.values(times[0]).isZero())
        throw InputError("calculix_input: CalculiX starts from bodies at rest: "
                         "all components of Chuck must be 0 at the first time");
      for (unsigned int step = 1; step < times.size(); ++step)
        if (!chuck.values(times[step]).segment<2>(3).isZero())
          throw InputError("calculix_input: only rotations about z are "
                           "compared: expected Chuck / Rotation x and y = 0");
    }

    void
    write(std::ostream &out)
    {
      out << "** " << (scene.title.empty() ? "a scene of debond" : scene.title)
          << "\n** Written by calculix_input. Units: mm, N, MPa.\n";
      write_nodes(out);
      write_elements(out, bone, "BONE", 0);
      write_elements(out, implant, "IMPLANT", bone.cells().size());
      write_material(out, scene.bone, "BONE");
      write_material(out, scene.implant, "IMPLANT");
      write_contact(out);
      write_fixed_nodes(out);
      for (unsigned int step = 1; step < times.size(); ++step)
        write_step(out, step);
    }

  private:
    static bool
    is_quadratic(const std::string &element)
    {
      return element == "C3D20" || element == "C3D20R";
    }

    const Nodes &
    nodes(const BulkSpace &body) const
    {
      return &body == &implant ? implant_nodes : bone_nodes;
    }

    unsigned int
    number(const BulkSpace &body, const unsigned int node) const
    {
      return 1 + node + (&body == &implant ? bone_nodes.positions.size() : 0);
    }

    static bool
    is_at(const BulkSpace &body, const Eigen::Vector3d &X, const double z)
    {
      return std::abs(X[2] - z) < 1e-9 * body.parameters().thickness();
    }

    std::vector<unsigned int>
    top_of_implant() const
    {
      std::vector<unsigned int> top;
      for (unsigned int n = 0; n < implant_nodes.positions.size(); ++n)
        if (is_at(implant,
                  implant_nodes.positions[n],
                  scene.implant.thickness()))
          top.push_back(n);
      return top;
    }

    void
    write_nodes(std::ostream &out) const
    {
      out << "*NODE\n";
      for (const BulkSpace *body : {&bone, &implant})
        for (unsigned int n = 0; n < nodes(*body).positions.size(); ++n)
          {
            const Eigen::Vector3d &X = nodes(*body).positions[n];
            out << number(*body, n) << ", " << to_text(X[0]) << ", "
                << to_text(X[1]) << ", " << to_text(X[2]) << '\n';
          }
      out << "*NSET, NSET=TOP\n";
      for (const unsigned int n : top_of_implant())
        out << number(implant, n) << '\n';
    }

    // A line holds 16 numbers at most.
    void
    write_elements(std::ostream      &out,
                   const BulkSpace   &body,
                   const std::string &name,
                   const unsigned int n_before) const
    {
      out << "*ELEMENT, TYPE=" << element << ", ELSET=" << name << '\n';
      for (unsigned int cell = 0; cell < body.cells().size(); ++cell)
        {
          out << 1 + n_before + cell;
          const std::vector<unsigned int> &of_cell = nodes(body).elements[cell];
          for (unsigned int i = 0; i < of_cell.size(); ++i)
            out << (i == 12 ? ",\n" : ", ") << number(body, of_cell[i]);
          out << '\n';
        }
      out << "*SURFACE, TYPE=ELEMENT, NAME=FACE_OF_" << name << '\n';
      for (unsigned int cell = 0; cell < body.cells().size(); ++cell)
        if (body.cells()[cell].enriched)
          out << 1 + n_before + cell
              << (body.side() == Side::bone ? ", S2\n" : ", S1\n");
    }

    void
    write_material(std::ostream         &out,
                   const BodyParameters &body,
                   const std::string    &name) const
    {
      const double E = body.young_modulus, nu = body.poisson_ratio;
      out << "*MATERIAL, NAME=" << name << '\n';
      if (body.material == Material::linear)
        out << "*ELASTIC\n" << to_text(E) << ", " << to_text(nu) << '\n';
      else
        out << "*HYPERELASTIC, NEO HOOKE\n"
            << to_text(E / (4 * (1 + nu))) << ", "
            << to_text(6 * (1 - 2 * nu) / E) << '\n';
      out << "*SOLID SECTION, ELSET=" << name << ", MATERIAL=" << name << '\n';
    }

    void
    write_contact(std::ostream &out) const
    {
      const InterfaceParameters &interface = scene.interface;
      const double mu = interface.friction->coefficient({0.}, 0.).mu;
      const bool   slave_is_implant = interface.slave == Side::implant;
      // The tension behind the slope means nothing for this type of contact.
      out << "*SURFACE INTERACTION, NAME=INTERFACE\n"
             "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n"
          << to_text(interface.normal_penalty) << ", 1.\n";
      if (mu > 0)
        out << "*FRICTION\n"
            << to_text(mu) << ", " << to_text(interface.tangential_stiffness())
            << '\n';
      out << "*CONTACT PAIR, INTERACTION=INTERFACE, TYPE=SURFACE TO SURFACE\n"
          << (slave_is_implant ? "FACE_OF_IMPLANT, FACE_OF_BONE\n" :
                                 "FACE_OF_BONE, FACE_OF_IMPLANT\n");
    }

    // As BulkSpace does, but for the nodes of the contact face themselves.
    void
    write_fixed_nodes(std::ostream &out) const
    {
      const double height = scene.bone.thickness();
      out << "*BOUNDARY\n";
      for (unsigned int node = 0; node < bone_nodes.positions.size(); ++node)
        {
          const Eigen::Vector3d &X = bone_nodes.positions[node];
          const unsigned int     n = number(bone, node);
          if (is_at(bone, X, -height))
            out << n << ", 1, 3\n";
          else
            for (unsigned int d = 0; d < 2; ++d)
              if (std::abs(X[d]) > scene.bone.size[d] / 2 * (1 - 1e-9))
                out << n << ", " << d + 1 << ", " << d + 1 << '\n';
        }
    }

    // One step of CalculiX for each planned step: its end is hit exactly, and
    // the last increment, the one that is printed, is always that end.
    void
    write_step(std::ostream &out, const unsigned int step)
    {
      const double time     = times[step];
      const double duration = time - times[step - 1];
      chuck.prescribe(time);
      out << "** step, time, angle [deg]: " << step << ' ' << to_text(time)
          << ' ' << to_text(chuck.position()[5] * 180 / M_PI) << '\n'
          << "*STEP, NLGEOM, INC=10000\n"
             "*STATIC\n"
          << to_text(duration) << ", " << to_text(duration) << "\n*BOUNDARY\n";
      for (const unsigned int n : top_of_implant())
        {
          const Eigen::Vector3d &X = implant_nodes.positions[n];
          const Eigen::Vector3d  u = chuck.map(X, Eigen::Vector3d::Zero()) - X;
          for (unsigned int d = 0; d < 3; ++d)
            out << number(implant, n) << ", " << d + 1 << ", " << d + 1 << ", "
                << to_text(u[d]) << '\n';
        }
      out << "*NODE PRINT, NSET=TOP, FREQUENCY=10000\nRF\n*END STEP\n";
    }

    const Scene               scene;
    const std::string         element;
    const BulkSpace           bone, implant;
    const Nodes               bone_nodes, implant_nodes;
    Chuck                     chuck;
    const std::vector<double> times;
  };



  void
  act(const std::vector<std::string> &words)
  {
    std::vector<std::string> files, overrides;
    std::string              element = "C3D8";
    for (std::size_t i = 0; i < words.size(); ++i)
      if (words[i] == "--help")
        {
          std::cout << help_text;
          return;
        }
      else if ((words[i] == "--set" || words[i] == "--element") &&
               i + 1 < words.size())
        {
          const bool is_set = words[i] == "--set";
          ++i;
          if (is_set)
            overrides.push_back(words[i]);
          else
            element = words[i];
        }
      else if (words[i].substr(0, 1) == "-")
        throw InputError("calculix_input: unknown option or missing value '" +
                         words[i] + "' (see calculix_input --help)");
      else
        files.push_back(words[i]);
    if (files.size() != 2)
      throw InputError("calculix_input: a scene and a file to write are needed "
                       "(see calculix_input --help)");

    const Scene scene = Scene::from_file(files[0], overrides);
    check(scene);
    std::ostringstream text;
    Input(scene, element).write(text);
    write_file(files[1], text.str());
  }
} // namespace



int
main(int argc, char *argv[])
{
  Debond::set_up_libraries();
  try
    {
      act({argv + 1, argv + argc});
      return 0;
    }
  catch (const std::exception &error)
    {
      std::cerr << error.what() << std::endl;
      return 1;
    }
}
