// The strain is so small (a thousandth) that linear and Neo-Hookean bodies give
// the same torque curve to a hundred-thousandth. Where it is large the linear
// body says by how much they differ: by as much as its top moves less or
// further than that of a Neo-Hookean one under the same forces.

#include <debond/models/simulation.h>

#include "driven_scene.h"
#include "pressed_and_turned.h"

const std::string scene_text =
  pressed_then("Rotation z", "10 * max(t - 1, 0)") + R"(
subsection Load steps
  set Times = 0, 1, 2
  set Steps = 1, 100
end
subsection Expert
  subsection Load steps
    set Residual tolerance = 1e-10
  end
end
)";

void
test()
{
  const auto nonlinear = run_scene("neo-hookean", scene_text);
  for (const auto &[bone, implant] :
       {std::pair<std::string, std::string>{"linear", "linear"},
        {"neo-hookean", "linear"},
        {"linear", "neo-hookean"}})
    {
      const auto linear =
        run_scene(bone + "-" + implant,
                  scene_text,
                  {"Bone/Material=" + bone, "Implant/Material=" + implant});
      double T_max = 0, torque = 0, force = 0;
      for (std::size_t i = 0; i < nonlinear.size(); ++i)
        {
          grow(T_max, std::abs(nonlinear[i].torque_Nmm));
          grow(torque,
               std::abs(linear[i].torque_Nmm - nonlinear[i].torque_Nmm));
          grow(force,
               std::abs(linear[i].force_N - nonlinear[i].force_N) /
                 nonlinear[1].force_N);
        }
      std::cout << "bone " << bone << ", implant " << implant << std::endl;
      report("  torque differs relative to the largest", torque / T_max, 1e-5);
      report("  force differs", force, 1e-4);
      // equal to the last digit would mean that the entry was not heeded
      report("  but they are not the same", torque / T_max > 1e-9);
    }
}



// A soft implant on rigid bone is pressed and pushed sideways by forces [N].
void
compare_estimate(const std::string &what,
                 const std::string &shape,
                 const double       press,
                 const double       shove)
{
  using namespace Debond;
  const std::string scene =
    "subsection Bone\n set Material = rigid\nend\n"
    "subsection Implant\n set Young modulus = 20\n" +
    shape +
    "end\n"
    "subsection Interface\n"
    "  set Friction law = coulomb\n"
    "  set Friction coefficient = 10\n"
    "  set Normal stiffness = 1000\n"
    "end\n"
    "subsection Chuck\n"
    "  subsection Translation x\n set Control = force\n set Value = " +
    std::to_string(shove) +
    " * max(t - 1, 0)\n end\n"
    "  subsection Translation z\n set Control = force\n set Value = -" +
    std::to_string(press) +
    " * min(t, 1)\n end\n"
    "end\n"
    "subsection Load steps\n set Times = 0, 1, 2\n set Steps = 4, 8\nend\n";
  Eigen::Vector3d way[2];
  double          estimate = 0.;
  for (const bool is_linear : {true, false})
    {
      Simulation simulation(
        coin_scene(scene,
                   {std::string("Implant/Material=") +
                    (is_linear ? "linear" : "neo-hookean")}));
      simulation.run();
      way[is_linear] = simulation.system().chuck.position().head<3>();
      if (is_linear)
        estimate = simulation.system().implant.change_at_large_strains();
    }
  const double change = (way[0] - way[1]).norm() / way[1].norm();
  report(what + ": it differs by 0.5 % to 20 %",
         change > 0.005 && change < 0.2);
  report("  and by a third to three times of what is said",
         change > estimate / 3. && change < 3. * estimate);
}



int
main()
{
  compare_estimate("pressed a little", " set Height = 3\n", 5., 0.);
  compare_estimate("pressed", " set Height = 3\n", 20., 0.);
  compare_estimate("pressed hard", " set Height = 3\n", 60., 0.);
  compare_estimate("sheared", " set Height = 3\n", 20., 10.);
  compare_estimate("bent", " set Height = 12\n set Cells = 3, 10\n", 5., 1.);
  return run_test(test);
}
