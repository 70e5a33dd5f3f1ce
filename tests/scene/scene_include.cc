// A scene may include another and set its entries again, but not include what
// sets again what it has set itself. What else is refused:
// tests/bad_scenes/include.scenes.

#include <fstream>
#include <iostream>

#include "coin_scene.h"

namespace
{
  void
  show(const std::string &text)
  {
    try
      {
        const Debond::Scene scene = coin_scene(text);
        std::cout << scene.title << ", " << scene.bone.young_modulus << '\n';
      }
    catch (const Debond::InputError &error)
      {
        std::cout << error.what() << '\n';
      }
  }
} // namespace



int
main()
{
  std::ofstream("base.prm") << "set Title = base\r\n"
                               "subsection Bone\n"
                               "  set Young modulus = \\\n"
                               "    21000\n"
                               "end\n"
                               "subsection Chuck\n"
                               "  subsection Rotation z\n"
                               "    set Value = t\n"
                               "  end\n"
                               "end\n";

  show("include base.prm\n");
  show("include base.prm\nset Title = derived\n");
  show("set Title = first\ninclude base.prm\n");
}
