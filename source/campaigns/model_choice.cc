#include <debond/campaigns/model_choice.h>
#include <debond/input/csv_table.h>
#include <debond/models/closed_form_solution.h>
#include <debond/models/debonding_problem.h>
#include <debond/models/memory_estimate.h>
#include <debond/output/console.h>
#include <debond/support/input_error.h>
#include <debond/support/interruption.h>
#include <debond/support/number_text.h>

#include <deal.II/base/timer.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <set>
#include <utility>

namespace Debond
{
  namespace
  {
    /** "4.4 %", or "unknown". */
    std::string
    percent(const double ratio)
    {
      return std::isnan(ratio) ? "unknown" : to_text(100. * ratio, 2) + " %";
    }



    /** Adaptive steps take a tenth of the tolerance. Their own estimate holds
     *  approximately: the measured error is up to 1.5 times their tolerance. */
    constexpr double share_of_steps = 0.1, reserve_of_steps = 2.;

    /** The linearisation is measured on the coarsest mesh, which sees less of
     *  the largest strains. */
    constexpr double reserve_of_linearisation = 2.;

    /** Finer meshes may be linear if linearising costs less than this part of
     *  the tolerance. */
    constexpr double share_of_linearisation = 0.1;

    /** A mesh tells something of another one if its cells are that much larger.
     */
    constexpr double smallest_cell_ratio = 1.4;



    /**
     * Runs the models of a ModelHierarchy from the cheapest until the error of
     * one of their torque curves is estimated to be within `Load steps /
     * Tolerance`, and answers with the cheapest one that is. The error is the
     * largest difference from the curve of the scene's own bodies on a
     * converged mesh, relative to the largest torque; doc/auto.md says how it
     * is estimated.
     */
    struct ModelChoice
    {
      const double            tolerance;
      const ModelHierarchy    hierarchy;
      const double            step_error; ///< what steps add to an estimate
      std::vector<ModelLevel> tried;      ///< by cost
      std::string why_no_further;         ///< if the tolerance is not reached
      Materials   refined;                ///< those of the finer meshes

      explicit ModelChoice(const Scene &scene)
        : tolerance(scene.load_steps.tolerance)
        , hierarchy(scene, share_of_steps * tolerance)
        , step_error(reserve_of_steps * share_of_steps * tolerance)
        , refined(hierarchy.materials.back())
      {}

      /** Tries the models, each in a directory DIR/rung-1 and so on. */
      void
      climb(Console &console)
      {
        try_level(hierarchy.foundation(), console);
        for (const Materials &materials : hierarchy.materials)
          if (sufficient() == nullptr)
            try_level(hierarchy.finite_elements(materials, 0), console);
        if (linearisation_error() <= share_of_linearisation * tolerance)
          refined = hierarchy.linear_materials;
        unsigned int mesh = 0;
        while (sufficient() == nullptr && why_no_further.empty())
          {
            while (find(refined, mesh) != nullptr)
              ++mesh;
            why_no_further =
              mesh == 0 ? "the scene's own bodies could not be solved for" :
                          hierarchy.limit(refined, mesh);
            if (!why_no_further.empty())
              return;
            try_level(hierarchy.finite_elements(refined, mesh), console);
            if (!tried.back().done)
              why_no_further = "the next mesh " + tried.back().why_not;
          }
      }



      // The foundation has an estimate of its own; the others are compared.
      void
      run(ModelLevel &level) const
      {
        level.scene.complete();
        if (!level.is_foundation())
          {
            DebondingProblem problem(level.scene);
            problem.run();
            level.rows = problem.rows;
            return;
          }
        const dealii::Timer      clock;
        const ClosedFormSolution solution(level.scene);
        write_results(solution, clock);
        level.rows                  = solution.rows;
        const auto [coarser, ratio] = hierarchy.below_coarsest();
        if (ratio >= smallest_cell_ratio) // else it is nothing to compare with
          level.estimate =
            step_error + foundation_error(level.scene,
                                          level.rows,
                                          solution.linear_solution,
                                          foundation_stiffness(coarser),
                                          ratio);
      }



      void
      try_level(ModelLevel level, Console &console)
      {
        const dealii::Timer timer;
        const std::string   number = std::to_string(tried.size() + 1);
        level.scene.output.directory += "/rung-" + number;
        try
          {
            run(level);
            level.done = true;
          }
        catch (const Interrupted &interruption)
          {
            throw Interrupted(interruption.signal,
                              "interrupted by " +
                                signal_name(interruption.signal) +
                                " in level " + number +
                                ": Model = auto keeps no checkpoints");
          }
        catch (const WriteError &)
          {
            throw;
          }
        catch (const InputError &error)
          {
            // of other mistakes of the scene every level would complain
            if (!level.is_foundation() &&
                dynamic_cast<const NotEnoughMemory *>(&error) == nullptr)
              throw;
            level.why_not = std::string("refused: ") + error.what();
          }
        catch (const std::exception &error)
          {
            level.why_not = std::string("failed: ") + error.what();
          }
        level.seconds = timer.wall_time();
        tried.push_back(std::move(level));
        estimate_errors();
        console.headline(
          "  level " + number + ": " + tried.back().description() + ": " +
          (tried.back().done ? fixed_text(tried.back().seconds, 2) + " s" :
                               tried.back().why_not));
      }



