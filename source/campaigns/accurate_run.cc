#include <debond/campaigns/accurate_run.h>
#include <debond/models/debonding_problem.h>
#include <debond/models/resumed_run.h>
#include <debond/output/error_estimate.h>
#include <debond/output/result_files.h>
#include <debond/scene/finer_scenes.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>
#include <debond/system/memory_estimate.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

// Runs of one scene with more and more cells, until its error is small enough.
namespace Debond
{
  namespace
  {
    nlohmann::ordered_json
    summary_in(const std::string &directory)
    {
      return read_json(directory + "/summary.json");
    }



    bool
    is_finished(const Scene &scene)
    {
      const std::string &directory = scene.output.directory;
      return parameters_in(directory) == scene.completed_parameters &&
             summary_in(directory)["converged"] == true;
    }



    void
    say(const Scene &scene, const std::string &line)
    {
      if (!scene.output.quiet)
        std::cout << line << std::endl;
    }



    /** The coarser run, whose failure makes the error unknown, and no more.
     *  With @p goes_on it may be finished, or have a checkpoint. */
    void
    run_coarser(const Scene &scene, const Scene &coarser, const bool goes_on)
    {
      if (goes_on && is_finished(coarser))
        return;
      say(scene,
          "For the error first with " + cells_in_words(coarser) + " cells");
      try
        {
          const auto checkpoint =
            goes_on ? find_checkpoint(coarser) : std::nullopt;
          DebondingProblem(coarser).run(checkpoint ? &*checkpoint : nullptr);
        }
      catch (const RunError &)
        {}                          // its summary says why
      catch (const InputError &why) // of cells that are too thin, or a file
        {
          if (Ranks::is_first())
            {
              std::filesystem::create_directories(coarser.output.directory);
              write_json(coarser.output.directory + "/summary.json",
                         {{"converged", false}, {"reason", why.what()}});
            }
        }
      catch (const Interrupted &interrupted)
        {
          throw Interrupted(interrupted.signal,
                            "interrupted in the coarser run, which tells the "
                            "error; debond --resume '" +
                              scene.output.directory + "' goes on from there");
        }
      Ranks::meet();
    }



    /** The run itself. Its failure is the result, if it @p may_fail. */
    std::string
    run_finer(const Scene              &scene,
              std::shared_ptr<BodyPair> bodies,
              const Checkpoint         *checkpoint,
              const bool                may_fail)
    {
      const auto result = [may_fail](const std::runtime_error &why) {
        return may_fail ? why.what() : throw;
      };
      try
        {
          DebondingProblem(scene, std::move(bodies)).run(checkpoint);
        }
      catch (const WriteError &)
        {
          throw;
        }
      catch (const RunError &why)
        {
          return result(why);
        }
      catch (const InputError &why)
        {
          return result(why);
        }
      return "";
    }



    /** Empty: a scene with so many unknowns and seconds may be run. */
    std::string
    why_not_finer(const Scene &finer, const double n, const double seconds)
    {
      if (n > finer.most_unknowns)
        return "are beyond Expert / Largest number of unknowns";
      if (seconds > 60. * finer.most_minutes)
        return "are beyond Expert / Largest minutes";
      try
        {
          require_memory(finer, finer.output.fields_every > 0, false);
        }
      catch (const NotEnoughMemory &)
        {
          return "need more memory than there is";
        }
      return "";
    }



    /** The scene with more cells, if these help and may be; @p text says what
     * is tried, or why it is not, or that it has failed before. @p summary: of
     * the run with the scene; @p error_before: of that before it. */
    std::optional<Scene>
    next_scene(const Scene                  &scene,
               const nlohmann::ordered_json &summary,
               const double                  error_before,
               std::string                  &text)
    {
      if (!text.empty())
        return {};
      const auto percent = [&summary](const std::string &name) {
        return to_text(100. * number_in(summary, name), 2) + " %";
      };
      text = "the estimated error, " + percent("error_estimate") +
             ", is above Accuracy, " + to_text(100. * scene.accuracy, 2) + " %";
      const auto finer = finer_scene(scene);
      if (number_in(summary, "error_of_steps") +
            number_in(summary, "error_of_bodies") >=
          scene.accuracy)
        {
          text += ": steps make " + percent("error_of_steps") +
                  ", and linear bodies " + percent("error_of_bodies");
          return {};
        }
      if (!finer || (!is_among(scene.chosen, "Bone / Cells") &&
                     number_in(summary, "error_estimate") > 0.9 * error_before))
        {
          text += scene.bone.shape == BodyShape::file ||
                      scene.implant.shape == BodyShape::file ?
                    ": the cells are those of files, make smaller ones" :
                    ": the scene sets its cells itself";
          return {};
        }
      // condensation takes the square of the unknowns, most others less
      const double n = n_unknowns_of(*finer), before = n_unknowns_of(scene),
                   needed = number_in(summary, "wall_seconds") *
                            (n > 0. ? std::pow(n / before, 1.5) : 3.);
      const std::string more = cells_in_words(*finer) + " cells, " +
                               to_text(n, 6) + " unknowns, some " +
                               to_text(needed, 2) + " s",
                        why_not = why_not_finer(*finer, n, needed);
      text += why_not.empty() ? ": once more with " + more :
                                "; " + more + ", " + why_not;
      return why_not.empty() ? finer : std::nullopt;
    }



