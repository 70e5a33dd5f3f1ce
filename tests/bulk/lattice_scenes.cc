// Which scenes have their bone solved on the lattice, and that their results
// are those of the direct solver: with loads and springs on the chuck, which
// are unknowns then, and with a Neo-Hookean bone, whose stiffness stays that at
// rest; and so are the derivatives of the rows. The two differ by the shear at
// the sides of the bone, which coarse cells have: 1e-7 of the forces here, 1e-9
// on 24 x 24 cells. Test lattice_bulk compares the solver itself, to 1e-11.

#include <debond/models/simulation.h>

#include "checks.h"
#include "coin_scene.h"
#include "pressed_and_turned.h"

using namespace Debond;

const std::string coin = R"(
subsection Bone
  set Cells   = 16, 16, 4
  set Element = spline
end
subsection Implant
  set Cells   = 3, 2
  set Element = spline
end
subsection Expert
  subsection Bone
    set Layer grading = 2
  end
  subsection Implant
    set Layer grading = 2
  end
end
)" + pressed_then("Rotation z", "10 * max(t - 1, 0)") +
                         R"(
subsection Load steps
  set Times = 0, 1, 1.05, 1.2
  set Steps = 1, 5, 4
end
subsection Expert
  subsection Load steps
    set Residual tolerance = 1e-10
  end
end
)";



using Changes = std::vector<std::string>;

const Changes linear{"Bone/Material=linear", "Implant/Material=linear"},
  pressed_by_force{"Chuck/Press/Control=force",
                   "Chuck/Press/Value=10 + 41.5 * min(t, 1)"};

Changes
operator+(Changes a, const Changes &b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}



void
check_choice(const std::string &name, const Changes &changes)
{
  std::cout << name << ": " << coin_scene(coin, changes).bulk_solver_in_words()
            << std::endl;
}



/** The largest difference of two rows of numbers, over the largest number. */
struct Difference
{
  double largest_change = 0., largest = 0.;

  void
  add(const double a, const double b)
  {
    grow(largest_change, std::abs(a - b));
    grow(largest, std::abs(b));
  }
  double
  relative() const
  {
    return largest_change / largest;
  }
};



void
check_results(const std::string &name, const Changes &changes)
{
  std::cout << name << '\n';
  Simulation lattice(
    coin_scene(coin, changes + Changes{"Expert/Bone/Solver=lattice"}));
  Simulation direct(
    coin_scene(coin, changes + Changes{"Expert/Bone/Solver=direct"}));
  lattice.run();
  direct.run();
  const auto &rows = lattice.rows(), &expected = direct.rows();
  report("  as many rows", rows.size() == expected.size());
  Difference   force, moment, way, energy;
  unsigned int iterations = 0, expected_iterations = 0;
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      const auto &a = rows[i], &b = expected[i];
      iterations += a.newton_iterations;
      expected_iterations += b.newton_iterations;
      for (unsigned int k = 0; k < 3; ++k)
        {
          force.add(a.chuck_reaction[k], b.chuck_reaction[k]);
          moment.add(a.chuck_reaction[3 + k], b.chuck_reaction[3 + k]);
        }
      for (unsigned int k = 0; k < 6; ++k)
        way.add(a.chuck_position[k], b.chuck_position[k]);
      energy.add(a.energy_bulk_Nmm, b.energy_bulk_Nmm);
    }
  report("  forces", force.relative(), 5e-7);
  report("  moments", moment.relative(), 5e-7);
  report("  place of the chuck", way.relative(), 5e-8);
  report("  energy of the bodies", energy.relative(), 5e-6);
  // Both have the same tangent: the exact one, that at rest for Neo-Hookean
  // bones.
  report("  at most two iterations more",
         iterations <= expected_iterations + 2);
}



int
main()
{
  check_choice("linear", linear);
  check_choice("Neo-Hookean", {});
  check_choice("Neo-Hookean, pressed deeply",
               {"Chuck/Press/Value=0.1 * min(t, 1)"});
  check_choice("Neo-Hookean, hardly tilted",
               {"Chuck/Rotation x/Value=0.02 * min(t, 1)"});
  check_choice("Neo-Hookean, tilted",
               {"Chuck/Rotation x/Value=0.6 * min(t, 1)"});
  check_choice("Neo-Hookean, pressed by a force", pressed_by_force);
  check_choice("Neo-Hookean, soft, pressed by a force",
               pressed_by_force + Changes{"Bone/Young modulus=300"});
  check_choice("linear, pressed by a force", linear + pressed_by_force);
  check_choice("linear, free in x",
               linear + Changes{"Chuck/Translation x/Control=force"});
  check_choice("linear, held in y by a spring",
               linear + Changes{"Chuck/Translation y/Stiffness=100"});
  check_choice("linear, moved to the side",
               linear + Changes{"Chuck/Translation y/Value=2 * t"});
  check_choice("linear, there and back within a planned step",
               linear +
                 Changes{"Chuck/Translation x/Value=2 * sin(pi * min(t, 1))"});
  check_choice("trilinear", linear + Changes{"Bone/Element=trilinear"});
  check_choice("cells under the implant",
               linear + Changes{"Expert/Bone/Cells under implant=8"});
  check_choice("rigid", {"Bone/Material=rigid"});
  check_choice("direct, as it is in the scene",
               linear + Changes{"Expert/Bone/Solver=direct"});

  check_results("Pressed by a force, free to tilt under a moment",
                linear + pressed_by_force +
                  Changes{"Chuck/Rotation x/Control=moment",
                          "Chuck/Rotation y/Control=moment",
                          "Chuck/Rotation y/Value=2 * max(t - 1, 0)"});
  check_results("Pulled aside by a force",
                linear +
                  Changes{"Chuck/Translation x/Control=force",
                          "Chuck/Translation x/Value=40 * max(t - 1, 0)"});
  check_results("Turned by a spring",
                linear + Changes{"Chuck/Rotation z/Stiffness=5000"});
  check_results("Neo-Hookean bodies", {});
  check_results("Neo-Hookean bodies, pressed by a force", pressed_by_force);
}