      const ModelLevel *
      find(const Materials &materials, const unsigned int mesh) const
      {
        for (const ModelLevel &level : tried)
          if (level.done && !level.is_foundation() &&
              level.materials == materials && level.mesh == mesh)
            return &level;
        return nullptr;
      }



      // The finest mesh of the materials that are refined; if these could not
      // be solved for, the richest model that could.
      const ModelLevel *
      best() const
      {
        const bool        is_solved = find(refined, 0) != nullptr;
        const ModelLevel *best      = nullptr;
        for (const ModelLevel &level : tried)
          if (level.done && (!is_solved || (level.materials == refined &&
                                            !level.is_foundation())))
            best = &level;
        return best;
      }



      const ModelLevel *
      sufficient() const
      {
        for (const ModelLevel &level : tried)
          if (is_sufficient(level))
            return &level;
        return nullptr;
      }



      double
      linearisation_error() const
      {
        if (hierarchy.linear_materials == hierarchy.materials.back())
          return 0.;
        const ModelLevel *const linear = find(hierarchy.linear_materials, 0);
        const ModelLevel *const exact  = find(hierarchy.materials.back(), 0);
        return linear == nullptr || exact == nullptr ?
                 ModelLevel::undefined :
                 reserve_of_linearisation *
                   largest_difference(linear->rows, exact->rows);
      }



      // The error of the finest mesh from its neighbours, that of the others
      // from how far they are from it.
      void
      estimate_errors()
      {
        std::vector<double> differences;
        for (unsigned int mesh = 1; find(refined, mesh) != nullptr; ++mesh)
          differences.push_back(
            largest_difference(find(refined, mesh - 1)->rows,
                               find(refined, mesh)->rows));
        if (differences.empty())
          return;
        const ModelLevel *finest = best();
        const double      error =
          discretisation_error(differences) + step_error +
          (refined == hierarchy.materials.back() ? 0. : linearisation_error());
        for (ModelLevel &level : tried)
          if (level.done)
            {
              level.difference = &level == finest ?
                                   0. :
                                   largest_difference(level.rows, finest->rows);
              // the largest torque may itself be less by the error
              level.estimate = error < 1. ?
                                 level.difference / (1. - error) + error :
                                 ModelLevel::undefined;
            }
      }



      bool
      is_sufficient(const ModelLevel &level) const
      {
        return level.done && level.estimate <= tolerance;
      }



      /** The cheapest within the tolerance, else the best; none if no model
       *  could be run. */
      const ModelLevel *
      answer() const
      {
        return sufficient() != nullptr ? sufficient() : best();
      }



      /** Why the answer is no better than it is, in words. */
      std::string
      reason() const
      {
        const ModelLevel *const answer = this->answer();
        if (is_sufficient(*answer))
          return "the estimated error is within the tolerance";
        std::string estimate;
        if (!std::isnan(answer->estimate))
          estimate = "the estimated error is " + percent(answer->estimate);
        else if (find(refined, 0) == nullptr || find(refined, 1) == nullptr)
          estimate = "there is no second mesh to estimate the error with";
        else
          estimate =
            "the curves of its meshes give no estimate of the error: they "
            "do not converge, are off by more than the largest torque or "
            "have no angle beyond zero in common";
        return "the tolerance of " + percent(tolerance) +
               " was not reached: " + estimate + "; " + why_no_further;
      }
    };



    /** Fields and profiles of the answer of `Model = auto` go to the scene's
     *  directory, those of other levels nowhere. */
    void
    sort_files(const std::string &from, const std::string &to, bool is_answer)
    {
      namespace fs = std::filesystem;
      const std::set<std::string> stay{"torque.csv",
                                       "curve.csv",
                                       "summary.json",
                                       "parameters.prm"};
      std::vector<fs::path>       files;
      std::error_code             none; // refused levels have no directory
      for (const auto &entry : fs::directory_iterator(from, none))
        files.push_back(entry.path());
      for (const fs::path &file : files)
        {
          const fs::path name = file.filename();
          if (is_answer && (name == "torque.csv" || name == "curve.csv"))
            fs::copy_file(file,
                          to / name,
                          fs::copy_options::overwrite_existing);
          else if (is_answer && stay.count(name) == 0)
            fs::rename(file, to / name);
          else if (stay.count(name) == 0)
            fs::remove(file);
        }
    }



