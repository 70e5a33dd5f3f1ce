// A run that is interrupted after some of its rows, and goes on from its
// checkpoint, leaves the same files as one that never was, byte for byte:
// torque curve, fields, profiles, and the summary but for seconds and memory.

#include <debond/models/debonding_problem.h>
#include <debond/models/resumed_run.h>
#include <debond/output/result_files.h>
#include <debond/support/interruption.h>
#include <debond/support/runtime.h>

#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "checks.h"
#include "coin_scene.h"
#include "interrupted_run.h"
#include "pressed_and_turned.h"

using namespace Debond;

/** Takes what goes to the console, and raises a signal after so many lines
 *  about rows: that row is the last one. */
class RaisingBuffer : public std::streambuf
{
public:
  explicit RaisingBuffer(const unsigned int n_rows)
    : rows_left(n_rows)
  {}

private:
  int
  overflow(const int c) override
  {
    if (c != '\n')
      line += static_cast<char>(c);
    else
      {
        const std::size_t first = line.find_first_not_of(' ');
        if (first != 0 && first != std::string::npos &&
            std::isdigit(line[first]) && rows_left-- == 1)
          std::raise(SIGTERM);
        line.clear();
      }
    return c;
  }

  std::string  line;
  unsigned int rows_left;
};



constexpr int stopped_by_signal = 10;

/** Runs a scene into its directory, or goes on with it, in a process of its own
 *  that stops after @p n_rows rows (0: never). Returns its exit code. */
int
run_in_process(const Scene       &scene,
               const bool         goes_on,
               const unsigned int n_rows)
{
  std::cout.flush();
  const pid_t process = fork();
  if (process == 0)
    {
      int           code = 0;
      RaisingBuffer buffer(n_rows);
      std::cout.rdbuf(&buffer);
      catch_interruptions();
      try
        {
          if (!goes_on)
            DebondingProblem(scene).run();
          else if (const auto run =
                     find_interrupted_run(scene.output.directory, "", {}))
            DebondingProblem(run->scene).run(&*run->checkpoint);
          else
            code = 2;
        }
      catch (const Interrupted &)
        {
          code = stopped_by_signal;
        }
      catch (const std::exception &error)
        {
          std::cerr << error.what() << std::endl;
          code = 1;
        }
      _exit(code);
    }
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}



const std::string base = R"(
subsection Bone
  set Cells = 8, 8, 2
end
)" + pressed_then("Rotation z", "3 * max(t - 1, 0)") +
                         R"(
subsection Load steps
  set Steps = 2, 12
end
subsection Output
  set Fields every = 3
end
)";



/** A part of a planned step, of which the second phase of the base has twelve.
 */
bool
has_halved_steps(const std::string &directory)
{
  return read_json(directory + "/summary.json")["smallest_step"] < 0.9 / 12;
}



/** Stops after @p legs rows each, and then goes on to the end. */
void
check(const std::string               &name,
      const std::string               &changes,
      const std::vector<unsigned int> &legs         = {1, 2, 6},
      const bool                       halves_steps = false)
{
  std::cout << name << std::endl;
  const std::string whole = "results/whole", parts = "results/parts";
  for (const std::string &directory : {whole, parts})
    std::filesystem::remove_all(directory);
  std::vector<std::string> overrides;
  for (const SceneEntry &entry : read_scene_text(changes, name))
    overrides.push_back(entry.full_name() + "=" + entry.value);
  const auto scene_in = [&](const std::string &directory) {
    return coin_scene(base,
                      overrides + std::vector{"Output/Directory=" + directory},
                      name);
  };
  const int    end  = run_in_process(scene_in(whole), false, 0);
  bool         all  = true;
  unsigned int n    = 0;
  int          last = 0;
  for (const unsigned int rows : legs)
    all = run_in_process(scene_in(parts), n++ > 0, rows) == stopped_by_signal &&
          all;
  last = run_in_process(scene_in(parts), true, 0);
  report("  reaches the end in one go", end == 0);
  report("  stops " + std::to_string(n) + " times", all);
  report("  reaches the end", last == 0);
  report("  the same files", same_files(whole, parts));
  if (halves_steps)
    report("  steps are halved", has_halved_steps(whole));
}



/** A run that was finished goes on to turn back. */
void
check_extension(const std::string &name, const std::string &changes)
{
  std::cout << name << std::endl;
  const std::string whole = "results/whole", parts = "results/parts";
  for (const std::string &directory : {whole, parts})
    std::filesystem::remove_all(directory);
  const std::vector<std::string> further{
    "Chuck/Rotation z/Value=3 * max(t - 1, 0) - 5 * max(t - 2, 0)",
    "Load steps/Times=0, 1, 2, 2.5",
    "Load steps/Steps=2, 12, 8"};
  const auto scene_in = [&](const std::string       &directory,
                            std::vector<std::string> overrides) {
    overrides.push_back("Output/Directory=" + directory);
    return coin_scene(base + changes, overrides, name);
  };
  const auto extended_by = [&](const std::vector<std::string> &overrides) {
    return find_interrupted_run(parts, "", overrides);
  };
  const auto is_refused = [&](std::vector<std::string> overrides) {
    try
      {
        return !extended_by(overrides).has_value();
      }
    catch (const InputError &)
      {
        return true;
      }
  };
  run_in_process(scene_in(whole, further), false, 0);
  run_in_process(scene_in(parts, {}), false, 0);
  report("  no further times", is_refused({}));
  report("  other steps before",
         is_refused({further[0], further[1], "Load steps/Steps=2, 11, 8"}));
  report("  other values before",
         is_refused({"Chuck/Rotation z/Value=2.9 * max(t - 1, 0)",
                     further[1],
                     further[2]}));
  report(
    "  another stiffness",
    is_refused(
      {further[0], further[1], further[2], "Interface/Normal stiffness=99"}));
  std::ostringstream none;
  auto *const        console = std::cout.rdbuf(none.rdbuf());
  {
    const auto run = extended_by(further);
    DebondingProblem(run->scene).run(&*run->checkpoint);
  }
  std::cout.rdbuf(console);
  report("  the same files", same_files(whole, parts));
}



