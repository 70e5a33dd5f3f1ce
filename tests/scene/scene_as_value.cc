// A scene is a plain value: one that is made without any text has the same
// parameters as one that is read, and its mistakes are refused in the same
// words.

#include <debond/scene/scene.h>
#include <debond/support/number_text.h>

#include <functional>
#include <iostream>
#include <limits>
#include <string>

#include "coin_scene.h"
#include "pressed_and_turned.h"

namespace
{
  using namespace Debond;

  Scene
  turning()
  {
    Scene scene;
    scene.title                    = "made";
    scene.bone.size                = {{10, 11, 4.5}};
    scene.implant.young_modulus    = 1.1e5;
    scene.interface.slave          = Side::bone;
    scene.load_steps.times         = {0, 1, 3};
    scene.load_steps.steps         = {2, 10};
    scene.load_steps.adaptive      = true;
    scene.load_steps.tolerance     = 1. / 3.;
    scene.chuck.press.value        = "0.0049 * min(t, 1)";
    scene.chuck.component[5].value = "10 * max(t - 1, 0)";
    scene.chuck.read_tables();
    return scene;
  }

  const std::string the_same = "set Title = made\n"
                               "subsection Bone\n"
                               "  set Size = 10, 11, 4.5\n"
                               "end\n"
                               "subsection Implant\n"
                               "  set Young modulus = 110000\n"
                               "end\n"
                               "subsection Expert\n"
                               "  subsection Interface\n"
                               "    set Slave = bone\n"
                               "  end\n"
                               "end\n"
                               "subsection Load steps\n"
                               "  set Times = 0, 1, 3\n"
                               "  set Steps = 2, 10\n"
                               "  set Adaptive = true\n"
                               "  set Tolerance = 0.3333333333333333\n"
                               "end\n" +
                               pressed_and_turned;



  void
  show(const std::function<void(Scene &)> &mistake)
  {
    Scene scene = turning();
    mistake(scene);
    try
      {
        scene.check();
        std::cout << "accepted\n";
      }
    catch (const InputError &error)
      {
        std::cout << scene.with_place(error).what() << '\n';
      }
  }
} // namespace



int
main()
{
  Scene made = turning();
  made.check();
  made.complete();
  const Scene read = coin_scene(the_same);
  std::cout << "made as read: "
            << (made.completed_parameters == read.completed_parameters) << '\n'
            << "tolerance as it was: "
            << (read.load_steps.tolerance == made.load_steps.tolerance) << '\n';

  show([](Scene &scene) { scene.bone.poisson_ratio = 0.5; });
  show([](Scene &scene) {
    scene.bone.young_modulus = std::numeric_limits<double>::quiet_NaN();
  });
  show([](Scene &scene) { scene.interface.quadrature_points = 65; });
  show([](Scene &scene) { scene.implant.cells = {{2, 3, 2}}; });
  show([](Scene &scene) { scene.load_steps.steps = {1}; });
  show([](Scene &scene) { scene.chuck = ChuckParameters(); });

  // elements of the implant are 5/3 mm wide, 60 cells across 10 mm 1/6 mm
  for (const unsigned int cells : {15, 60})
    for (const ElementKind element :
         {ElementKind::trilinear, ElementKind::spline})
      {
        Scene scene           = turning();
        scene.interface.slave = Side::implant;
        scene.bone.element    = element;
        scene.bone.cells      = {{cells, cells, 2}};
        std::cout
          << "points: "
          << scene.interface.points_per_element(scene.bone, scene.implant)
               .size()
          << '\n';
      }

  for (const double number :
       {0., -1., 0.1, 585., 18000., 113000., 1e6, 1e-3, 1e-8, 0.022, 1. / 3.})
    std::cout << exact_text(number) << (number == 1. / 3. ? "\n" : " ");
}
