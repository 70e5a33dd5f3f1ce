// The completed parameters name every entry with its value and give the same
// scene again; so does what --print-parameters prints.

#include <debond/scene/scene.h>

#include <iostream>
#include <sstream>

int
main()
{
  using Debond::Scene;

  const std::string turning = "subsection Chuck\n"
                              "  subsection Rotation z\n"
                              "    set Value = 10 * max(t - 1, 0) # degrees\n"
                              "  end\n"
                              "end\n";
  std::cout << Scene::from_text(turning).completed_parameters;

  const Scene scene = Scene::from_text(turning,
                                       {"Title=a = \"b\", ä",
                                        "Implant/Shape=block",
                                        "Implant/Cells=4, 5, 2",
                                        "Bone/Material=linear",
                                        "Interface/Slave=bone"});
  const Scene again = Scene::from_text(scene.completed_parameters);
  std::cout << "round trip of the completed parameters: "
            << (again.completed_parameters == scene.completed_parameters)
            << '\n';

  std::ostringstream documented;
  print_parameters(documented, &scene);
  std::cout << "round trip of the printed parameters: "
            << (Scene::from_text(documented.str()).completed_parameters ==
                scene.completed_parameters)
            << '\n';

  const Debond::BodyParameters &implant = again.implant;
  std::cout << "cells of the implant: " << implant.cells[0] << ' '
            << implant.cells[1] << ' ' << implant.cells[2] << '\n'
            << "tangential penalty: " << again.interface.tangential_stiffness()
            << '\n';
}
