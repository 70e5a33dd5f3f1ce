// Which checkpoint a run goes on from: the newest whole one; what is damaged is
// mentioned, what does not fit is refused with the reason, what cannot be
// written is an error that names the file, and nothing is left half written.

#include <debond/models/debonding_problem.h>
#include <debond/models/resumed_run.h>
#include <debond/output/checkpoint.h>
#include <debond/output/result_files.h>
#include <debond/support/input_error.h>
#include <debond/support/runtime.h>

#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "checks.h"
#include "coin_scene.h"
#include "png_file.h"
#include "pressed_and_turned.h"

using namespace Debond;
namespace fs = std::filesystem;

const std::string directory = "results/run";
const std::string slots[]   = {directory + "/checkpoint-1",
                               directory + "/checkpoint-2"};



std::string
bytes_of(const std::string &filename)
{
  std::ostringstream text;
  text << std::ifstream(filename, std::ios::binary).rdbuf();
  return text.str();
}

void
put(const std::string &filename, const std::string &bytes)
{
  std::ofstream(filename, std::ios::binary) << bytes;
}



/** Prints what @p action throws, or that it does not. */
template <typename Error, typename Action>
void
print_error(const std::string &what, const Action &action)
{
  std::cout << what << std::endl;
  try
    {
      action();
      std::cout << "  no error" << std::endl;
    }
  catch (const Error &error)
    {
      std::cout << "  " << error.what() << std::endl;
    }
}



/** Prints which step is found, and what is said about the rest. */
void
print_newest(const std::string &what)
{
  print_error<InputError>(what, [] {
    std::vector<std::string> remarks;
    const auto               newest =
      CheckpointFiles(ResultDirectory(directory)).newest(remarks);
    for (const std::string &remark : remarks)
      std::cout << "  " << remark << std::endl;
    if (newest)
      std::cout << "  step " << newest->step << ", state '" << newest->state
                << "'" << std::endl;
    else
      std::cout << "  none" << std::endl;
  });
}



void
write_two()
{
  CheckpointFiles files{ResultDirectory(directory)};
  files.remove();
  files.write({10, "parameters", "the first"});
  files.write({20, "parameters", "the second"});
}



void
test_slots()
{
  fs::remove_all(directory);
  fs::create_directories(directory);
  print_newest("No checkpoint");
  write_two();
  print_newest("Two checkpoints");
  const std::string older = bytes_of(slots[0]), newer = bytes_of(slots[1]);

  bool every_byte_counts = true, every_length_counts = true;
  for (std::size_t i = 0; i < newer.size(); ++i)
    {
      std::string flipped = newer;
      flipped[i] ^= 4;
      put(slots[1], flipped);
      std::vector<std::string> remarks;
      const auto               newest =
        CheckpointFiles(ResultDirectory(directory)).newest(remarks);
      every_byte_counts = every_byte_counts && newest && newest->step == 10 &&
                          remarks.size() == 1;
      put(slots[1], newer.substr(0, i));
      remarks.clear();
      const auto before =
        CheckpointFiles(ResultDirectory(directory)).newest(remarks);
      every_length_counts = every_length_counts && before &&
                            before->step == 10 && remarks.size() == 1;
    }
  report("A flipped bit in any byte is seen", every_byte_counts);
  report("A file torn anywhere is seen", every_length_counts);

  put(slots[1], newer.substr(0, newer.size() / 2));
  print_newest("The newer one is torn");
  put(slots[0], "");
  print_newest("Both are damaged");

  // as a file that is not ours to read
  fs::remove(slots[1]);
  fs::create_symlink("checkpoint-2", slots[1]);
  print_newest("One that cannot be read");

  fs::remove(slots[1]);
  write_two();
  put(slots[1], "torn");
  CheckpointFiles          files{ResultDirectory(directory)};
  std::vector<std::string> remarks;
  files.newest(remarks);
  files.write({11, "parameters", "the next"});
  print_newest("The next one takes the place of the damaged one");
}



/** A small scene; how it differs in @p overrides. */
Scene
small_scene(const std::vector<std::string> &overrides = {})
{
  return coin_scene(R"(
    subsection Bone
      set Material = rigid
    end
    subsection Implant
      set Material = rigid
    end
    subsection Interface
      subsection Bonding
        set Pattern = image
        set File    = results/pattern.png
      end
    end
)" + pressed_then("Rotation z", "max(t - 1, 0)") +
                      R"(
    subsection Load steps
      set Steps = 1, 4
    end
    subsection Output
      set Directory    = results/run
      set Fields every = 1
    end
    subsection Expert
      subsection Output
        set Console          = quiet
        set Checkpoint every = 2
      end
    end)",
                    overrides);
}



/** Finds the run of this scene file in the directory and says what comes of it.
 */
void
print_found(const std::string              &what,
            const std::string              &scene_file,
            const std::vector<std::string> &overrides = {})
{
  print_error<InputError>(what, [&] {
    const auto run = find_interrupted_run(directory, scene_file, overrides);
    if (!run)
      std::cout << "  it is finished" << std::endl;
    else
      std::cout << "  goes on from step " << run->checkpoint->step << std::endl;
  });
}



/** A run that leaves its checkpoints because its last fields cannot be
 *  written. */
