// Simulation::advance() is all or nothing: after whatever it throws, from
// wherever, the simulation is in its last row to the last bit, and goes on as
// if this had not been tried. The reference is a run that has never tried
// anything.
//
// The chuck of a row that is to fail throws the n-th time that it is asked
// where it is to be, for many n: before the first iteration, between two
// iterations, between accepted parts of the row and behind the last one.

#include <debond/models/simulation.h>
#include <debond/output/profile_output.h>
#include <debond/support/serialization.h>

#include <algorithm>
#include <functional>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "checks.h"
#include "driven_scene.h"
#include "pressed_and_turned.h"

using namespace Debond;

const std::string coin = R"(
subsection Bone
  set Material = linear
  set Cells    = 6, 6, 2
end
subsection Implant
  set Material = linear
  set Cells    = 2, 2
end
)" + pressed_then("Rotation z", "3 * max(t - 1, 0)") +
                         R"(
subsection Load steps
  set Times = 0, 1, 2
  set Steps = 1, 6
end)";



/** What happens when the chuck is asked for its angle. */
struct Attempt
{
  unsigned int          calls = 0;
  std::function<void()> at_each_call;
  double                excess = 0; ///< added to the angle
};



std::string
checkpoint_of(Simulation &simulation)
{
  std::string bytes;
  SavingArchive(bytes) & simulation;
  return bytes;
}



/** Everything that is to be seen of a simulation, or that steers it; all of its
 *  rows are in the checkpoint. */
struct State
{
  std::string                 checkpoint;
  std::vector<InterfacePoint> points;
  std::vector<double>         numbers;

  /** A Neo-Hookean body knows the reactions of its supports once it has been
   *  evaluated, not from a checkpoint. */
  explicit State(Simulation &simulation, const bool was_evaluated = true)
    : checkpoint(checkpoint_of(simulation))
    , points(profile_points(simulation.system().interface))
  {
    const CoupledSystem &system = simulation.system();
    const auto           add    = [this](const auto &matrix) {
      numbers.insert(numbers.end(),
                     matrix.data(),
                     matrix.data() + matrix.size());
    };
    for (const Side side : both_sides)
      {
        add(system.configuration.side[side].positions);
        add(system.body[side]->full_displacement());
        if (was_evaluated)
          add(system.support_reaction(side, Eigen::Vector3d::Zero()));
      }
    add(system.chuck_resultant());
    add(system.chuck.machine_position());
    for (const SlavePoint &point : system.interface.get_points())
      for (const Eigen::Vector3d &v : {point.trial.traction,
                                       point.trial.viscous_traction,
                                       point.trial.slip_increment})
        add(v);
    const InterfaceSummary summary = system.interface.summarise();
    numbers.insert(numbers.end(),
                   {summary.phi_mean,
                    summary.energy,
                    summary.steepest_softening,
                    summary.max_traction,
                    system.bulk_energy(),
                    system.time(),
                    double(simulation.control().is_between_phases()),
                    double(simulation.checks().released().may_hide_a_jump)});
  }

  bool
  operator==(const State &other) const
  {
    return checkpoint == other.checkpoint && points == other.points &&
           numbers == other.numbers;
  }
};



/** A simulation whose angle is asked for through an Attempt. */
std::unique_ptr<Simulation>
simulation_of(const std::vector<std::string> &overrides, Attempt &attempt)
{
  Scene        scene = coin_scene(coin, overrides);
  auto        &spin  = scene.chuck.component[ChuckComponent::rotation_z];
  const double R     = scene.implant.characteristic_radius();
  const auto value = scene.chuck.value_over_time(ChuckComponent::rotation_z, R);
  const double begin = scene.load_steps.times[0];
  spin.function      = [value, begin, &attempt](const double time) {
    ++attempt.calls;
    if (attempt.at_each_call)
      attempt.at_each_call();
    return value(time) + (time > begin ? attempt.excess : 0.);
  };
  return std::make_unique<Simulation>(scene);
}



