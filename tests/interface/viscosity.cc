// Viscosity resists sliding with its speed. Two rigid bodies that are turned
// at a constant rate and slide everywhere carry the torque
//   T = 2 pi int r^2 (mu p + eta r omega) dr
//     = 2/3 pi mu p R^3 + 1/2 pi eta omega R^4,
// whatever the steps; the second part does the work that is summed apart. What
// sticks carries nothing of it, nor does an interface without friction.

#include "driven_scene.h"

const double R = 2.5, p = 585 * 0.0049, mu = 0.4;

std::string
scene_text(const double degrees_per_time)
{
  return R"(
subsection Bone
  set Material = rigid
end
subsection Implant
  set Material = rigid
  set Cells    = 6, 2
end
subsection Interface
  set Friction law = coulomb
end
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = )" +
         std::to_string(degrees_per_time) + R"( * max(t - 1, 0)
  end
end
)";
}



void
check_sliding(const double       eta,
              const double       degrees_per_time,
              const unsigned int n_steps)
{
  std::cout << "eta = " << eta << ", " << degrees_per_time
            << " degrees per unit of time, " << n_steps << " steps"
            << std::endl;
  const auto rows =
    run_scene("viscosity",
              scene_text(degrees_per_time),
              {"Interface/Viscosity=" + std::to_string(eta),
               "Load steps/Steps=1," + std::to_string(n_steps)});
  const double omega    = degrees_per_time * M_PI / 180.;
  const double friction = 2. / 3. * M_PI * mu * p * std::pow(R, 3);
  const double viscous  = 0.5 * M_PI * eta * omega * std::pow(R, 4);
  const auto  &end      = rows.back();
  const auto  &before   = rows[rows.size() / 2];
  // a point is dragged behind its own radius by its elastic gap g: it slides
  // on a circle that is smaller by (g/r)^2 / 2, some 1e-5 on average
  report("  torque, relative deviation",
         std::abs(end.torque_Nmm / (friction + viscous) - 1.),
         1e-5);
  const double angle = (end.angle_deg - before.angle_deg) * M_PI / 180.;
  if (eta > 0)
    report("  viscous work of the second half, relative deviation",
           std::abs((end.viscous_work_Nmm - before.viscous_work_Nmm) /
                      (viscous * angle) -
                    1.),
           3e-5);
  else
    report("  no viscous work", end.viscous_work_Nmm == 0.);
  report("  dissipation of that, relative deviation",
         std::abs((end.dissipation_Nmm - before.dissipation_Nmm) /
                    ((friction + viscous) * angle) -
                  1.),
         1e-5);
  double over_bound = 0.;
  for (const auto &row : rows)
    if (row.energy_defect != 0.)
      grow(over_bound,
           std::abs(row.energy_defect) / (row.energy_defect_bound + 1e-9));
  report("  energy defect relative to its bound", over_bound, 1.);
}



void
check_nothing(const std::string &name, const std::string &override)
{
  double       torque[2], work = 0;
  unsigned int i = 0;
  for (const char *eta : {"0", "100"})
    {
      const auto rows = run_scene("viscosity",
                                  scene_text(0.02),
                                  {std::string("Interface/Viscosity=") + eta,
                                   "Load steps/Steps=1,5",
                                   override});
      // friction may start with the last row
      const auto &row = rows[rows.size() - 2];
      torque[i++]     = row.torque_Nmm;
      work += row.viscous_work_Nmm;
    }
  report(name, torque[0] == torque[1] && work == 0.);
}



void
test()
{
  check_sliding(0., 10, 100);
  check_sliding(2., 10, 100);
  check_sliding(2., 10, 200);
  check_sliding(2., 20, 200);
  // 0.02 degrees stick everywhere: eps_t R theta = 0.51 < mu p = 1.15 MPa
  check_nothing("nothing changes while all sticks",
                "Interface/Friction law=coulomb");
  check_nothing("nothing changes without friction",
                "Interface/Friction starts at=2");
}



int
main()
{
  return run_test(test);
}
