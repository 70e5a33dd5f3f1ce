// What a run warns of by itself: each scene that deserves it, and the same with
// the cure. The names of the checks are printed, not their texts.

#include <debond/models/forecast.h>
#include <debond/models/simulation.h>
#include <debond/support/runtime.h>

#include <iostream>
#include <string>
#include <vector>

#include "coin_scene.h"
#include "pressed_and_turned.h"

using namespace Debond;

const std::string coin = std::string("subsection Bone\n"
                                     " set Material = linear\n"
                                     "end\n"
                                     "subsection Implant\n"
                                     " set Material = linear\n"
                                     "end\n") +
                         pressed_and_turned;



void
show(const std::string &name, const std::vector<std::string> &overrides)
{
  const Scene scene = coin_scene(coin, overrides, "scene.prm");
  Simulation  simulation(scene);
  simulation.run();
  std::cout << name << ":";
  for (const Warning &warning : simulation.warnings())
    std::cout << " [" << warning.check << "]";
  if (!difference_from_forecast(scene, simulation.rows()).empty())
    std::cout << " [forecast]";
  std::cout << "\n";
}



int
main()
{
  set_up_libraries();
  const std::string push = "Chuck/Press/Value=",
                    turn = "Chuck/Rotation z/Value=";
  show("3 steps, which go over the peak", {"Load steps/Steps=1, 3"});
  show("100 steps", {"Load steps/Steps=1, 100"});

  // on a coin of 2.5 mm
  const std::string few = "Load steps/Steps=1, 1", rigid = "Material=rigid";
  for (const std::string expression : {"r > 2.5", "r > 2.4"})
    show("bonded where " + expression,
         {few,
          "Bone/" + rigid,
          "Implant/" + rigid,
          "Interface/Bonding/Pattern=expression",
          "Interface/Bonding/Expression=" + expression});

  // Linear bodies are off by 1.7 % of the torque there, with a strain of 0.17.
  const std::string soft  = "Bone/Young modulus=40",
                    steps = "Load steps/Steps=4, 8";
  show("deep in soft bone", {soft, steps, push + "0.3 * min(t, 1)"});
  show("the same, Neo-Hookean",
       {soft, steps, push + "0.3 * min(t, 1)", "Bone/Material=neo-hookean"});

  const std::vector<std::string> stiff = {"Implant/Radius=1.7",
                                          "Bone/Young modulus=700",
                                          "Bone/Cells=15, 15, 3",
                                          "Load steps/Times=0, 1",
                                          "Load steps/Steps=1",
                                          turn + "0"};
  auto                           with  = [&stiff](const std::string &entry) {
    std::vector<std::string> all = stiff;
    all.push_back(entry);
    return all;
  };
  show("too stiff for its cells", with("Interface/Normal stiffness=1e5"));
  show("the same in larger cells",
       {stiff[0],
        stiff[1],
        "Bone/Cells=12, 12, 2",
        stiff[3],
        stiff[4],
        stiff[5],
        "Interface/Normal stiffness=1e5"});
  show("not too stiff", with("Interface/Normal stiffness=1e3"));

  // A spring throws a block over the edge of the bone.
  show("leap over the edge",
       {"Bone/Material=rigid",
        "Bone/Size=4.5, 4.5, 3",
        "Bone/Cells=12, 12, 2",
        "Implant/Material=rigid",
        "Implant/Shape=block",
        "Implant/Size=4, 4, 2",
        "Implant/Cells=8, 8, 2",
        "Interface/Characteristic slip distance=0.005",
        "Interface/Transition factor=0.3",
        "Chuck/Translation x/Value=4 * max(t - 1, 0)",
        "Chuck/Translation x/Stiffness=10",
        turn + "0",
        "Load steps/Times=0, 1, 2",
        "Load steps/Steps=1, 400"});

  // A coin is lowered beside the bone, and moved in; from above, too. A block
  // that hangs over the edge is moved in as well.
  const std::vector<std::string> beside = {"Bone/Material=rigid",
                                           "Implant/Material=rigid",
                                           turn + "0",
                                           "Load steps/Times=0, 1",
                                           "Load steps/Steps=20"};
  const auto move_in = [&](const std::string &x, const std::string &z) {
    std::vector<std::string> all = beside;
    all.push_back("Chuck/Translation x/Value=" + x);
    all.push_back(push + "-(" + z + ")");
    return all;
  };
  show("from the side", move_in("12 - 8 * t", "-0.05"));
  show("in one step", [&] {
    auto all = move_in("12 - 8 * t", "-0.005");
    all.push_back("Load steps/Steps=1");
    return all;
  }());
  show("from the side, the bone as slave", [&] {
    auto all = move_in("12 - 8 * t", "-0.05");
    all.push_back("Expert/Interface/Slave=bone");
    return all;
  }());
  show("from above", move_in("12 - 8 * t", "if(t < 0.9, 0.05, 0.95 - t)"));
  show("hangs over and slides in",
       move_in("if(t < 0.5, 6, 8 - 4 * t)", "-0.05 * min(2 * t, 1)"));

  // Between rigid bodies that are held at every moment nothing can jump, though
  // trapezoids are wrong where the load turns back, and nowhere by more than
  // chords are too short: also where a bone gives way.
  show("to and fro on a rigid bond",
       {"Bone/Material=rigid",
        "Implant/Material=rigid",
        "Interface/Law=mixed mode",
        "Load steps/Steps=1, 50",
        push + "0.0049 * min(t, 1) + 0.001 * sin(9 * max(t - 1, 0))",
        turn + "0.3 * max(t - 1, 0)"});
  const std::vector<std::string> pin = {"Bone/Shape=sleeve",
                                        "Bone/Outer radius=6",
                                        "Bone/Ends=slide",
                                        "Bone/Cells=16, 2, 1",
                                        "Implant/Material=rigid",
                                        "Implant/Shape=pin",
                                        "Implant/Radius=2",
                                        "Implant/Height=5",
                                        "Implant/Cells=16, 1, 1",
                                        "Interface/Interference=0.02",
                                        push + "0",
                                        "Load steps/Times=0, 1",
                                        "Load steps/Steps=10"};
  const auto with_pin = [&pin](const std::vector<std::string> &more) {
    std::vector<std::string> all = pin;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  show("a pin in large steps", with_pin({turn + "40 * t"}));
  show("the same, all rigid",
       with_pin({turn + "40 * t", "Bone/Material=rigid"}));
  // What comes and goes between two rows is a part of the load.
  show("a press fit that comes and goes in a step",
       with_pin({turn + "2 * t",
                 "Interface/Interference=0.02 + 0.01 * if(t < 0.85, max(t - "
                 "0.8, 0), max(0.9 - t, 0))"}));
  show("one that goes",
       with_pin({turn + "2 * t", "Interface/Interference=0.02 - 0.01 * t"}));
  // Points at the rim have slid further, and stand higher, than in the middle.
  show("lifted from what has worn",
       {"Interface/Law=dilatant",
        "Interface/Dilatant/Height=0.05",
        "Interface/Dilatant/Length=0.5",
        "Load steps/Times=0, 1, 2, 3",
        "Load steps/Steps=1, 20, 4",
        push + "if(t < 1, 0.002 * t, 0.002 - 0.02 * max(t - 2, 0))",
        turn + "10 * min(max(t - 1, 0), 1)",
        "Chuck/Rotation x/Value=0.2 * max(t - 2, 0)"});

  // Patches of a bond that are pulled, with nothing between them.
  show("pulled by patches",
       {"Bone/Material=rigid",
        "Implant/Material=rigid",
        "Implant/Cells=20, 2",
        "Interface/Law=adhesive",
        "Interface/Bonding/Pattern=random",
        "Interface/Bonding/Bonded fraction=0.5",
        push + "-0.01 * t",
        turn + "0",
        "Load steps/Times=0, 1",
        "Load steps/Steps=2"});

  // Friction falls by a third in few steps, and no spring could make a jump.
  show("fretting in large steps",
       {"Chuck/Translation x/Value=0.06 * sin(2 * pi * max(t - 1, 0))",
        turn + "0",
        "Load steps/Times=0, 1, 1.25, 1.75, 2",
        "Load steps/Steps=1, 2, 4, 2"});
}
