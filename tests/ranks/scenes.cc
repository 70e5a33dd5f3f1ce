// Bones solved by multigrid on several ranks, against the direct solver on one:
// torques and reactions of all rows, to 1e-8 of the largest, with a residual
// tolerance of 1e-11 and the same steps. The direct solver is what the other
// tests compare with exact solutions and independent codes.
//
// Scenes: trilinear and spline elements, Neo-Hooke, a loaded chuck with a
// compliant machine, a pattern, the bone as slave, a path that is followed, two
// bones whose modulus varies, a cap with bilinear faces and adaptive steps;
// quadratic elements, cells that are coarser below, a bone from a file, a
// pin and a cup in their bores, hardly more cells than ranks.

#include <debond/models/simulation.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>

#include <algorithm>

#include "../checks.h"
#include "../driven_scene.h"
#include "../pressed_and_turned.h"

using namespace Debond;

using Changes = std::vector<std::string>;



/** A coin on a bone with these entries. */
std::string
coin_on(const std::string &bone)
{
  return pressed_and_turned + "subsection Bone\nset Material = linear\n" +
         bone +
         R"(
end
subsection Implant
  set Cells    = 4, 2
  set Material = linear
end
subsection Load steps
  set Times = 0, 1, 1.05, 1.2
  set Steps = 1, 4, 3
end
subsection Expert
  subsection Load steps
    set Residual tolerance = 1e-11
  end
end
)";
}

const std::string block = "set Cells = 12, 12, 4",
                  core  = "set Shape = file\nset Mesh file = " DEBOND_SOURCE_DIR
                         "/prm/meshes/bone_core.msh";

const Changes splines{"Bone/Element=spline", "Expert/Bone/Layer grading=1.5"};

/** The rows of a run. */
std::vector<TorqueRow>
rows_of(const Changes &changes, const std::string &bone)
{
  const Scene scene = coin_scene(coin_on(bone), changes);
  Simulation  simulation(scene);
  simulation.run();
  // Where adaptive steps end depends on the last digits of their estimates.
  const auto            &times = scene.load_steps.times;
  std::vector<TorqueRow> rows;
  for (const TorqueRow &row : simulation.rows())
    if (!scene.load_steps.adaptive ||
        std::count(times.begin(), times.end(), row.time) > 0)
      rows.push_back(row);
  return rows;
}



/** Largest difference of forces and moments over the largest of them, a moment
 *  counting as a force at the distance R. */
double
difference(const std::vector<TorqueRow> &one,
           const std::vector<TorqueRow> &other)
{
  if (one.size() != other.size())
    return std::numeric_limits<double>::infinity();
  constexpr double R      = 2.5;
  double           change = 0., largest = 0.;
  for (unsigned int i = 0; i < one.size(); ++i)
    for (unsigned int k = 0; k < 6; ++k)
      {
        const double scale = k < 3 ? 1. : R;
        const double a     = one[i].chuck_reaction[k] / scale,
                     b     = other[i].chuck_reaction[k] / scale;
        grow(change, std::abs(a - b));
        grow(largest, std::abs(b));
      }
  return change / largest;
}



void
compare(const std::string &name,
        const Changes     &changes,
        const std::string &bone = block)
{
  const auto whole =
    rows_of(changes + Changes{"Expert/Bone/Solver=multigrid"}, bone);
  std::vector<TorqueRow> direct;
  {
    const Ranks::Together alone(MPI_COMM_SELF);
    direct = rows_of(changes + Changes{"Expert/Bone/Solver=direct"}, bone);
  }
  if (!Ranks::is_first())
    return;
  report(name, difference(whole, direct), 1e-8);
}



int
main()
{
  set_up_libraries();
  Ranks::start();
  compare("trilinear", {});
  compare("Neo-Hooke",
          {"Bone/Material=neo-hookean", "Implant/Material=neo-hookean"});
  compare("splines", splines);
  compare("pressed by a force, turned by a compliant machine",
          {"Chuck/Press/Control=force",
           "Chuck/Press/Value=10 + 41.5 * min(t, 1)",
           "Chuck/Rotation z/Stiffness=4000"});
  compare("pattern, the bone as slave",
          {"Interface/Bonding/Pattern=expression",
           "Interface/Bonding/Expression=x > 0.3",
           "Expert/Interface/Slave=bone"});
  compare("a path that is followed",
          {"Load steps/Path following=slip",
           "Load steps/Times=0,1,1.1",
           "Load steps/Steps=1,15",
           "Expert/Load steps/Residual tolerance=1e-10"});
  compare("modulus by the place",
          {"Bone/Young modulus=18000 * exp(0.3 * x - (z + 1)^2)"});
  compare("splines, modulus of 1 to 100 by the place, Neo-Hooke",
          splines + Changes{"Bone/Young modulus=if(x + z > -1, 18000, 180)",
                            "Bone/Material=neo-hookean"});
  compare("splines, an oblique jump of 10, stiff contact",
          splines +
            Changes{"Bone/Young modulus=if(z + 0.2 * x > -1, 1800, 18000)",
                    "Interface/Normal stiffness=18000"});
  compare("a cap with bilinear faces, adaptive steps",
          {"Implant/Shape=cap",
           "Expert/Implant/Contact surface=bilinear",
           "Expert/Bone/Contact surface=bilinear",
           "Load steps/Adaptive=true",
           "Load steps/Steps=1, 1, 1"});
  compare("a modulus along x", {"Bone/Young modulus=18000 * exp(0.3 * x)"});
  compare("quadratic elements",
          {"Bone/Element=quadratic",
           "Bone/Cells=8, 8, 2",
           "Bone/Material=neo-hookean"});
  compare("hanging nodes", {"Expert/Bone/Coarser below=true"});
  compare("quadratic elements, hanging nodes",
          {"Bone/Element=quadratic",
           "Expert/Bone/Coarser below=true",
           "Bone/Cells=8, 8, 2"});
  compare("a bone from a file", {}, core);
  compare("a pin in a sleeve",
          {"Bone/Shape=sleeve",
           "Bone/Outer radius=5",
           "Bone/Cells=8, 2, 2",
           "Implant/Shape=pin",
           "Implant/Cells=8, 1, 2",
           "Interface/Interference=0.01"});
  compare("a cup in a shell",
          {"Bone/Shape=cavity",
           "Bone/Outer radius=5",
           "Bone/Cells=8, 2, 1",
           "Implant/Shape=cup",
           "Implant/Height=2",
           "Implant/Cells=8, 1, 1",
           "Interface/Interference=0.01"});
  compare("few cells", {"Bone/Cells=4, 3, 1"});
  Ranks::finish();
}
