#include <debond/campaigns/model_choice.h>
#include <debond/input/csv_table.h>
#include <debond/models/closed_form_solution.h>
#include <debond/models/debonding_problem.h>
#include <debond/output/console.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>
#include <debond/system/memory_estimate.h>

#include <deal.II/base/timer.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

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



    void
    run(ModelLevel &level)
    {
      const dealii::Timer clock;
      level.scene.complete();
      if (level.is_foundation())
        {
          const ClosedFormSolution solution(level.scene);
          write_results(solution, clock);
          level.rows = solution.rows;
          return;
        }
      DebondingProblem problem(level.scene);
      problem.run();
      level.rows = problem.rows;
    }



    /**
     * Climbs a ModelLadder until the error of one of the torque curves is
     * estimated to be within `Load steps / Tolerance`, and answers with the
     * cheapest model whose curve is. The error is the largest difference from
     * the curve of the scene's own bodies on a converged mesh, relative to the
     * largest torque; doc/howto/accuracy.md says what is tried, and
     * doc/evidence/speed_and_accuracy.md how close the estimates are.
     */
    struct ModelChoice
    {
      const double            tolerance;
      ModelLadder             ladder;
      std::vector<ModelLevel> tried; ///< by cost
      /** Those of the meshes from 1 on, and what these cost if they are not the
       *  scene's own. */
      std::array<Material, 2> refined;
      double                  linearisation_error = 0.;

      explicit ModelChoice(const Scene &scene)
        : tolerance(scene.load_steps.tolerance)
        , ladder(scene)
        , refined(ladder.levels.back().materials())
      {}

      /** Tries the models, each in a directory DIR/rung-1 and so on. */
      void
      climb(Console &console)
      {
        for (ModelLevel &level : ladder.levels)
          {
            if (level.mesh == 1)
              choose_materials();
            if (level.mesh > 0)
              {
                level.scene.bone.material    = refined[0];
                level.scene.implant.material = refined[1];
              }
            try_level(level, console);
            tried.push_back(level);
            if (level.mesh > 0 && level.rows.empty())
              {
                ladder.why_no_further = "the next mesh " + level.why_not;
                return;
              }
            estimate_errors();
            if (sufficient() != nullptr)
              return;
          }
      }



    private:
      // Measured on mesh 0, which sees less of the largest strains: twice.
      void
      choose_materials()
      {
        constexpr double  reserve = 2., largest_share = 0.1;
        const ModelLevel &exact  = tried.back(),
                         &linear = tried[tried.size() - 2];
        if (std::max(refined[0], refined[1]) <= Material::linear ||
            exact.rows.empty() || linear.rows.empty())
          return;
        const double error =
          reserve * largest_difference(linear.rows, exact.rows);
        if (error <= largest_share * tolerance)
          {
            refined             = linear.materials();
            linearisation_error = error;
          }
      }



      void
      try_level(ModelLevel &level, Console &console) const
      {
        const dealii::Timer timer;
        const std::string   number = std::to_string(tried.size() + 1);
        level.scene.output.directory += "/rung-" + number;
        try
          {
            run(level);
          }
        catch (const InputError &error)
          {
            // of other mistakes of the scene every level would complain
            if (!level.is_foundation() &&
                dynamic_cast<const NotEnoughMemory *>(&error) == nullptr)
              throw;
            level.why_not = std::string("refused: ") + error.what();
          }
        catch (const WriteError &)
          {
            throw;
          }
        catch (const Interrupted &)
          {
            throw;
          }
        catch (const std::exception &error) // the run, or no memory left
          {
            level.why_not = std::string("failed: ") + error.what();
          }
        level.seconds = timer.wall_time();
        console.headline(
          "  level " + number + ": " + level.description() + ": " +
          (level.rows.empty() ? level.why_not :
                                fixed_text(level.seconds, 2) + " s"));
      }



      // The error of the finest mesh from its neighbours, that of the others
      // from how far they are from it.
      void
      estimate_errors()
      {
        // Those of steps, which take a tenth of the tolerance: they exceed
        // their own tolerance by up to 1.5.
        const double        step_error = 0.2 * tolerance;
        std::vector<double> differences;
        const ModelLevel   *finest = nullptr;
        for (const ModelLevel &level : tried)
          if (!level.rows.empty() && !level.is_foundation() &&
              level.materials() == refined)
            {
              if (finest != nullptr)
                differences.push_back(
                  largest_difference(finest->rows, level.rows));
              finest = &level;
            }
        if (differences.empty())
          return;
        const double error =
          discretisation_error(differences) + step_error + linearisation_error;
        for (ModelLevel &level : tried)
          if (!level.rows.empty())
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



      const ModelLevel *
      sufficient() const
      {
        for (const ModelLevel &level : tried)
          if (level.estimate <= tolerance)
            return &level;
        return nullptr;
      }



    public:
      /** The cheapest within the tolerance, else the last; none if no model
       *  could be run. */
      const ModelLevel *
      answer() const
      {
        const ModelLevel *last = nullptr;
        for (const ModelLevel &level : tried)
          if (!level.rows.empty())
            last = &level;
        return sufficient() != nullptr ? sufficient() : last;
      }
    };



    double
    largest_torque(const std::vector<TorqueRow> &rows)
    {
      return rows.empty() ?
               ModelLevel::undefined :
               largest(curve_of(rows), &ReferenceCurve::value_type::second);
    }



    std::string
    verdict(const ModelLevel &level, const ModelChoice &choice)
    {
      if (level.rows.empty())
        return level.why_not;
      const bool is_answer     = &level == choice.answer(),
                 is_sufficient = level.estimate <= choice.tolerance;
      return is_answer ?
               is_sufficient ? "the answer" : "the answer, but not sufficient" :
             is_sufficient ? "sufficient" :
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
        table += csv_line(
          {std::to_string(++number),
           level.model(),
           name_of(level.scene.bone.material),
           name_of(level.scene.implant.material),
           in_words(level.scene.bone),
           in_words(level.scene.implant),
           to_text(level.unknowns(), 6),
           std::to_string(level.rows.empty() ? 0 : level.rows.back().step),
           to_text(level.seconds, 6),
           to_text(largest_torque(level.rows), 6),
           to_text(level.difference, 6),
           to_text(level.estimate, 6),
           verdict(level, choice)});
      write_file(filename, table);
    }



    /** Gives the scene's directory the files of the answer. Fields, which may
     *  be large, move there. */
    void
    take_files(const std::string &from, const std::string &to)
    {
      namespace fs = std::filesystem;
      std::vector<fs::path> files;
      for (const auto &entry : fs::directory_iterator(from))
        files.push_back(entry.path());
      for (const fs::path &file : files)
        if (const fs::path target = to / file.filename();
            file.extension() == ".csv" || file.extension() == ".json")
          fs::copy_file(file, target, fs::copy_options::overwrite_existing);
        else if (file.extension() != ".prm")
          fs::rename(file, target);
    }
  } // namespace



  void
  run_auto(const Scene &scene)
  {
    const dealii::Timer   clock;
    ModelChoice           choice(scene);
    Console               console(scene.output.quiet,
                    scene.load_steps.times,
                    scene.output.axes,
                    std::cout);
    const ResultDirectory directory(scene.output, scene.completed_parameters);
    remove_results(directory.path());
    if (!scene.title.empty())
      console.headline(scene.title);
    choice.climb(console);
    write_table(choice, directory.file("auto.csv"));
    const ModelLevel *const answer = choice.answer();
    if (answer == nullptr)
      throw RunError("Model = auto: no model could be run; " +
                     directory.file("auto.csv") + " says why");
    take_files(answer->scene.output.directory, directory.path());
    const bool        reached  = answer->estimate <= choice.tolerance;
    const std::string estimate = percent(answer->estimate),
                      reason =
                        reached ?
                          "the estimated error is within the tolerance" :
                          "the tolerance of " + percent(choice.tolerance) +
                            " was not reached: the estimated error is " +
                            estimate + "; " + choice.ladder.why_no_further;
    // The summary of the answer, and what only the choice knows.
    nlohmann::ordered_json json = read_json(directory.file("summary.json"));
    json.update({{"wall_seconds", clock.wall_time()},
                 {"converged", reached},
                 {"reason", reason},
                 {"error_estimate", answer->estimate},
                 {"error_tolerance", choice.tolerance},
                 {"answer", answer->description()},
                 {"answer_rung", answer - choice.tried.data() + 1},
                 {"rungs", choice.tried.size()}});
    write_json(directory.file("summary.json"), json);
    console.headline(Text() << (reached ? "Answer: " : "Best: ")
                            << answer->description() << ", estimated error "
                            << estimate << " of the largest torque, "
                            << largest_torque(answer->rows)
                            << " N mm. Results are in " << directory.path());
    if (!reached)
      throw RunError("Model = auto: " + reason);
  }



  void
  check_auto(const Scene &scene, std::ostream &out)
  {
    const ModelLadder ladder(scene);
    unsigned int      number = 0;
    Text              text;
    text << "Model auto would climb until the torque curve is right to "
         << percent(scene.load_steps.tolerance) << ":\n";
    for (const ModelLevel &level : ladder.levels)
      text << "  " << ++number << " " << level.description() << ", "
           << level.unknowns() << " unknowns\n";
    text << "and no further: " << ladder.why_no_further << '\n';
    out << std::string(text);
  }
} // namespace Debond
