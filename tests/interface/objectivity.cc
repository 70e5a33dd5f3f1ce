// Objectivity: lifted, turned by 0, 90 or 360 degrees while open, pressed and
// twisted, the implant answers with the same torque and force.

#include "driven_scene.h"

using Curve = std::vector<std::pair<double, double>>; // torque, force

// The coarse mesh looks the same after a quarter of a turn.
const char *const scene_text = R"(
subsection Bone
  set Cells = 9, 9, 2
end
subsection Chuck
  subsection Press
    set Value = -(if(t <= 2, 0.01 * min(t, 1), max(0.01 - 0.0149 * (t - 2), -0.0049)))
  end
end
subsection Load steps
  set Times              = 0, 1, 2, 3, 4
  set Steps              = 1, 1, 1, 15
  set Residual tolerance = 1e-12
end
)";

Curve
curve(const double turn_deg)
{
  DrivenScene driven(scene_text,
                     {"Chuck/Rotation z/Value = " + std::to_string(turn_deg) +
                      " * max(0, min(t - 1, 1)) + 2 * max(t - 3, 0)"});
  driven.advance_to(2);
  report("  open after the turn",
         driven.system.interface.summarise().n_closed == 0);
  driven.advance_to(3);
  Curve result;
  do
    result.emplace_back(driven.system.chuck_forces()[5],
                        driven.system.chuck_forces()[2]);
  while (driven.advance());
  report("  turned in all by so many degrees more than 2",
         std::abs(driven.angle_deg() - 2 - turn_deg),
         1e-9);
  return result;
}



void
test()
{
  const Curve reference = curve(0);
  double      T_max     = 0;
  for (const auto &row : reference)
    grow(T_max, std::abs(row.first));
  // the softening must be part of what is compared
  report("torque falls at the end",
         reference.back().first < 0.9 * T_max && reference.back().first > 0);
  for (const double turn : {90., 360.})
    {
      std::cout << "turned by " << turn << " degrees" << std::endl;
      const Curve turned = curve(turn);
      double      torque = 0, force = 0;
      for (std::size_t i = 0; i < reference.size(); ++i)
        {
          grow(torque, std::abs(turned[i].first - reference[i].first) / T_max);
          grow(force, std::abs(turned[i].second / reference[i].second - 1));
        }
      report("  torque differs relative to the largest", torque, 1e-9);
      report("  axial force differs", force, 1e-9);
    }
}



int
main()
{
  return run_test(test);
}
