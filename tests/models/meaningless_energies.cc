// The work of adhesion is what a falling torque curve loses, and means nothing
// where none falls or friction at the end is not that before: summary.json then
// has null for it, and says why. Beyond a jump the curve is that of a machine
// without a spring: the energy released in the jump is no work on the bond.

#include <debond/models/debonding_problem.h>
#include <debond/output/result_files.h>
#include <debond/scene/scene.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "checks.h"
#include "pressed_and_turned.h"

using namespace Debond;

const std::string rigid_coin =
  std::string("subsection Bone\n set Material = rigid\nend\n"
              "subsection Implant\n set Material = rigid\nend\n") +
  pressed_and_turned +
  "subsection Load steps\n set Steps = 1, 50\nend\n"
  "subsection Output\n"
  " set Directory = results\n"
  " set Fields every = none\n"
  " set Console = quiet\n"
  "end\n";



nlohmann::ordered_json
summary_with(const std::vector<std::string> &overrides)
{
  Scene scene = Scene::from_text(rigid_coin, overrides, "scene.prm");
  scene.output.overwrite_other_results = true;
  std::ostringstream log; // its warnings
  auto *const        console = std::cout.rdbuf(log.rdbuf());
  DebondingProblem(scene).run();
  std::cout.rdbuf(console);
  return read_json("results/summary.json");
}



void
show(const std::string &what, const std::vector<std::string> &overrides)
{
  const auto  summary = summary_with(overrides);
  std::string given;
  for (const char *const name :
       {"E_fric_Nmm", "W_adh_Nmm", "w_adh_N_per_m", "w_adh_star_N_per_m"})
    if (!summary[name].is_null())
      given += std::string(" ") + name;
  std::cout << what << ": given are" << (given.empty() ? " none" : given)
            << ", remarks " << summary.value("remarks", summary["none"])
            << std::endl;
}



int
main()
{
  const std::string rotation = "Chuck/Rotation z/Value=",
                    push     = "Chuck/Press/Value=",
                    law      = "Interface/Friction ";
  show("a bond that breaks", {});
  show("nothing bonded", {"Interface/Bonding/Bonding degree=0"});
  show("nothing bonded, but observed",
       {"Interface/Bonding/Bonding degree=0", "Output/Observed bonding=0.5"});
  show("Coulomb's law", {law + "law=coulomb"});
  show("pressed while turning", {push + "0.0049 * t / 2"});
  show("turned from the first time on, in one step with the push",
       {rotation + "5 * t", "Load steps/Times=0, 2", "Load steps/Steps=2"});
  show("sheared before it turns",
       {"Load steps/Times=0, 1, 2, 3",
        "Load steps/Steps=1, 10, 25",
        "Chuck/Translation x/Value=0.02 * min(max(t - 1, 0), 1)",
        rotation + "10 * max(t - 2, 0)"});
  show("the angle of another curve", {"Output/Friction energy from angle=2"});
  show("rows that stand still between the others",
       {rotation + "if(t > 1, floor((t - 1) * 25 + 1e-9) / 2.5, 0)"});
  show("pulled off before it turns",
       {push + "0.0049 * min(1 - abs(2 * t - 1), 0.5)"});
  show("the end before the largest torque", {rotation + "0.2 * max(t - 1, 0)"});
  show("the end before the bond is broken", {rotation + "max(t - 1, 0)"});
  show("the end before full sliding", {"Output/Friction energy from angle=11"});
  show("coefficients swapped",
       {law + "coefficient broken=0.58", law + "coefficient unbroken=0.40"});
  show("a rotation that turns back", {rotation + "5 * sin(2 * max(t - 1, 0))"});
  show("no rotation", {rotation + "0"});

  // a brittle bond under a soft machine: rotation control jumps, the path of
  // equilibrium does not
  const std::vector<std::string> brittle{"Interface/Characteristic slip distance=0.005",
                                         "Interface/Transition factor=0.3",
                                         rotation + "2 * max(t - 1, 0)",
                                         "Chuck/Rotation z/Stiffness=3000",
                                         "Implant/Cells=12, 2",
                                         push + "2.6 / 585 * min(t, 1)",
                                         "Load steps/Steps=1, 400"};
  const auto                     jumps = summary_with(brittle);
  auto                           path  = brittle;
  path.push_back("Load steps/Path following=slip");
  const auto follows = summary_with(path);
  std::cout << "a jump: " << jumps["jumps"] << ", remarks "
            << jumps["remarks"].size() << std::endl;
  for (const char *const name : {"E_deb_Nmm", "W_adh_Nmm"})
    report(std::string(name) + " beside that of the path, relative",
           std::abs(jumps[name].get<double>() / follows[name].get<double>() -
                    1.),
           2e-3);
}
