// Load steps of any size give nearly the same torque, because the law of
// friction is implicit: ten degrees in 1, 10, 100 or 1000 steps (the program
// divides the one in two, as it turns by more than 5 degrees). An interface
// that is nearly rigid converges with first steps in which Newton's method
// without a first sticking iteration cycles.

#include "driven_scene.h"

const char *const scene_text = R"(
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = max(t - 1, 0)
  end
end
subsection Load steps
  set Times = 0, 1, 11
end
)";

void
check_main_scene()
{
  const auto steps = [](const unsigned int n) {
    return run_scene(std::to_string(n),
                     scene_text,
                     {"Load steps/Steps=1, " + std::to_string(n)});
  };
  const auto fine  = steps(1000);
  double     T_max = 0;
  for (const auto &row : fine)
    grow(T_max, row.torque_Nmm);
  // tests/comparison/numpy with main_scene.prm and these steps: 3e-6, 2e-5,
  // 2.5e-3; the program divides the last one
  for (const auto &[n, limit] :
       {std::pair<unsigned int, double>{100, 3e-6}, {10, 2e-5}, {1, 2.5e-3}})
    {
      const auto coarse  = steps(n);
      double     largest = 0;
      for (unsigned int i = 1; i <= n; ++i)
        grow(largest,
             std::abs(coarse[1 + i].torque_Nmm -
                      fine[1 + i * (1000 / n)].torque_Nmm));
      report(std::to_string(n) +
               " steps against 1000, difference relative to the largest torque",
             largest / T_max,
             1.1 * limit);
    }
}



void
check_stiff_interface()
{
  for (const std::string first : {"0.02", "0.05", "0.1"})
    {
      std::cout << "first step of " << first << " degrees" << std::endl;
      const bool  only = first == "0.1";
      DrivenScene driven(scene_text,
                         {"Interface/Normal stiffness=180000",
                          "Load steps/Times=0, 1, " +
                            (only ? "1.1" : "1" + first.substr(1) + ", 1.1"),
                          only ? "Load steps/Steps=1, 1" :
                                 "Load steps/Steps=1, 1, 1"});
      driven.advance_to(1);
      driven.advance();
      report("  iterations", driven.iterations, 9);
      while (driven.advance())
        ;
      // where a state that has not converged is accepted, contact forces and
      // the reaction of the implant's top differ and the torque is 678 N mm
      report("  contact and reaction differ",
             driven.system.reaction_defect(),
             1e-6);
      // tests/comparison/numpy/stiff_interface.prm
      report("  torque at 0.1 degrees differs from 652.55 N mm",
             std::abs(driven.system.chuck_forces()[5] / 652.55 - 1),
             1e-3);
    }
}



void
test()
{
  check_main_scene();
  check_stiff_interface();
}



int
main()
{
  return run_test(test);
}
