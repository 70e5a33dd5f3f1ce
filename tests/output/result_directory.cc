// A directory with results of another scene is only used when this is wanted,
// and what that scene left is gone then, but nothing that is not ours; none is
// used that another run is at work in; the run before goes into the folder of
// the coarser one; JSON files keep their order, escape text and know no
// infinities.

#include <debond/output/result_files.h>
#include <debond/support/input_error.h>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace
{
  void
  open(const std::string &path, const std::string &parameters, const bool force)
  {
    Debond::OutputParameters output;
    output.directory               = path;
    output.overwrite_other_results = force;
    try
      {
        const Debond::ResultDirectory directory(output, parameters);
        std::ostringstream            text;
        text << Debond::parameters_in(path).value_or("");
        std::cout << directory.path() << ": " << text.str() << '\n';
      }
    catch (const Debond::InputError &error)
      {
        std::cout << error.what() << '\n';
      }
  }

  /** Leaves files as runs do, and some of others. */
  void
  leave_results(const std::string &path)
  {
    for (const std::string directory :
         {"coarser", "rung-1", "rung-old", "rung-2"})
      std::filesystem::create_directories(path + "/" + directory);
    for (const std::string file : {"summary.json",
                                   "torque.csv",
                                   "reactions.csv",
                                   "auto.csv",
                                   "curve.csv",
                                   "errors.csv",
                                   "checkpoint-1",
                                   "bulk.pvd",
                                   "interface-0012.vtu",
                                   "points-0012.vtu",
                                   "repetition-2.json",
                                   "rung-1/parameters.prm",
                                   "coarser/parameters.prm",
                                   "coarser/torque.csv",
                                   "my_picture.png",
                                   "bulk-notes.txt"})
      std::ofstream(path + "/" + file) << "left\n";
  }

  void
  list_files(const std::string &path)
  {
    std::vector<std::string> names;
    for (const auto &entry : std::filesystem::directory_iterator(path))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    for (const std::string &name : names)
      std::cout << "  " << name << '\n';
  }

  /** A folder of this name that holds no results belongs to somebody else. */
  void
  test_folder_of_coarser_run()
  {
    std::filesystem::create_directory("results/a/coarser");
    open("results/a", "one scene", true);
    list_files("results/a");

    open("results/b", "more cells", true);
    leave_results("results/b");
    Debond::keep_as_coarser("results/b", "fewer cells");
    list_files("results/b");
    list_files("results/b/coarser");
    open("results/b/coarser", "fewer cells", false);
  }

  /** While another has the directory: a lock belongs to an open descriptor, so
   *  that one of this process is as good as another process. */
  void
  test_lock()
  {
    const int other = ::open("results/a", O_RDONLY | O_DIRECTORY);
    flock(other, LOCK_EX);
    open("results/a", "a third scene", true);
    list_files("results/a");
    close(other);
    open("results/a", "a third scene", true);
    const Debond::ResultDirectory directory("results/a");
    open("results/a", "a third scene", true);
  }
} // namespace



int
main()
{
  for (const std::string path : {"results/a", "results/b"})
    std::filesystem::remove_all(path);
  open("results/a/", "one scene", true);
  leave_results("results/a");
  open("results/a", "one scene", false);
  open("results/a", "another scene", false);
  list_files("results/a");
  open("results/a", "another scene", true);
  list_files("results/a");
  open("results/a/parameters.prm", "a file is no directory", false);

  test_folder_of_coarser_run();
  test_lock();

  Debond::write_json("results/object.json",
                     {{"text", "quote \", backslash \\, tab \t, no UTF-8 \xB5"},
                      {"third", 1. / 3},
                      {"undefined", std::numeric_limits<double>::quiet_NaN()},
                      {"infinite", std::numeric_limits<double>::infinity()},
                      {"steps", 1000U},
                      {"converged", true},
                      {"warnings", std::vector<std::string>{"first", "second"}},
                      {"none", std::vector<std::string>{}}});
  std::cout << std::ifstream("results/object.json").rdbuf();
  const auto object = Debond::read_json("results/object.json");
  std::cout << "read again: " << object["steps"] << ", "
            << (object["third"] == 1. / 3 ? "all digits" : "digits are lost")
            << '\n';
  std::ofstream("results/object.json") << "[1, 2";
  std::cout << "no object: " << Debond::read_json("results/object.json")
            << ", no file: " << Debond::read_json("results/none.json") << '\n';
}