void
leave_unfinished_run()
{
  fs::remove_all(directory);
  put("results/pattern.png", png_file(2, {0, 255, 255, 255}));
  fs::create_directories(directory);
  fs::create_symlink("/dev/full", directory + "/bulk-0005.vtu.partial");
  print_error<WriteError>("Fields on a full disk",
                          [] { DebondingProblem(small_scene()).run(); });
}



void
test_scenes()
{
  leave_unfinished_run();
  const std::string own = directory + "/parameters.prm";
  print_found("The scene that is stored", "");
  print_found("The same scene", own);
  print_found("Another console and more checkpoints",
              own,
              {"Expert/Output/Console=steps",
               "Expert/Output/Checkpoint every=1"});
  print_found("Another title", own, {"Title=What it shows"});
  print_error<InputError>("A run that begins anew",
                          [] { DebondingProblem(small_scene()).run(); });
  print_found("The checkpoint is still there", "");
  print_found("Another scene",
              own,
              {"Interface/Viscosity=0.5", "Load steps/Steps=1, 5"});
  put("results/pattern.png", png_file(2, {0, 255, 255, 100}));
  print_found("Another image in the same file", "");
  put("results/pattern.png", png_file(2, {0, 255, 255, 255}));

  const std::string newest = bytes_of(slots[0]);
  {
    // the state of another build, in a checkpoint that is whole
    CheckpointFiles          files{ResultDirectory(directory)};
    std::vector<std::string> remarks;
    Checkpoint               checkpoint = *files.newest(remarks);
    checkpoint.step += 1;
    checkpoint.state.resize(checkpoint.state.size() / 2);
    files.write(checkpoint);
    print_error<InputError>("The state of another build", [&] {
      const auto run = find_interrupted_run(directory, "", {});
      DebondingProblem(run->scene).run(&*run->checkpoint);
    });
  }
  for (const std::string &slot : slots)
    put(slot, "damaged");
  print_found("Both checkpoints are damaged", "");
  for (const std::string &slot : slots)
    fs::remove(slot);
  print_found("There is none", "");

  DebondingProblem(small_scene()).run();
  print_found("A finished run", "");
  report("it leaves its last state alone",
         fs::exists(slots[0]) != fs::exists(slots[1]));
}



void
test_other_directories()
{
  for (const std::string other : {"results/nothing", "results/empty"})
    {
      if (other == "results/empty")
        fs::create_directories(other);
      print_error<InputError>("Not a run: " + other,
                              [&] { find_interrupted_run(other, "", {}); });
    }
  fs::create_directories("results/study/variant-001");
  print_error<InputError>("A study", [] {
    find_interrupted_run("results/study", "", {});
  });
  fs::create_directories("results/foundation");
  put("results/foundation/parameters.prm",
      small_scene({"Model=foundation",
                   "Interface/Bonding/Pattern=homogeneous",
                   "Interface/Bonding/File=none"})
        .completed_parameters);
  print_error<InputError>("A closed form", [] {
    find_interrupted_run("results/foundation", "", {});
  });
}



/** Limits the size of files while it lives: the disk is full. */
class FullDisk
{
public:
  explicit FullDisk(const rlim_t size)
  {
    getrlimit(RLIMIT_FSIZE, &before);
    rlimit limit   = before;
    limit.rlim_cur = size;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk()
  {
    setrlimit(RLIMIT_FSIZE, &before);
  }

private:
  rlimit before;
};



void
test_errors_of_writing()
{
  write_two();
  const std::string newer = bytes_of(slots[1]);
  print_error<WriteError>("A checkpoint on a full disk", [] {
    CheckpointFiles          files{ResultDirectory(directory)};
    std::vector<std::string> remarks;
    files.newest(remarks);
    const FullDisk full(1000);
    files.write({30, "parameters", std::string(100000, 'x')});
  });
  report("what was there before is still whole", bytes_of(slots[1]) == newer);
  report("and nothing else is left", !fs::exists(slots[0] + ".partial"));

  fs::remove_all(directory);
  print_error<WriteError>("A torque curve on a full disk", [] {
    const FullDisk full(9000);
    DebondingProblem(small_scene({"Output/Fields every=none",
                                  "Expert/Output/Checkpoint every=none",
                                  "Load steps/Steps=1, 60"}))
      .run();
  });
  const std::string curve = bytes_of(directory + "/torque.csv");
  report("rows that were written stay, and no part of one",
         curve.size() > 8000 && curve.size() <= 9000 && curve.back() == '\n');

  for (const std::string file : {"torque.csv", "bulk-0001.vtu", "checkpoint-1"})
    {
      // a name that is taken by a directory cannot be written to
      fs::remove_all(directory);
      fs::create_directories(directory + "/" + file + ".partial");
      print_error<WriteError>("No way to write " + file,
                              [] { DebondingProblem(small_scene()).run(); });
    }
  fs::remove_all(directory);
  put("results/file", "");
  print_error<InputError>("A directory below a file", [] {
    DebondingProblem(small_scene({"Output/Directory=results/file/run"})).run();
  });
}



int
main()
{
  set_up_libraries();
  fs::create_directories("results");
  test_slots();
  test_scenes();
  test_other_directories();
  test_errors_of_writing();
}
