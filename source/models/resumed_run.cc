#include <debond/input/scene_file.h>
#include <debond/models/resumed_run.h>
#include <debond/output/result_files.h>
#include <debond/scene/finer_scenes.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

namespace Debond
{
  namespace
  {
    namespace fs = std::filesystem;

    /** Entries that change nothing in the results; what the solver was for the
     *  bone the state itself says. */
    const std::set<std::string> free_entries{
      "Title",
      "Output / Directory",
      "Expert / Output / Console",
      "Expert / Bone / Solver",
      "Expert / Output / Checkpoint every",
      "Expert / Output / Checkpoint minutes",
      "Output / Report"};



    /** Entries that say where a load goes on to. */
    bool
    is_of_extension(const std::string &entry)
    {
      return entry == "Load steps / Times" || entry == "Load steps / Steps" ||
             (boost::starts_with(entry, "Chuck / ") &&
              boost::ends_with(entry, " / Value"));
    }



    /** "Interface / Viscosity is 0, the checkpoint's 1; ..."; empty if there
     *  are no differences between completed parameters but those of an
     *  extension that is one. */
    std::string
    differences(const std::string &parameters,
                const std::string &earlier,
                const bool         is_extension)
    {
      // by the names of entries, and of what the parameters say of files by
      // itself (Scene::completed_parameters)
      std::map<std::string, std::array<std::string, 2>> values;
      const std::vector<std::string> chosen = choices_in(parameters);
      for (const unsigned int which : {0, 1})
        {
          const std::string &text = which == 0 ? parameters : earlier;
          const auto         note = [&](const std::string &name,
                                const std::string &value) {
            values[name][which] = value.empty() ? "empty" : value;
          };
          for (const SceneEntry &entry : read_scene_text(text, "checkpoint"))
            if (free_entries.count(entry.full_name()) == 0 &&
                !is_among(chosen, entry.full_name()) &&
                !(is_extension && is_of_extension(entry.full_name())))
              note(entry.full_name(), entry.value);
          Classic<std::istringstream> lines(text);
          for (std::string line; std::getline(lines, line);)
            if (const auto colon = line.rfind(": ");
                line.rfind("# ", 0) == 0 && colon != line.npos &&
                choices_in(line + "\n").empty())
              note(line.substr(2, colon - 2), line.substr(colon + 2));
        }
      std::string list;
      const auto  shown = [](const std::string &value) {
        return value.empty() ? "not there" : value;
      };
      for (const auto &[name, value] : values)
        if (value[0] != value[1])
          list += (list.empty() ? "" : "; ") + name + " is " + shown(value[0]) +
                  ", the checkpoint's " + shown(value[1]);
      return list;
    }



    /** A run that goes on stays in its directory. */
    void
    refuse_to_move(const std::vector<std::string> &overrides,
                   const ResultDirectory          &results)
    {
      for (const std::string &text : overrides)
        if (const SceneEntry entry = read_override(text);
            entry.full_name() == "Output / Directory" &&
            fs::weakly_canonical(entry.value + "/.") !=
              fs::weakly_canonical(results.path()))
          throw InputError("--resume '" + results.path() + "': --set '" + text +
                           "' names another directory, but a run goes on in "
                           "the directory of its results");
    }



    Scene
    scene_of(const std::string              &parameters,
             const std::vector<std::string> &overrides,
             const ResultDirectory          &results)
    {
      return Scene::from_entries(with_overrides(open_choices(parameters),
                                                overrides),
                                 results.file("parameters.prm"));
    }
  } // namespace



