// What a scene warns of before anything is solved: values that are likely to be
// a slip of the pen, with what was probably meant, and entries that nothing
// reads. The same scene without the slip says nothing.

#include <debond/scene/scene.h>

#include <iostream>
#include <string>
#include <vector>

#include "coin_scene.h"
#include "pressed_and_turned.h"

using namespace Debond;



void
show(const std::vector<std::string> &overrides)
{
  for (const std::string &text : overrides)
    std::cout << (&text == &overrides.front() ? "" : ", ") << text;
  std::cout << ":\n";
  for (const Warning &warning :
       coin_scene(pressed_and_turned, overrides, "scene.prm").warnings())
    std::cout << "  " << warning.text << "\n";
}



int
main()
{
  const std::string push = "Chuck/Press/", twist = "Chuck/Rotation z/Value=",
                    law = "Interface/Friction ";
  show({"Title=nothing wrong"});

  show({"Bone/Young modulus=18"});
  show({"Bone/Young modulus=300"});
  show({"Implant/Young modulus=113"});
  show({"Implant/Young modulus=3.6"});
  show({"Implant/Young modulus=1.13e11"});
  show({"Implant/Young modulus=30"});
  show({"Bone/Size=5, 12.5, 5"});

  // a sleeve on a plate
  for (const std::string entry : {"Title=pushed out",
                                  "Chuck/Press/Value=-0.1 * t",
                                  "Bone/Support radius=2"})
    show({"Bone/Shape=sleeve",
          "Bone/Outer radius=6",
          "Bone/Cells=16, 4, 2",
          "Bone/Element=quadratic",
          "Bone/Support radius=3",
          "Implant/Shape=pin",
          "Implant/Cells=16, 1, 2",
          "Implant/Element=quadratic",
          entry});

  // a press fit, where the spring takes up most of it, and where the bodies do
  for (const std::string entry : {"585", "1e5"})
    show({"Bone/Shape=sleeve",
          "Bone/Outer radius=6",
          "Bone/Cells=16, 4, 2",
          "Bone/Element=quadratic",
          "Implant/Shape=pin",
          "Implant/Cells=16, 1, 2",
          "Implant/Element=quadratic",
          "Interface/Interference=0.02",
          "Interface/Normal stiffness=" + entry});

  // a coin in um
  show({"Implant/Radius=2500",
        "Implant/Height=3000",
        "Bone/Size=12500, 12500, 5000",
        "Interface/Law=adhesive",
        "Chuck/Press/Control=force",
        "Chuck/Press/Value=50 * min(t, 1)"});

  show({law + "coefficient broken=0.7"});
  show({law + "coefficient broken=0.7", law + "law=coulomb"});
  // the default in other digits has not been changed
  show({law + "coefficient broken=0.40", law + "law=coulomb"});
  show({"Closed form/Linear limit angle=0.130"});
  show({"Interface/Characteristic slip distance=22"});
  show({"Interface/Characteristic slip distance=22e-6"});
  show({"Interface/Characteristic slip distance=22e-6", law + "law=coulomb"});
  show({"Expert/Interface/Slave=bone"});
  show({"Expert/Interface/Slave=bone",
        "Interface/Characteristic slip distance=0.3"});
  show({"Interface/Law=adhesive"});
  show({"Interface/Law=adhesive", "Interface/Adhesive/Gap at strength=5"});
  show({"Interface/Law=adhesive",
        "Interface/Adhesive/Strength=300",
        "Interface/Adhesive/Gap at strength=1e-4"});
  show({"Interface/Law=mixed mode",
        "Interface/Mixed mode/Fracture energy I=68",
        "Interface/Mixed mode/Fracture energy II=68"});
  show({"Interface/Bonding/Pattern=random",
        "Interface/Bonding/Bonded fraction=0.5"});
  show({"Interface/Bonding/Pattern=random",
        "Interface/Bonding/Bonded fraction=0.5",
        "Implant/Cells=20, 2"});

  show({"Bone/Poisson ratio=0.47"});
  show({"Bone/Poisson ratio=0.47", "Bone/Element=spline"});
  show({"Bone/Cells=60, 60, 2"});
  show({"Bone/Cells=60, 60, 2", "Expert/Interface/Quadrature points=8"});
  show({"Bone/Cells=60, 60, 2", "Bone/Element=spline"});
  show({"Bone/Cells=60, 60, 2",
        "Bone/Element=spline",
        "Expert/Interface/Quadrature points=7"});

  // the rim over the bone's cells, rows of points over its edge
  const std::string shear = "Chuck/Translation x/Value=",
                    stiff = "Interface/Normal stiffness=1e5";
  show({shear + "2 * max(t - 1, 0)"});
  show({shear + "2 * max(t - 1, 0)", stiff});
  show({shear + "0.1 * max(t - 1, 0)", stiff});
  show({shear + "2 * max(t - 1, 0)", stiff, "Bone/Cells=30, 30, 2"});
  show({shear + "5 * max(t - 1, 0)"});
  show({shear + "3 * max(t - 1, 0)"});
  show({shear + "5 * max(t - 1, 0)", "Implant/Cells=8, 2"});

  show({twist + "5 * (t - 1)"});
  show({twist + "5 * (t - 1)", "Load steps/Times=1, 2, 3"});
  show({twist + "2 + 10 * max(t - 1, 0)"});
  show({twist + "5 * cos(pi * t)"});
  show({twist + "5 * sin(pi * t)"});
  // 10 degrees in radians; a little rotation that is meant; one to and fro
  show({twist + "0.1745 * max(t - 1, 0)"});
  show({twist + "0.1745 * max(t - 1, 0)", law + "law=coulomb"});
  show({twist + "0.1745 * max(t - 1, 0)", "Load steps/Steps=1, 5"});
  show({twist + "0.1745 * sin(20 * pi * t)"});
  show({"Load steps/Times=0, 0.5, 1"});
  show({"Chuck/Rotation x/Value=0 * t"});
  // 0 at the ends of all steps
  show({"Chuck/Rotation x/Value=0.01 * abs(t - rint(t))",
        "Load steps/Times=0, 1, 2, 3",
        "Load steps/Steps=1, 1, 1"});
  show({push + "Control=force", push + "Value=-50 * min(t, 1)"});
  show({push + "Control=force", push + "Value=50 * min(t, 1)"});
  show({push + "Control=force", push + "Value=0.0049 * min(t, 1)"});
  show({push + "Control=force",
        push + "Value=0.0049 * min(t, 1)",
        "Bone/Young modulus=0.5"});
  show({push + "Value=-0.0049 * (2 * t - 1)"});
  show({push + "Value=4.9 * min(t, 1)"});
  show({push + "Value=4.9 * min(t, 1)", push + "Stiffness=10"});
  show({push + "Value=0.5 * min(t, 1)"});

  show({"Load steps/Tolerance=1e-2"});
  show({"Load steps/Tolerance=1e-2", "Load steps/Adaptive=true"});
  show({"Expert/Load steps/Largest slip step=1e-3"});
  show({"Closed form/Shear modulus=50", "Closed form/Pressure=2"});
  show({"Closed form/Shear modulus=50", "Model=crack"});
  show({"Bone/Material=rigid", "Bone/Young modulus=17"});
  show({law + "law=frictionless", law + "coefficient broken=0.3"});
  show({law + "coefficient unbroken=58", law + "coefficient broken=40"});
  show({"Implant/Radius=0.0025"});
  show({"Bone/Young modulus=113000", "Implant/Young modulus=18000"});
  show({"Chuck/Press/Value=4.9e-6 * min(t, 1)"});
  show({law + "law=coulomb", law + "coefficient unbroken=0.7"});
  show({"Interface/Rate and state/Direct effect=0.02"});
}
