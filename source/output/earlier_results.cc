#include <debond/output/earlier_results.h>

#include <filesystem>
#include <regex>
#include <vector>

namespace Debond
{
  namespace
  {
    bool
    is_level(const std::filesystem::path &path)
    {
      static const std::regex name("rung-[0-9]+");
      return std::regex_match(path.filename().string(), name) &&
             std::filesystem::is_directory(path) &&
             std::filesystem::exists(path / "parameters.prm");
    }



    bool
    is_result(const std::filesystem::path &path)
    {
      static const std::regex name(
        "(summary|repetition-[0-9]+)\\.json|checkpoint-[12]|"
        "(torque|auto|bonding|profiles|friction_law)\\.csv|"
        "(bulk|interface)(-[0-9]+\\.vtu|\\.pvd)");
      return std::regex_match(path.filename().string(), name) || is_level(path);
    }



    void
    remove_those(const std::string &directory,
                 bool (*is_one)(const std::filesystem::path &))
    {
      const std::filesystem::directory_iterator entries(directory);
      for (const auto &path :
           std::vector<std::filesystem::path>(std::filesystem::begin(entries),
                                              std::filesystem::end(entries)))
        if (is_one(path))
          std::filesystem::remove_all(path);
    }
  } // namespace



  void
  remove_results(const std::string &directory)
  {
    remove_those(directory, is_result);
  }



  void
  remove_levels(const std::string &directory)
  {
    remove_those(directory, is_level);
  }
} // namespace Debond
