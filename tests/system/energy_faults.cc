// What the energy balance of a run sees, and what it does not mind. Numbers are
// closed forms: a disk that slides round by the angle a in a step does the work
// T a, of which the chords of the paths have sin(a) / a.

#include <debond/models/state_checks.h>
#include <debond/system/step_solver.h>

#include "driven_scene.h"

using namespace Debond;

// Pushed in with one step, whose bound is as large as its work; then turned.
EnergyBalance
pushed_in()
{
  EnergyBalance energy;
  EnergyState   state;
  energy.add(state);
  energy.begin_phase();
  state.position[2] = -0.0049;
  state.forces[2]   = -50.;
  state.stored      = 0.5 * 50. * 0.0049;
  energy.add(state);
  energy.begin_phase();
  return energy;
}



/** Turns twice in steps of the angle @p a, with a torque of 40 N mm; a share
 *  @p lost of the dissipation is not counted. Returns what is missing over its
 *  bound. */
double
missing_after_two_turns(const double a, const double lost)
{
  EnergyBalance energy = pushed_in();
  EnergyState   state  = energy.state();
  state.forces[5]      = 40.;
  energy.add(state); // the torque is there without a motion
  energy.begin_phase();
  for (unsigned int i = 0; i < std::lround(4. * M_PI / a); ++i)
    {
      state.position[5] += a;
      state.dissipated += 40. * std::sin(a) * (1. - lost);
      energy.add(state);
    }
  return std::abs(energy.missing_share()) / energy.missing_share_bound();
}



void
check_chords()
{
  std::cout << "chords" << std::endl;
  for (const double degrees : {5., 1., 0.1})
    {
      const double a = degrees * M_PI / 180., loss = 1. - std::sin(a) / a;
      report("  two turns over their bound",
             missing_after_two_turns(a, 0.),
             1.);
      report("  and with a fault of twice the chords",
             missing_after_two_turns(a, 2. * loss + 1e-6) > 1.);
      report("  of either sign",
             missing_after_two_turns(a, -3. * loss - 1e-6) > 1.);
    }
}



// A coin is pushed in by one step and turned by an angle in each of two phases.
// In the second one something is wrong in the energies that the checks are told
// of.
const char *const coin = R"(
subsection Bone
  set Material = rigid
end
subsection Implant
  set Material = rigid
end
subsection Interface
  set Friction law = coulomb
end
subsection Chuck
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
end
subsection Load steps
  set Times = 0, 1, 2, 3
  set Steps = 1, 72, 72
end
)";

/** The names of the checks that are not passed. @p fault: of the work so far,
 *  what is stored less. */
std::string
found(const std::string &degrees, const double fault)
{
  DrivenScene driven(coin,
                     {"Chuck/Rotation z/Value=" + degrees +
                      " * max(t - 1, 0)"});
  std::string names;
  StateChecks checks(driven.scene, [&names](const Warning &warning) {
    if (names.find(warning.check) == std::string::npos)
      names += " [" + warning.check + "]";
  });
  const auto  add = [&] {
    InterfaceSummary summary = driven.system.interface.summarise();
    if (driven.time() > 2.)
      summary.energy -= fault * checks.energy().work();
    checks.add(1, driven.system, summary, 0.);
  };
  add();
  do
    if (driven.time() == std::floor(driven.time()))
      checks.begin_phase();
  while (driven.advance() && (add(), true));
  return names.empty() ? " nothing" : names;
}



void
test()
{
  check_chords();
  // two turns in steps of 5 degrees
  std::cout << "two turns:" << found("360", 0.) << std::endl;
  std::cout << "less of 0.3 % is stored:" << found("360", 0.003) << std::endl;
  std::cout << "more of 0.3 %:" << found("360", -0.003) << std::endl;
  // so little that the bound of the push-in is a third of the work
  std::cout << "one degree:" << found("0.5", 0.) << std::endl;
  std::cout << "less of 3 % is stored:" << found("0.5", 0.03) << std::endl;
  std::cout << "more of 3 %:" << found("0.5", -0.03) << std::endl;
}



int
main()
{
  return run_test(test);
}
