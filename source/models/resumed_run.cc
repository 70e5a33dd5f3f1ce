#include <debond/input/scene_file.h>
#include <debond/models/resumed_run.h>
#include <debond/output/result_files.h>
#include <debond/support/input_error.h>

#include <boost/algorithm/string/join.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

namespace Debond
{
  namespace
  {
    namespace fs = std::filesystem;

    /** Entries that change nothing in the results. */
    const std::set<std::string> free_entries{"Title",
                                             "Output / Directory",
                                             "Output / Console",
                                             "Output / Checkpoint every"};



    /** "Interface / Viscosity is 0, the checkpoint's 1; ..."; empty if there
     *  are no differences between completed parameters. */
    std::string
    differences(const std::string &parameters, const std::string &earlier)
    {
      // by the names of entries, and of what the parameters say of files by
      // itself (Scene::completed_parameters)
      std::map<std::string, std::array<std::string, 2>> values;
      for (const unsigned int which : {0, 1})
        {
          const std::string &text = which == 0 ? parameters : earlier;
          const auto         note = [&](const std::string &name,
                                const std::string &value) {
            auto &both = values
                           .try_emplace(name,
                                        std::array<std::string, 2>{
                                          {"not there", "not there"}})
                           .first->second;
            both[which] = value.empty() ? "empty" : value;
          };
          for (const SceneEntry &entry : read_scene_text(text, "checkpoint"))
            if (free_entries.count(entry.full_name()) == 0)
              note(entry.full_name(), entry.value);
          std::istringstream lines(text);
          for (std::string line; std::getline(lines, line);)
            if (const auto colon = line.rfind(": ");
                line.rfind("# ", 0) == 0 && colon != line.npos)
              note(line.substr(2, colon - 2), line.substr(colon + 2));
        }
      std::string list;
      for (const auto &[name, value] : values)
        if (value[0] != value[1])
          list += (list.empty() ? "" : "; ") + name + " is " + value[0] +
                  ", the checkpoint's " + value[1];
      return list;
    }



    /** Why a directory holds no run that could have a checkpoint; empty if it
     *  does. */
    std::string
    reason_against(const std::string &directory)
    {
      if (!fs::is_directory(directory))
        return "there is no such directory";
      if (fs::exists(directory + "/study.csv") ||
          fs::exists(directory + "/variant-001"))
        return "this is the directory of a study; run its scene again: "
               "variants that are done are kept, the others go on from their "
               "checkpoints or begin anew";
      if (!fs::exists(directory + "/parameters.prm"))
        return "this directory holds no results of debond (there is no "
               "parameters.prm in it)";
      if (Scene::from_file(directory + "/parameters.prm").model !=
          ModelKind::finite_elements)
        return "only Model = finite elements leaves checkpoints; run the scene "
               "again";
      return "";
    }



    /** The same of overrides: the results of the run that goes on stay where
     *  they are. */
    std::string
    reason_against(const std::vector<std::string> &overrides,
                   const std::string              &directory)
    {
      for (const std::string &text : overrides)
        {
          const SceneEntry entry = read_override(text);
          if (entry.full_name() == "Output / Directory" &&
              fs::weakly_canonical(ResultDirectory(entry.value).path()) !=
                fs::weakly_canonical(directory))
            return "--set '" + text +
                   "' names another directory, but a run goes on in the "
                   "directory of its results";
        }
      return "";
    }
  } // namespace



  std::optional<ResumedRun>
  find_interrupted_run(const std::string              &directory,
                       const std::string              &scene_file,
                       const std::vector<std::string> &overrides)
  {
    const auto refuse_for = [&](const std::string &why) {
      if (!why.empty())
        throw InputError("--resume '" + directory + "': " + why);
    };
    refuse_for(reason_against(directory));
    ResumedRun run;
    run.directory = std::make_shared<const ResultDirectory>(directory);
    const ResultDirectory &results = *run.directory;
    refuse_for(reason_against(overrides, results.path()));
    if (read_json(results.file("summary.json"))["converged"] == true)
      return std::nullopt;

    const auto checkpoint = CheckpointFiles(results).newest(run.remarks);
    if (!checkpoint)
      {
        run.remarks.insert(run.remarks.begin(),
                           "there is no checkpoint to go on from");
        run.remarks.push_back("run the scene again");
        refuse_for(boost::join(run.remarks, "; "));
      }
    run.checkpoint = *checkpoint;
    run.scene      = scene_file.empty() ?
                       Scene::from_text(checkpoint->parameters,
                                   overrides,
                                   results.file("parameters.prm")) :
                       Scene::from_file(scene_file, overrides);
    const std::string different =
      differences(run.scene.completed_parameters, checkpoint->parameters);
    if (!different.empty())
      refuse_for("the scene is not that of the checkpoint: " + different);
    run.scene.output.directory = results.path();
    return run;
  }



  std::optional<Checkpoint>
  find_checkpoint(const Scene &scene)
  {
    std::vector<std::string> remarks;
    try
      {
        auto checkpoint =
          CheckpointFiles(ResultDirectory(scene.output.directory))
            .newest(remarks);
        if (checkpoint &&
            differences(scene.completed_parameters, checkpoint->parameters)
              .empty())
          return checkpoint;
      }
    catch (const OtherProgram &)
      {}
    return std::nullopt;
  }
} // namespace Debond