  std::optional<ResumedRun>
  find_interrupted_run(const std::string              &directory,
                       const std::string              &scene_file,
                       const std::vector<std::string> &overrides)
  {
    const auto refuse_if = [&](const bool is_so, const std::string &why) {
      if (is_so)
        throw InputError("--resume '" + directory + "': " + why);
    };
    const auto there_is = [&](const std::string &name) {
      return fs::exists(directory + "/" + name);
    };
    // Why a directory holds no run that could have a checkpoint.
    refuse_if(!fs::is_directory(directory), "there is no such directory");
    refuse_if(there_is("study.csv") || there_is("variant-001"),
              "this is the directory of a study; run its scene again: "
              "variants that are done are kept, the others go on from their "
              "checkpoints or begin anew");
    refuse_if(!there_is("parameters.prm"),
              "this directory holds no results of debond (there is no "
              "parameters.prm in it)");
    const Scene before = Scene::from_file(directory + "/parameters.prm");
    refuse_if(before.model != ModelKind::finite_elements,
              "only Model = finite elements leaves checkpoints; run the scene "
              "again");
    ResumedRun run;
    run.directory = std::make_shared<const ResultDirectory>(directory);
    const ResultDirectory &results = *run.directory;
    refuse_to_move(overrides, results);
    const bool is_finished =
      read_json(results.file("summary.json"))["converged"] == true;
    if (is_finished && scene_file.empty() && overrides.empty())
      {
        const std::string different =
          differences(before.completed_parameters,
                      parameters_in(directory).value_or(""),
                      false);
        refuse_if(!different.empty(),
                  "the run is finished, but its files have changed since: " +
                    different + "; run the scene again");
        return std::nullopt;
      }

    run.checkpoint = CheckpointFiles(results).newest(run.remarks);
    // the coarser run comes first
    if (!run.checkpoint && fs::exists(results.file("coarser/parameters.prm")))
      run.checkpoint = Checkpoint{0, *parameters_in(directory), ""};
    const auto &checkpoint = run.checkpoint;
    refuse_if(!checkpoint,
              "there is no checkpoint to go on from; " +
                boost::join(run.remarks, "; ") +
                (run.remarks.empty() ? "" : "; ") + "run the scene again");
    run.scene =
      with_choices_of(scene_file.empty() ?
                        scene_of(checkpoint->parameters, overrides, results) :
                        Scene::from_file(scene_file, overrides),
                      checkpoint->parameters);
    const bool        goes_further = extends(run.scene, checkpoint->parameters);
    const std::string different    = differences(run.scene.completed_parameters,
                                              checkpoint->parameters,
                                              goes_further);
    refuse_if(!different.empty(),
              "the scene is not that of the checkpoint: " + different);
    if (is_finished && !goes_further)
      return std::nullopt;
    run.scene.output.directory = results.path();
    return run;
  }



  bool
  extends(const Scene &scene, const std::string &earlier)
  {
    const Scene before   = Scene::from_text(earlier, {}, "checkpoint");
    const auto  is_begun = [](const auto &longer, const auto &shorter) {
      return longer.size() > shorter.size() &&
             std::equal(shorter.begin(), shorter.end(), longer.begin());
    };
    if (!is_begun(scene.load_steps.times, before.load_steps.times) ||
        !is_begun(scene.load_steps.steps, before.load_steps.steps))
      return false;
    for (unsigned int k = 0; k < ChuckParameters::n_components; ++k)
      {
        const auto now  = scene.value_over_time(k),
                   then = before.value_over_time(k);
        for (const double time : before.load_steps.sample_times())
          if (std::abs(now(time) - then(time)) > 1e-12 * std::abs(then(time)))
            return false;
      }
    return true;
  }



  std::optional<Checkpoint>
  find_checkpoint(const Scene &scene)
  {
    std::optional<Checkpoint> checkpoint;
    Ranks::in_agreement([&] { // another run may be at work there
      try
        {
          std::vector<std::string> remarks;
          checkpoint = CheckpointFiles(ResultDirectory(scene.output.directory))
                         .newest(remarks);
        }
      catch (const ForeignCheckpoint &)
        {}
    });
    const bool is_of_scene =
      checkpoint &&
      differences(scene.completed_parameters, checkpoint->parameters, false)
        .empty();
    return is_of_scene ? checkpoint : std::nullopt;
  }
} // namespace Debond
