// The number of threads changes nothing but the time: torque, energies and
// iterations of a scene that sticks, slips, breaks and tilts are the same with
// one, two and three threads and from run to run. The factorisation of a large
// bulk alone may round differently.

#include <limits>

#include "driven_scene.h"

const char *const scene_text = R"(
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation x
    set Value = 0.002 * max(t - 1, 0)
  end
  subsection Rotation z
    set Value = 2 * max(t - 1, 0)
  end
end
subsection Load steps
  set Steps = 1, 12
end
)";

using Rows = std::vector<Debond::TorqueRow>;

Rows
run(const unsigned int n_threads, const std::vector<std::string> &overrides)
{
  Debond::set_number_of_threads(n_threads);
  return run_scene("threads", scene_text, overrides);
}



/** Largest difference relative to the largest value. */
double
difference(const Rows &a, const Rows &b)
{
  double largest = a.size() == b.size() ? 0. : NAN, T = 0., E = 0.;
  for (const auto &row : a)
    {
      grow(T, std::abs(row.torque_Nmm));
      grow(E, std::abs(row.work_Nmm));
    }
  for (unsigned int i = 0; i < std::min(a.size(), b.size()); ++i)
    {
      grow(largest, std::abs(a[i].torque_Nmm - b[i].torque_Nmm) / T);
      grow(largest,
           std::abs(a[i].force_N - b[i].force_N) /
             (1. + std::abs(a[i].force_N)));
      grow(largest, std::abs(a[i].dissipation_Nmm - b[i].dissipation_Nmm) / E);
      grow(largest, std::abs(a[i].energy_bulk_Nmm - b[i].energy_bulk_Nmm) / E);
      if (a[i].newton_iterations != b[i].newton_iterations)
        largest = NAN;
    }
  return largest;
}



void
check(const std::string              &name,
      const double                    limit,
      const std::vector<std::string> &overrides)
{
  std::cout << name << std::endl;
  const Rows one = run(1, overrides);
  for (const unsigned int n : {1, 2, 3})
    report("  " + std::to_string(n) + " threads against one, difference",
           difference(one, run(n, overrides)),
           limit);
}



void
test()
{
  const double to_the_last_digit = std::numeric_limits<double>::min();
  check("Neo-Hookean bodies", to_the_last_digit, {});
  check("bone as slave",
        to_the_last_digit,
        {"Expert/Interface/Slave=bone", "Interface/Friction law=coulomb"});
  check("more than 20000 unknowns, whose factorisation is threaded",
        1e-10,
        {"Bone/Material=linear",
         "Implant/Material=linear",
         "Bone/Cells=44, 44, 3",
         "Implant/Cells=8, 2",
         "Load steps/Steps=1, 3"});
}



int
main()
{
  return run_test(test);
}
