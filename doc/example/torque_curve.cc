// The torque that it takes to turn an implant in a shallow bed of bone: a scene
// built in a program, run in memory, and its curve T(theta).

#include <debond/models/simulation.h>
#include <debond/support/runtime.h>

#include <algorithm>
#include <cstdio>

int
main()
{
  using namespace Debond;
  set_up_libraries();

  // A coin of 5 mm diameter on a block of bone, coarser than that of the paper.
  Scene scene;
  scene.bone.cells            = {{8, 8, 2}};
  scene.bone.material         = Material::linear;
  scene.implant.shape         = BodyShape::coin;
  scene.implant.cells         = {{4, 4, 2}};
  scene.implant.material      = Material::linear;
  scene.implant.young_modulus = 113000; // MPa, titanium

  // Elastic and frictional contact, with the law of Eqs. (11) to (13).
  scene.interface.normal_penalty     = 585; // MPa/mm
  scene.interface.tangential_penalty = 585;

  // Pressed in by 4.9 um until t = 1, then turned by 10 degrees until t = 2.
  scene.chuck.component[2].function = [](const double t) {
    return -0.0049 * std::min(t, 1.);
  };
  scene.chuck.component[5].function = [](const double t) {
    return 10. * std::max(t - 1., 0.);
  };
  scene.load_steps.times = {0, 1, 2};
  scene.load_steps.steps = {1, 20};
  scene.check();

  Simulation simulation(scene);
  simulation.run();
  for (const TorqueRow &row : simulation.rows())
    std::printf("%7.3f deg  %8.3f N mm\n", row.angle_deg, row.torque_Nmm);
}
