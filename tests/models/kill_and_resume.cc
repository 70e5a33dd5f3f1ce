// A run that is killed fifty times at random moments, without any chance to
// react: each time all files under their final names are whole and no more than
// the steps since the last checkpoint are lost, and the files at the end are
// those of a run in one go, byte for byte.

#include <debond/models/debonding_problem.h>
#include <debond/models/resumed_run.h>
#include <debond/output/checkpoint.h>
#include <debond/output/result_files.h>
#include <debond/support/runtime.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "checks.h"
#include "coin_scene.h"
#include "interrupted_run.h"
#include "pressed_and_turned.h"

using namespace Debond;
namespace fs = std::filesystem;

const std::string  directory = "results/killed", whole = "results/whole";
const unsigned int n_kills = 50, steps_between_checkpoints = 7;

Scene
scene_in(const std::string &place)
{
  return coin_scene(R"(
    subsection Bone
      set Cells    = 6, 6, 2
      set Material = linear
    end
    subsection Implant
      set Material = linear
    end
)" + pressed_then("Rotation z", "5 * max(t - 1, 0)") +
                      R"(
    subsection Load steps
      set Steps = 1, 200
    end
    subsection Output
      set Fields every = 50
    end
    subsection Expert
      subsection Output
        set Console = quiet
      end
    end)",
                    {"Output/Directory=" + place,
                     "Expert/Output/Checkpoint every=" +
                       std::to_string(steps_between_checkpoints)});
}



/** Starts a run, or goes on with it if there is a checkpoint, as a process. */
pid_t
start(const std::string &place)
{
  std::cout.flush();
  const pid_t process = fork();
  if (process != 0)
    return process;
  int code = 0;
  try
    {
      const Scene scene = scene_in(place);
      if (const auto checkpoint = find_checkpoint(scene))
        DebondingProblem(scene).run(&*checkpoint);
      else
        DebondingProblem(scene).run();
    }
  catch (const std::exception &error)
    {
      std::cerr << error.what() << std::endl;
      code = 1;
    }
  _exit(code);
}



int
end_of(const pid_t process)
{
  int status = 0;
  waitpid(process, &status, 0);
  return status;
}



bool
ends_with(const std::string &text, const std::string &end)
{
  return text.size() >= end.size() &&
         text.compare(text.size() - end.size(), end.size(), end) == 0;
}



/** Whether the lines of a CSV file are all there as a whole. A system that
 * kills a program in the middle of a write may do so where a page of the file
 * ends. */
bool
has_whole_lines(const std::string &text)
{
  long n_commas = -1, commas = 0;
  for (const char c : text)
    {
      commas += c == ',';
      if (c != '\n')
        continue;
      if (n_commas >= 0 && commas != n_commas)
        return false;
      n_commas = commas;
      commas   = 0;
    }
  constexpr std::size_t page = 4096;
  return ends_with(text, "\n") || (!text.empty() && text.size() % page == 0);
}



/** Whether every file that stands under its final name is whole. */
bool
all_are_whole()
{
  bool whole = true;
  for (const auto &entry : fs::directory_iterator(directory))
    {
      const std::string name = entry.path().filename().string();
      const std::string text = contents_of(entry.path());
      const bool        is_whole =
        ends_with(name, ".partial") || name.rfind("checkpoint-", 0) == 0 ||
        name == "parameters.prm" ||
        (ends_with(name, ".csv") ? has_whole_lines(text) :
         name == "summary.json"  ? ends_with(text, "}\n") :
                                   ends_with(text, "</VTKFile>\n"));
      if (!is_whole)
        std::cout << "  torn: " << name << std::endl;
      whole = whole && is_whole;
    }
  return whole;
}



/** Number of the last step in torque.csv; -1: no row. */
int
last_step()
{
  const std::string text = contents_of(directory + "/torque.csv");
  return int(std::count(text.begin(), text.end(), '\n')) - 2;
}



int
main()
{
  set_up_libraries();
  for (const std::string &place : {directory, whole})
    fs::remove_all(place);
  const auto begin = std::chrono::steady_clock::now();
  report("A run in one go reaches the end", end_of(start(whole)) == 0);
  const double seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - begin)
      .count();

  bool         all_whole = true, nothing_lost = true, same = true;
  unsigned int n_killed = 0, n_in_steps = 0;
  int          saved = 0;
  while (n_killed < n_kills)
    {
      const pid_t process = start(directory);
      std::this_thread::sleep_for(
        std::chrono::duration<double>(random_number(0, 0.7) * seconds));
      kill(process, SIGKILL);
      const int status = end_of(process);
      if (!WIFSIGNALED(status))
        {
          same = same && status == 0 && same_files(whole, directory);
          fs::remove_all(directory);
          saved = 0;
          continue;
        }
      ++n_killed;
      if (!fs::exists(directory))
        continue;
      all_whole = all_whole && all_are_whole();
      std::vector<std::string> damaged;
      const auto               newest =
        CheckpointFiles(ResultDirectory(directory)).newest(damaged);
      const int step = newest ? newest->step : 0, last = last_step();
      n_in_steps += last > step;
      all_whole    = all_whole && damaged.empty();
      nothing_lost = nothing_lost && step >= saved &&
                     last - step <= int(steps_between_checkpoints);
      saved = step;
    }
  same = same && end_of(start(directory)) == 0 && same_files(whole, directory);
  report("Some kills are between checkpoints", n_in_steps > 5);
  report("All files are whole after each kill", all_whole);
  report("No more is lost than the steps since the last checkpoint",
         nothing_lost);
  report("The files at the end are those of a run in one go", same);
}
