#include <debond/output/earlier_results.h>

#include <filesystem>
#include <regex>
#include <set>
#include <vector>

namespace Debond
{
  namespace
  {
    bool
    is_rung(const std::filesystem::path &path)
    {
      static const std::regex name("rung-[0-9]+");
      return std::regex_match(path.filename().string(), name) &&
             std::filesystem::is_directory(path) &&
             std::filesystem::exists(path / "parameters.prm");
    }



    bool
    is_result(const std::filesystem::path &path)
    {
      static const std::set<std::string> names{"summary.json",
                                               "torque.csv",
                                               "auto.csv",
                                               "bonding.csv",
                                               "profiles.csv",
                                               "friction_law.csv",
                                               "checkpoint-1",
                                               "checkpoint-2",
                                               "bulk.pvd",
                                               "interface.pvd"};
      static const std::regex            patterns(
        "(bulk|interface)-[0-9]+\\.vtu|repetition-[0-9]+\\.json");
      const std::string name = path.filename().string();
      return names.count(name) > 0 || std::regex_match(name, patterns) ||
             is_rung(path);
    }



    void
    remove_those(const std::string &directory,
                 bool (*is_one)(const std::filesystem::path &))
    {
      std::vector<std::filesystem::path> found;
      for (const auto &entry : std::filesystem::directory_iterator(directory))
        if (is_one(entry.path()))
          found.push_back(entry.path());
      for (const auto &path : found)
        std::filesystem::remove_all(path);
    }
  } // namespace



  void
  remove_results(const std::string &directory)
  {
    remove_those(directory, is_result);
  }



  void
  remove_rungs(const std::string &directory)
  {
    remove_those(directory, is_rung);
  }
} // namespace Debond
