#include <debond/output/result_files.h>
#include <debond/scene/finer_scenes.h>
#include <debond/support/input_error.h>
#include <debond/support/laboratory.h>
#include <debond/support/number_text.h>
#include <debond/support/provenance.h>
#include <debond/support/ranks.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <regex>
#include <vector>

namespace Debond
{
  namespace
  {
    /** Removes what debond has written into a directory, but for
     * parameters.prm; images that others made of the results stay, and what
     * only has the name of a directory rung-NUMBER of Model = auto. Throws
     *  std::filesystem::filesystem_error if that is impossible. */
    void
    remove_results(const std::string &directory)
    {
      namespace fs = std::filesystem;
      if (!Ranks::is_first())
        return;
      static const std::regex rung("coarser|rung-[0-9]+"),
        file(
          "(summary|repetition-[0-9]+)\\.json|checkpoint-[12]|"
          "report\\.html|torque\\.(svg|png)|"
          "(torque|reactions|curve|curve_at|errors|reference|auto|bonding|profiles|"
          "friction_law|maps|correlations|profile|fit(-[0-9]+)?)\\.csv|"
          "calibration\\.json|fitted(-[0-9]+)?\\.prm|evaluations\\.jsonl|"
          "(bulk|interface|points)(-[0-9]+(\\.[0-9]+)?\\.p?vtu|\\.pvd)");
      const fs::directory_iterator entries(directory);
      for (const fs::path &path :
           std::vector<fs::path>(fs::begin(entries), fs::end(entries)))
        {
          const std::string name = path.filename().string();
          const bool        is_rung =
            std::regex_match(name, rung) && fs::exists(path / "parameters.prm");
          if (is_rung || std::regex_match(name, file))
            fs::remove_all(path);
        }
    }



    const std::string origin_begins = "# Written by ";

    /** The first line of parameters.prm. */
    std::string
    origin_line()
    {
      std::string line;
      for (const auto &[name, text] : provenance())
        line += (line.empty() ? origin_begins : ", " + name + " ") + text;
      std::replace(line.begin(), line.end(), '\n', ' ');
      return line + "\n";
    }
  } // namespace



  void
  keep_as_coarser(const std::string &directory,
                  const std::string &completed_parameters)
  {
    namespace fs = std::filesystem;
    if (!Ranks::is_first())
      return;
    const fs::path coarser = fs::path(directory) / "coarser",
                   kept    = fs::path(directory) / "coarser.partial";
    fs::remove_all(kept);
    fs::create_directory(kept);
    for (const char *const name :
         {"summary.json", "torque.csv", "reactions.csv", "curve.csv"})
      if (fs::exists(fs::path(directory) / name))
        fs::rename(fs::path(directory) / name, kept / name);
    remove_results(directory);
    fs::rename(kept, coarser);
    ResultDirectory(coarser).write_parameters(completed_parameters);
  }



  std::optional<std::string>
  parameters_in(const std::string &directory)
  {
    auto text = read_whole_file(directory + "/parameters.prm");
    if (text && text->rfind(origin_begins, 0) == 0)
      text->erase(0, text->find('\n') + 1);
    return text;
  }



  ResultDirectory::ResultDirectory(const std::string &path)
    : directory(path)
  {
    while (directory.size() > 1 && directory.back() == '/')
      directory.pop_back();
    lock = lock_directory(directory);
  }



  ResultDirectory::ResultDirectory(const OutputParameters &output,
                                   const std::string      &completed_parameters)
    : ResultDirectory(output.directory)
  {
    const auto refuse = [&output](const std::string &why) {
      throw EntryError("Output / Directory", why, output.directory);
    };
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error)
      refuse("this directory cannot be created: " + error.message());
    if (!lock) // there was no directory yet
      lock = lock_directory(directory);

    const auto existing = parameters_in(directory);
    const bool is_of_other_scene =
      existing && !is_same_scene(completed_parameters, *existing);
    if (is_of_other_scene && !output.overwrite_other_results)
      refuse("this directory holds results of another scene (compare its "
             "parameters.prm): choose another one, or overwrite them with "
             "--force");

    try
      {
        if (is_of_other_scene) // nobody must take them for this scene's
          remove_results(directory);
        write_parameters(completed_parameters);
      }
    catch (const std::exception &reason)
      {
        refuse(reason.what());
      }
  }



  void
  ResultDirectory::write_parameters(const std::string &completed) const
  {
    write_file(file("parameters.prm"), origin_line() + completed);
  }



  std::string
  finest_curve(const std::string &directory)
  {
    for (const std::string name : {"/curve.csv", "/reactions.csv"})
      if (std::filesystem::exists(directory + name))
        return directory + name;
    return directory + "/torque.csv";
  }



  bool
  write_page(const std::string &directory)
  {
    if (!Ranks::is_first())
      return false;
    const int code = Laboratory::run("page", {directory});
    if (code == 127)
      std::cout << "There is no page of the results, report.html: "
                << Laboratory::what_it_needs << std::endl;
    if (code == 2)
      throw RunError("the page of the results in " + directory +
                     " could not be written");
    return code == 0;
  }



  void
  write_json(const std::string &filename, const nlohmann::ordered_json &json)
  {
    // names of files need not be UTF-8
    constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
    write_file(filename, json.dump(2, ' ', false, replace) + "\n");
  }



  nlohmann::ordered_json
  read_json(const std::string &filename)
  {
    Classic<std::ifstream>       file(filename);
    const nlohmann::ordered_json json =
      nlohmann::ordered_json::parse(file, nullptr, false);
    return json.is_object() ? json : nlohmann::ordered_json::object();
  }



  double
  number_in(const nlohmann::ordered_json &summary, const std::string &name)
  {
    const auto found = summary.find(name);
    return found != summary.end() && found->is_number() ?
             found->get<double>() :
             std::numeric_limits<double>::quiet_NaN();
  }
} // namespace Debond
