// With an interface that is much stiffer than the bodies points change between
// stick and slip from one Newton iteration to the next, in cycles that never
// end. They are recognised, and steps then converge without being halved: to
// the torque of partial slip on a half space, 2/3 pi q R^3 when everything
// slides (see prm/verification/torsional_partial_slip.prm).

#include "driven_scene.h"

const char *const partial_slip = R"(
subsection Bone
  set Material      = linear
  set Size          = 12.5, 12.5, 6.25
  set Cells         = 20, 20, 6
  set Layer grading = 1.5
end
subsection Implant
  set Material = rigid
  set Cells    = 8, 1
end
subsection Interface
  set Normal stiffness     = 2
  set Friction law         = coulomb
  set Friction coefficient = 0.5
  set Friction starts at   = 1
end
subsection Chuck
  subsection Press
    set Value = 0.1 * min(t, 1)
  end
  subsection Rotation z
    set Value = 0.00125 * max(t - 1, 0)
  end
end
subsection Load steps
  set Times = 0, 1, 2
  set Steps = 1, 5
end
)";

void
check_partial_slip(const double eps_t)
{
  std::cout << "Partial slip, eps_t = " << eps_t << " MPa/mm" << std::endl;
  // steps are not halved here: one that does not converge ends the test
  DrivenScene  scene(partial_slip,
                    {"Interface/Tangential stiffness=" +
                      std::to_string(eps_t)});
  unsigned int n = 0, most = 0;
  while (scene.advance())
    {
      most = std::max(most, scene.iterations);
      ++n;
    }
  report("  all steps converge as planned", n == 6 && most <= 25);
  // the bone yields a little more than rigidly: mesh and pressure, 0.1 %
  report("  torque of full slip, relative deviation",
         std::abs(scene.system.chuck_forces()[5] /
                    (2. / 3. * M_PI * 0.1 * std::pow(2.5, 3)) -
                  1.),
         1e-3);
}



// Beyond that 25 iterations are no longer enough everywhere, and which steps
// are halved hangs on rounding; the run goes on to the same torque.
void
check_stiffest()
{
  double deviation = 0;
  bool   complete  = true;
  for (const double eps_t : {0.9e8, 0.95e8, 1e8, 1.05e8, 1.1e8, 2e8})
    {
      const auto rows = run_scene("newton_cycles_stiffest",
                                  partial_slip,
                                  {"Interface/Tangential stiffness=" +
                                   std::to_string(eps_t)});
      complete        = complete && rows.size() == 7;
      grow(deviation,
           std::abs(rows.back().torque_Nmm /
                      (2. / 3. * M_PI * 0.1 * std::pow(2.5, 3)) -
                    1.));
    }
  report("Partial slip, eps_t around 1e8 MPa/mm: all rows", complete);
  report("  torque of full slip, relative deviation", deviation, 1e-3);
}



void
test()
{
  for (const double eps_t : {1e6, 3e6, 1e7, 3e7})
    check_partial_slip(eps_t);
  check_stiffest();
}



int
main()
{
  return run_test(test);
}