int
main()
{
  set_up_libraries();
  const std::string linear = bodies_of("linear"), rigid = bodies_of("rigid");

  check("Neo-Hookean bodies, with profiles", R"(
    subsection Expert
      subsection Output
        set Profile angles = 0.25, 0.5, 1.5
      end
    end)");
  check("Linear bodies", linear);
  check("Rigid bodies", rigid);
  check("Coulomb friction with mu = 10", R"(
    subsection Interface
      set Friction law = coulomb
      set Friction coefficient = 10
    end)");
  check("Adaptive steps",
        linear + R"(
    subsection Load steps
      set Adaptive  = true
      set Tolerance = 1e-2
      set Steps     = 1, 100
    end)",
        {2, 3, 6}); // the first stop is at the end of a phase
  check("A compliant machine", R"(
    subsection Chuck
      subsection Rotation z
        set Stiffness = 2000
      end
    end)");
  check("A loaded chuck", linear + R"(
    subsection Chuck
      subsection Press
        set Control = force
        set Value   = 50 * (0.2 + min(t, 1))
      end
      subsection Rotation x
        set Control = moment
      end
    end)");
  std::ofstream("force.csv") << "angle_deg,press_N\n0,20\n1,30\n3,70\n";
  check("A load over the angle, from a file", linear + R"(
    subsection Chuck
      subsection Press
        set Control   = force
        set Value     = min(t, 1) * table
        set File      = force.csv
      end
    end)");
  check("Path following",
        rigid + R"(
    subsection Interface
      set Friction coefficient broken   = 0.2
      set Friction coefficient unbroken = 1
      set Tangential stiffness  = 5000
      set Characteristic slip distance = 0.002
      set Transition factor = 1
    end
    subsection Chuck
      subsection Rotation z
        set Stiffness = 3000
      end
    end
    subsection Load steps
      set Path following = slip
    end)",
        {2, 10, 12});
  check("Viscosity, the bone is the slave, a random pattern", linear + R"(
    subsection Interface
      set Viscosity = 5
      subsection Bonding
        set Pattern         = random
        set Bonded fraction = 0.5
      end
    end
    subsection Expert
      subsection Interface
        set Slave = bone
      end
    end)");
  check("Rate and state friction", linear + R"(
    subsection Interface
      set Friction law = rate and state
    end)");
  check("An interface a hundred times as stiff", R"(
    subsection Interface
      set Normal stiffness = 58500
    end
    subsection Chuck
      subsection Press
        set Value = 0.0005 * min(t, 1)
      end
    end)");
  check("A soft bone with large strains", R"(
    subsection Bone
      set Young modulus = 30
    end
    subsection Chuck
      subsection Press
        set Value = 0.6 * min(t, 1)
      end
    end)");
  check("Slides to other elements", linear + R"(
    subsection Chuck
      subsection Translation x
        set Value = 2 * max(t - 1, 0)
      end
    end)");
  check("Slides to other elements, Neo-Hookean bodies, tilted", R"(
    subsection Chuck
      subsection Translation x
        set Value = 2 * max(t - 1, 0)
      end
      subsection Rotation y
        set Value = 0.2 * max(t - 1.2, 0)
      end
    end)");
  const std::string splines = R"(
    subsection Bone
      set Element = spline
      set Cells   = 12, 12, 2
    end
    subsection Implant
      set Element = spline
    end)";
  check("Splines on the lattice, a loaded chuck", linear + splines + R"(
    subsection Chuck
      subsection Press
        set Control = force
        set Value   = 50 * (0.2 + min(t, 1))
      end
    end)");
  check("Splines on the lattice, Neo-Hookean bodies", splines);
  check("Splines, cells under the implant", linear + splines + R"(
    subsection Expert
      subsection Bone
        set Cells under implant = 8
      end
    end)");
  check("Steps that are halved",
        R"(
    subsection Interface
      set Characteristic slip distance = 0.002
      set Transition factor = 0.3
      set Viscosity         = 0.5
    end)",
        {1, 2, 6},
        true);
  check_extension("Extended", linear);
  check_extension("Extended, adaptive steps", linear + R"(
    subsection Load steps
      set Adaptive  = true
      set Tolerance = 1e-2
    end)");
}