    double
    largest_torque(const std::vector<TorqueRow> &rows)
    {
      return measure_torque_curve(rows, CurveSettings())["T_max_Nmm"];
    }



    std::string
    verdict(const ModelChoice &choice, const ModelLevel &level)
    {
      const bool is_answer  = &level == choice.answer();
      const bool sufficient = choice.is_sufficient(level);
      return !level.done                ? level.why_not :
             is_answer && sufficient    ? "the answer" :
             is_answer                  ? "the answer, but not sufficient" :
             sufficient                 ? "sufficient" :
             std::isnan(level.estimate) ? "not estimated" :
                                          "not sufficient";
    }



    void
    write_table(const ModelChoice &choice, const std::string &filename)
    {
      std::string  table  = "rung,model,bone_material,implant_material,"
                            "bone_cells,implant_cells,unknowns,steps,seconds,"
                            "T_max_Nmm,difference,estimate,verdict\n";
      unsigned int number = 0;
      for (const ModelLevel &level : choice.tried)
        table +=
          csv_line({std::to_string(++number),
                    level.model(),
                    name_of(level.materials[0]),
                    name_of(level.materials[1]),
                    in_words(level.scene.bone.cells),
                    in_words(level.scene.implant.cells),
                    to_text(level.unknowns(), 6),
                    std::to_string(level.done ? level.rows.back().step : 0),
                    to_text(level.seconds, 6),
                    to_text(largest_torque(level.rows), 6),
                    to_text(level.difference, 6),
                    to_text(level.estimate, 6),
                    verdict(choice, level)});
      write_file(filename, table);
    }



  } // namespace



  void
  run_auto(const Scene &scene)
  {
    const dealii::Timer clock;
    ModelChoice         choice(scene);
    Console console(scene.output.quiet, scene.load_steps.times, std::cout);
    const ResultDirectory directory(scene.output, scene.completed_parameters);
    remove_results(directory.path(), true);
    if (!scene.title.empty())
      console.headline(scene.title);
    choice.climb(console);
    write_table(choice, directory.file("auto.csv"));
    const ModelLevel *const answer = choice.answer();
    if (answer == nullptr)
      throw RunError("Model = auto: no model could be run; " +
                     directory.file("auto.csv") + " says why");
    for (const ModelLevel &level : choice.tried)
      sort_files(level.scene.output.directory,
                 directory.path(),
                 &level == answer);
    const bool reached = choice.is_sufficient(*answer);
    // The summary of the answer, and what only the choice knows.
    nlohmann::ordered_json json =
      read_json(answer->scene.output.directory + "/summary.json");
    json.update({{"wall_seconds", clock.wall_time()},
                 {"converged", reached},
                 {"reason", choice.reason()},
                 {"error_estimate", answer->estimate},
                 {"error_tolerance", choice.tolerance},
                 {"answer", answer->description()},
                 {"answer_rung", answer - choice.tried.data() + 1},
                 {"rungs", choice.tried.size()}});
    write_json(directory.file("summary.json"), json);
    console.headline(
      Text() << (reached ? "Answer: " : "Best: ") << answer->description()
             << ", estimated error " << percent(answer->estimate)
             << " of the largest torque, " << largest_torque(answer->rows)
             << " N mm. Results are in " << directory.path());
    if (!reached)
      throw RunError("Model = auto: " + choice.reason());
  }



  void
  check_auto(const Scene &scene, std::ostream &out)
  {
    const ClassicNumbers  classic(out);
    const ModelChoice     choice(scene);
    const ModelHierarchy &hierarchy = choice.hierarchy;
    const Materials      &richest   = hierarchy.materials.back();
    unsigned int          number    = 0;
    out << "Model auto would climb until the torque curve is right to "
        << percent(choice.tolerance) << ":\n";
    const auto print = [&](const ModelLevel &level, const std::string &remark) {
      out << "  " << ++number << " " << level.description() << ", "
          << level.unknowns() << " unknowns" << remark << '\n';
    };
    const ModelLevel closed_form = hierarchy.foundation();
    std::string      refused;
    try
      {
        ClosedFormSolution solution(closed_form.scene);
      }
    catch (const InputError &error)
      {
        refused = std::string("; refused: ") + error.what();
      }
    print(closed_form, refused);
    for (const Materials &materials : hierarchy.materials)
      print(hierarchy.finite_elements(materials, 0), "");
    unsigned int mesh = 1;
    for (; hierarchy.limit(richest, mesh).empty(); ++mesh)
      print(hierarchy.finite_elements(richest, mesh),
            richest == hierarchy.linear_materials ?
              "" :
              ", or linear if that is accurate enough");
    out << "and no further: " << hierarchy.limit(richest, mesh) << '\n';
  }



} // namespace Debond
