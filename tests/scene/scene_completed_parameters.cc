// The completed parameters name every entry with its value and give the same
// scene again; so does what --print-parameters prints.

#include <debond/input/scene_file.h>
#include <debond/scene/scene.h>

#include <sstream>
#include <string>
#include <vector>

#include "checks.h"
#include "coin_scene.h"

using namespace Debond;

/** "Expert / Interface / Slave = implant" of each entry. */
std::vector<std::string>
entries_of(const std::string &text)
{
  std::vector<std::string> result;
  for (const SceneEntry &entry : read_scene_text(text, "text"))
    result.push_back(entry.full_name() + " = " + entry.value);
  return result;
}

std::string
printed(const Scene *scene)
{
  std::ostringstream text;
  print_parameters(text, scene);
  return text.str();
}

int
main()
{
  const std::string turning = "subsection Chuck\n"
                              "  subsection Rotation z\n"
                              "    set Value = 10 * max(t - 1, 0) # degrees\n"
                              "  end\n"
                              "end\n";
  // the values of a scene that nothing was said of, which are the coin's, but
  // for the entry that is given
  Scene usual;
  usual.complete();
  std::vector<std::string> expected = entries_of(printed(&usual));
  for (std::string &entry : expected)
    if (entry.rfind("Chuck / Rotation z / Value = ", 0) == 0)
      entry = "Chuck / Rotation z / Value = 10 * max(t - 1, 0)";
  const auto completed = entries_of(coin_scene(turning).completed_parameters);
  report("every entry is there, with its usual value or what is given",
         completed.size() > 100 && completed == expected);

  const Scene scene = coin_scene(turning,
                                 {"Title=a = \"b\", ä",
                                  "Implant/Shape=block",
                                  "Implant/Cells=4, 5, 2",
                                  "Bone/Material=linear",
                                  "Expert/Interface/Slave=bone"});
  const Scene again = Scene::from_text(scene.completed_parameters);
  report("round trip of the completed parameters",
         again.completed_parameters == scene.completed_parameters);
  report("round trip of the printed parameters",
         Scene::from_text(printed(&scene)).completed_parameters ==
           scene.completed_parameters);

  // without default and not said: open, and so when it is read again
  const Scene rigid = Scene::from_text(
    "set Accuracy = none\n" + turning +
    "subsection Bone\n set Material = rigid\n set Size = 9, 9, 3\nend\n"
    "subsection Implant\n set Material = rigid\n set Radius = 2\n"
    " set Height = 1\nend\n"
    "subsection Interface\n set Friction law = frictionless\n"
    " set Normal stiffness = 100\nend\n");
  const auto open = entries_of(rigid.completed_parameters);
  report("what was not said stays open",
         std::count(open.begin(),
                    open.end(),
                    "Interface / Characteristic slip distance = ") == 1 &&
           std::count(open.begin(), open.end(), "Implant / Radius = 2") == 1 &&
           Scene::from_text(rigid.completed_parameters).completed_parameters ==
             rigid.completed_parameters &&
           Scene::from_text(printed(&rigid)).completed_parameters ==
             rigid.completed_parameters);

  const BodyParameters &implant = again.implant;
  report("cells of the implant",
         implant.cells[0] == 4 && implant.cells[1] == 5 &&
           implant.cells[2] == 2);
  report("tangential penalty",
         std::abs(again.interface.tangential_stiffness() - 585.),
         1e-12);
}