/** Goes on to the next row, and fails before that in every way. Counts attempts
 *  that were not taken back to the last bit, and those that had accepted a part
 *  of the row. */
struct FailingRow
{
  bool         was_evaluated = false; ///< before
  unsigned int tried = 0, with_traces = 0, divided = 0, extended = 0;

  void
  advance(Simulation &simulation, Attempt &attempt)
  {
    const State       before(simulation, was_evaluated);
    const ControlNet &accepted =
      simulation.system().interface.accepted_surface(Side::implant);
    const ControlNet         accepted_before = accepted;
    const std::vector<bool> &contact =
      simulation.system().bone.contact_control_points();
    const std::vector<bool> contact_before = contact;
    const auto              is_thrown      = [&](const unsigned int last_call) {
      attempt.calls        = 0;
      attempt.at_each_call = [&] {
        if (attempt.calls < last_call)
          return;
        divided += accepted != accepted_before;
        extended += contact != contact_before;
        if (tried % 3 == 0)
          throw std::bad_alloc();
        if (tried % 3 == 1)
          throw InputError("no value");
        throw tried;
      };
      try
        {
          simulation.advance();
          return false;
        }
      catch (...)
        {}
      ++tried;
      attempt.at_each_call = {};
      with_traces += !(State(simulation, was_evaluated) == before);
      return true;
    };
    // every call of the first ones, then some of the many
    unsigned int n = 1;
    while (is_thrown(n) && with_traces == 0)
      n += 1 + n / 6;
    attempt.at_each_call = {};
    was_evaluated        = true;
  }
};



/** Lines of output for a scene, of which each row from @p first on fails in
 *  every way before it is found. */
void
check(const std::string              &name,
      const std::vector<std::string> &overrides,
      const unsigned int              first = 0)
{
  std::cout << name << std::endl;
  Attempt    attempt, none;
  const auto failing = simulation_of(overrides, attempt),
             clean   = simulation_of(overrides, none);
  clean->run();
  FailingRow row;
  while (row.with_traces == 0 && failing->rows().size() < clean->rows().size())
    {
      if (failing->rows().size() >= first)
        row.advance(*failing, attempt);
      else
        {
          failing->advance();
          row.was_evaluated = true;
        }
    }
  report("  many attempts", row.tried >= 20);
  if (row.divided > 0)
    std::cout << "  some had accepted a part of the row" << std::endl;
  if (row.extended > 0)
    std::cout << "  some had reached more of the bone" << std::endl;
  report("  each is taken back to the last bit", row.with_traces == 0);
  report("  the same rows and state as without them",
         State(*failing) == State(*clean));
}



/** A load that the interface cannot hold. */
void
check_refused_load()
{
  std::cout << "A moment that is too large" << std::endl;
  const std::vector<std::string> overrides{
    "Chuck/Rotation z/Control=moment",
    "Chuck/Rotation z/Value=45 * min(1, 1.5 * max(t - 1, 0))",
    "Expert/Load steps/Smallest step fraction=1e-2"};
  Attempt    attempt, none;
  const auto failing   = simulation_of(overrides, attempt),
             clean     = simulation_of(overrides, none);
  unsigned int refused = 0, traces = 0;
  while (failing->rows().empty() || !failing->is_finished())
    {
      if (failing->rows().size() > 2)
        {
          const State before(*failing);
          attempt.excess = 30.;
          try
            {
              failing->advance();
            }
          catch (const RunError &)
            {
              ++refused;
            }
          attempt.excess = 0.;
          traces += !(State(*failing) == before);
        }
      failing->advance();
    }
  clean->run();
  report("  is refused", refused == 5);
  report("  leaves no trace", traces == 0);
  report("  the same rows and state as without it",
         State(*failing) == State(*clean));
}



