// Under a force faces that do not touch at first are brought into contact:
// where the depth of a cap that they find is prescribed, it takes that force; a
// tilted coin, whose load begins at nothing, and a cap whose load ends there,
// come to equilibrium. A force that pulls has none.

#include <cmath>

#include "driven_scene.h"

using namespace Debond;
using Changes = std::vector<std::string>;

const std::string pressed =
  "subsection Bone\n set Size = 10, 10, 5\n set Cells = 12, 12, 6\n"
  " set Element = spline\n set Material = linear\nend\n"
  "subsection Implant\n set Material = rigid\n set Cells = 8, 2\nend\n"
  "subsection Chuck\n subsection Press\n  set Control = force\n"
  "  set Value = 60 * t\n end\nend\n"
  "subsection Load steps\n set Times = 0, 1\n set Steps = 2\nend\n";

const Changes cap{"Implant/Shape=cap",
                  "Implant/Cap radius=40",
                  "Interface/Friction law=coulomb",
                  "Interface/Friction coefficient=0"};

TorqueRow
end_of(const std::string &what, const Changes &changes)
{
  try
    {
      const auto rows = run_scene("brought", pressed, changes);
      std::cout << what << ", " << rows.size() - 1 << " steps" << std::endl;
      return rows.back();
    }
  catch (const std::exception &error)
    {
      std::cout << what << ": " << error.what() << std::endl;
      TorqueRow none;
      none.chuck_position.fill(NAN);
      none.chuck_reaction.fill(NAN);
      return none;
    }
}



void
test()
{
  const Changes   stiff    = cap + Changes{"Interface/Normal stiffness=1e6"};
  const TorqueRow by_force = end_of("a cap under a force", stiff);
  report("  force", std::abs(by_force.chuck_reaction[2] / -60. - 1.), 1e-9);
  const double    depth = -by_force.chuck_position[2];
  const TorqueRow by_depth =
    end_of("as deep",
           stiff +
             Changes{"Chuck/Press/Control=displacement",
                     "Chuck/Press/Value=" + std::to_string(depth) + " * t"});
  report("  the same force",
         std::abs(by_depth.chuck_reaction[2] / -60. - 1.),
         1e-3);
  const TorqueRow heavy =
    end_of("1000 N at once", cap + Changes{"Chuck/Press/Value=1000"});
  report("  force", std::abs(heavy.chuck_reaction[2] / -1000. - 1.), 1e-9);
  const TorqueRow tilted =
    end_of("a tilted coin", {"Chuck/Rotation x/Value=0.5"});
  report("  force", std::abs(tilted.chuck_reaction[2] / -60. - 1.), 1e-9);
  const TorqueRow released =
    end_of("a cap that is let go",
           cap + Changes{"Chuck/Press/Value=60 * sin(pi * t)",
                         "Load steps/Steps=10"});
  report("  no force", std::abs(released.chuck_reaction[2]) < 1e-6);
  const TorqueRow pulled =
    end_of("a cap that is pulled", cap + Changes{"Chuck/Press/Value=-60 * t"});
  report("  has no place", std::isnan(pulled.chuck_position[2]));
}



int
main()
{
  return run_test(test);
}
