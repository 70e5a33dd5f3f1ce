// Mistakes in a text that is no file, as the library and the module of Python
// read it, and those that none of tests/bad_scenes has: one message says where
// it is, what was read and what is allowed.

#include <debond/scene/scene.h>

#include <iostream>
#include <string>
#include <vector>

#include "coin_scene.h"

namespace
{
  const std::string turning = "subsection Chuck\n"
                              "  subsection Rotation z\n"
                              "    set Value = 10 * t\n"
                              "  end\n"
                              "end\n";



  void
  show(const std::string              &mistake,
       const std::string              &text,
       const std::vector<std::string> &overrides = {})
  {
    std::cout << mistake << ":\n  ";
    try
      {
        coin_scene(text, overrides, "scene.prm");
        std::cout << "accepted\n";
      }
    catch (const Debond::InputError &error)
      {
        std::cout << error.what() << '\n';
      }
  }



  /** A line in the subsection @p name of a scene that is right otherwise. */
  std::string
  in(const std::string &name, const std::string &line)
  {
    return "subsection " + name + "\n  " + line + "\nend\n" + turning;
  }
} // namespace



int
main()
{
  show("nothing wrong", turning);
  show("broken whole number", in("Bone", "set Cells = 15, 15, 2.5"));
  show("unknown task", "set Task = optimise\n" + turning);
  show("unknown in a scene that is simulated",
       in("Bone", "set Young modulus = <<18000 in 1..2>>"));
  show("study", in("Bone", "set Young modulus = {{18000|21000}}"));
  show("wrong override", turning, {"Interface/Normal stiffness=-1"});
  show("radius of the sphere of a coin", in("Implant", "set Cap radius = 20"));
  show("low cap",
       in("Implant", "set Height = 0.5"),
       {"Implant/Shape=cap", "Implant/Cap radius=3"});
  show("thin cells", turning, {"Expert/Bone/Lateral grading=9"});
  show("old place", in("Implant", "set Layer grading = 2"));
  show("too many cells", in("Bone", "set Cells = 2000, 2000, 2"));
}