/** Goes on from a checkpoint. */
void
check_resumed()
{
  std::cout << "A run that is resumed" << std::endl;
  const std::vector<std::string> overrides{
    "Bone/Material=neo-hookean", "Chuck/Rotation z/Value=80 * max(t - 1, 0)"};
  Attempt    attempt, none;
  const auto failing = simulation_of(overrides, attempt),
             clean   = simulation_of(overrides, none);
  for (unsigned int i = 0; i < 3; ++i)
    clean->advance();
  const std::string checkpoint = checkpoint_of(*clean);
  LoadingArchive(checkpoint) & *failing;
  clean->run();
  FailingRow row;
  while (row.with_traces == 0 && !failing->is_finished())
    row.advance(*failing, attempt);
  report("  some had accepted a part of the row", row.divided > 0);
  report("  each is taken back to the last bit", row.with_traces == 0);
  report("  the same rows and state as without them",
         State(*failing) == State(*clean));
}



/** What those who look on throw. */
void
check_callbacks()
{
  std::cout << "What looks on throws" << std::endl;
  // the chuck turns back within a row, which is worth a warning, in a row that
  // has two parts
  const std::vector<std::string> overrides{
    "Chuck/Rotation z/Value=20 * max(t - 1, 0) + 0.5 * sin(20 * t)"};
  Attempt    none;
  const auto failing      = simulation_of(overrides, none),
             clean        = simulation_of(overrides, none);
  bool         throws     = true;
  unsigned int of_warning = 0, of_row = 0, traces = 0, incomplete = 0;
  failing->signals.warning.connect([&](const Warning &) {
    if (throws)
      throw std::string("warned");
  });
  failing->signals.row.connect([&](const TorqueRow &row) {
    if (row.step % 2 == 1)
      throw row.step;
  });
  while (failing->rows().empty() || !failing->is_finished())
    {
      const State       before(*failing, !failing->rows().empty());
      const std::size_t n_rows     = failing->rows().size(),
                        n_warnings = failing->warnings().size();
      throws                       = true;
      try
        {
          failing->advance();
        }
      catch (const std::string &)
        {
          ++of_warning;
          traces += !(State(*failing, n_rows > 0) == before) ||
                    failing->warnings().size() != n_warnings;
          throws = false;
          try
            {
              failing->advance();
            }
          catch (const unsigned int)
            {}
        }
      catch (const unsigned int)
        {
          ++of_row;
        }
      incomplete += failing->rows().size() != n_rows + 1;
    }
  clean->run();
  report("  a warning ends a row", of_warning > 0);
  report("  which leaves no trace", traces == 0);
  report("  a row ends a call", of_row > 0);
  report("  and stays", incomplete == 0);
  report("  the same rows and state as without",
         State(*failing) == State(*clean));
}



void
check_all()
{
  const std::string turns   = "Chuck/Rotation z/Value=80 * max(t - 1, 0)";
  const std::string large_x = "Chuck/Translation x/Value=1.5 * max(t - 1, 0)";
  check("Linear bodies", {});
  check("Rows that are divided", {turns});
  check("Neo-Hookean bodies, sideways",
        {"Bone/Material=neo-hookean",
         "Implant/Material=neo-hookean",
         turns,
         large_x});
  check("The bone is the slave, sideways",
        {"Expert/Interface/Slave=bone", turns, large_x});
  check("Adaptive steps", {"Load steps/Adaptive=true"});
  check("Along a path, with a compliant machine",
        {"Load steps/Path following=slip",
         "Chuck/Rotation z/Stiffness=3000",
         "Interface/Characteristic slip distance=0.01"});
  check("Under a moment",
        {"Chuck/Rotation z/Control=moment",
         "Chuck/Rotation z/Value=40 * max(t - 1, 0)"});
  check("Rate and state friction",
        {"Interface/Friction law=rate and state", turns});
  check("Multigrid", {"Expert/Bone/Solver=multigrid", turns, large_x}, 5);
  check("Multigrid, a Neo-Hookean bone",
        {"Expert/Bone/Solver=multigrid",
         "Bone/Material=neo-hookean",
         turns,
         large_x},
        6);
  check_refused_load();
  check_resumed();
  check_callbacks();
}



int
main()
{
  return run_test(check_all);
}
