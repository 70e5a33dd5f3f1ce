#include <debond/input/scene_file.h>
#include <debond/models/resumed_run.h>
#include <debond/output/result_files.h>
#include <debond/support/input_error.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <sstream>

namespace Debond
{
  namespace
  {
    /** Entries that change nothing in the results. */
    const std::set<std::string> free_entries{"Title",
                                             "Output / Directory",
                                             "Output / Console",
                                             "Output / Checkpoint every"};



    /** The values of completed parameters by the names of the entries; and by
     *  itself what they say of files (Scene::completed_parameters). */
    std::map<std::string, std::string>
    values_of(const std::string &completed_parameters)
    {
      std::map<std::string, std::string> values;
      for (const SceneEntry &entry :
           read_scene_text(completed_parameters, "checkpoint"))
        if (free_entries.count(entry.full_name()) == 0)
          values[entry.full_name()] = entry.value;
      std::istringstream lines(completed_parameters);
      for (std::string line; std::getline(lines, line);)
        if (line.rfind("# ", 0) == 0 && line.rfind(": ") != line.npos)
          {
            const std::size_t colon           = line.rfind(": ");
            values[line.substr(2, colon - 2)] = line.substr(colon + 2);
          }
      return values;
    }



    std::string
    described(const std::map<std::string, std::string> &values,
              const std::string                        &name)
    {
      const auto found = values.find(name);
      return found == values.end() ? "not there" :
             found->second.empty() ? "empty" :
                                     found->second;
    }



    /** "Interface / Viscosity is 0, the checkpoint's 1; ..."; empty if there
     *  are no differences. */
    std::string
    differences(const std::string &parameters, const std::string &earlier)
    {
      const auto now = values_of(parameters), then = values_of(earlier);
      std::set<std::string> names;
      for (const auto &values : {now, then})
        for (const auto &value : values)
          names.insert(value.first);
      std::string list;
      for (const std::string &name : names)
        if (described(now, name) != described(then, name))
          list += (list.empty() ? "" : "; ") + name + " is " +
                  described(now, name) + ", the checkpoint's " +
                  described(then, name);
      return list;
    }



    /** Refuses directories without a run that could have a checkpoint. */
    void
    check_directory(const std::string &directory, const std::string &option)
    {
      namespace fs = std::filesystem;
      if (!fs::is_directory(directory))
        throw InputError(option + ": there is no such directory");
      if (fs::exists(directory + "/study.csv") ||
          fs::exists(directory + "/variant-001"))
        throw InputError(option +
                         ": this is the directory of a study; run its scene "
                         "again: variants that are done are kept, the others "
                         "go on from their checkpoints or begin anew");
      if (!fs::exists(directory + "/parameters.prm"))
        throw InputError(option +
                         ": this directory holds no results of debond (there "
                         "is no parameters.prm in it)");
    }



    /** The results of the run that goes on stay where they are. */
    void
    refuse_other_directory(const std::vector<std::string> &overrides,
                           const std::string              &directory,
                           const std::string              &option)
    {
      namespace fs = std::filesystem;
      for (const std::string &text : overrides)
        {
          const SceneEntry entry = read_override(text);
          if (entry.full_name() == "Output / Directory" &&
              fs::weakly_canonical(ResultDirectory(entry.value).path()) !=
                fs::weakly_canonical(directory))
            throw InputError(option + ": --set '" + text +
                             "' names another directory, but a run goes on in "
                             "the directory of its results");
        }
    }



    std::string
    joined(const std::vector<std::string> &remarks)
    {
      std::string text;
      for (const std::string &remark : remarks)
        text += "; " + remark;
      return text;
    }



    bool
    is_finished(const std::string &directory)
    {
      return read_json(directory + "/summary.json")["converged"] == true;
    }
  } // namespace



  std::optional<ResumedRun>
  find_interrupted_run(const std::string              &directory,
                       const std::string              &scene_file,
                       const std::vector<std::string> &overrides)
  {
    const std::string option = "--resume '" + directory + "'";
    check_directory(directory, option);
    const auto lock = std::make_shared<const ResultDirectory>(directory);
    const ResultDirectory &results = *lock;
    refuse_other_directory(overrides, results.path(), option);
    const std::string stored = results.file("parameters.prm");
    if (Scene::from_file(stored).model != ModelKind::finite_elements)
      throw InputError(option + ": only Model = finite elements leaves "
                                "checkpoints; run the scene again");
    if (is_finished(results.path()))
      return std::nullopt;

    ResumedRun run;
    run.directory         = lock;
    const auto checkpoint = CheckpointFiles(results).newest(run.remarks);
    if (!checkpoint)
      throw InputError(option + ": there is no checkpoint to go on from" +
                       joined(run.remarks) + "; run the scene again");
    run.checkpoint = *checkpoint;
    run.scene      = scene_file.empty() ?
                       Scene::from_text(checkpoint->parameters, overrides, stored) :
                       Scene::from_file(scene_file, overrides);
    const std::string different =
      differences(run.scene.completed_parameters, checkpoint->parameters);
    if (!different.empty())
      throw InputError(
        option + ": the scene is not that of the checkpoint: " + different);
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