    /** The run with a scene, if it is what would be the coarser one of that
     * with more cells. */
    bool
    is_kept_as_coarser(const ResultDirectory &directory,
                       const Scene           &scene,
                       const Scene           &finer)
    {
      const auto coarser = coarser_scene(finer);
      if (scene.load_steps.rows_are_planned() ||
          cells_in_words(*coarser) != cells_in_words(scene))
        return false;
      keep_as_coarser(directory.path(), coarser->completed_parameters);
      return true;
    }



    void
    add_warning(const ResultDirectory &directory,
                nlohmann::ordered_json summary,
                const std::string     &text)
    {
      std::cout << "warning: " << text << std::endl;
      summary["warnings"].push_back(text);
      write_json(directory.file("summary.json"), summary);
    }
  } // namespace



  void
  run_to_accuracy(Scene                     scene,
                  std::shared_ptr<BodyPair> bodies,
                  const Checkpoint         *checkpoint)
  {
    if (scene.accuracy == 0.)
      return DebondingProblem(scene, std::move(bodies)).run(checkpoint);
    const bool goes_on = checkpoint != nullptr;
    if (goes_on && checkpoint->state.empty())
      checkpoint = nullptr;
    const ResultDirectory directory = open_directory(scene, goes_on);
    std::optional<Scene>  before; // which the scene has more cells than
    std::string           text;   // why more cells fail, or what is tried next
    double error_before = std::numeric_limits<double>::infinity();
    for (bool has_coarser = false;; checkpoint = nullptr)
      {
        const auto coarser = coarser_scene(scene);
        if (coarser && !has_coarser)
          run_coarser(scene, *coarser, goes_on);
        if (ErrorEstimate::of_linear_bodies(
              summary_in(directory.file("coarser"))) > 0.3 * scene.accuracy)
          if (const auto richer = with_large_strains(scene))
            {
              say(scene, "Strains are too large for linear bodies");
              scene       = *richer;
              bodies      = nullptr;
              has_coarser = false;
              directory.write_parameters(scene.completed_parameters);
              continue;
            }
        const std::string why =
          run_finer(scene, std::move(bodies), checkpoint, bool(before));
        if (!why.empty())
          {
            text = "more cells, " + cells_in_words(scene) + ", fail: " + why;
            say(scene, text + "\nAgain with " + cells_in_words(*before));
            scene       = *before;
            before      = {};
            has_coarser = false;
            directory.write_parameters(scene.completed_parameters);
            continue;
          }
        Ranks::meet(); // the first one has written
        const auto   summary = summary_in(directory.path());
        const double error   = number_in(summary, "error_estimate");
        if (!coarser)
          add_warning(directory,
                      summary,
                      "the error is not known, as these meshes of files "
                      "cannot be coarser");
        if (!(error > scene.accuracy))
          return;
        const auto finer = next_scene(scene, summary, error_before, text);
        if (!finer)
          return add_warning(directory, summary, text);
        say(scene, std::exchange(text, ""));
        has_coarser = is_kept_as_coarser(directory, scene, *finer);
        directory.write_parameters(finer->completed_parameters);
        error_before = error;
        before       = scene;
        scene        = *finer;
        bodies       = nullptr;
      }
  }



  void
  print_choices(const Scene &scene, std::ostream &out)
  {
    if (scene.accuracy == 0.)
      return;
    const auto coarser = coarser_scene(scene);
    Text       text;
    text << "For an accuracy of " << to_text(100. * scene.accuracy, 3)
         << " %: " << cells_in_words(scene) << " cells, and for the error "
         << (coarser ? cells_in_words(*coarser) : "none")
         << (finer_scene(scene) ? "; with more of them if it is larger\n" :
                                  ", as the scene sets its cells\n");
    // of runs with 1400 to 240 000 unknowns, most within a factor of four;
    // those of quadratic cells about an axis take longer
    const double rate = scene.implant.geometry().is_in_bore() ? 1.6e-4 : 4e-5,
                 n    = n_unknowns_of(scene);
    if (n > 0.)
      text << "both take some "
           << to_text(scene.bone.has_tetrahedra() ? 1.8e-4 * std::pow(n, 1.3) :
                                                    rate * std::pow(n, 1.2),
                      2)
           << " s; stiff interfaces, and steps that are many, up to four times "
              "that\n";
    std::string list;
    for (const SceneEntry &entry : scene.completed_entries())
      if (is_among(scene.chosen, entry.full_name()))
        list +=
          (list.empty() ? "" : "; ") + entry.full_name() + " = " + entry.value;
    if (!list.empty())
      text << "chosen for it: " << list << '\n';
    out << std::string(text);
  }
} // namespace Debond
