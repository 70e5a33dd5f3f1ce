#include <debond/campaigns/model_choice.h>
#include <debond/campaigns/run_scene.h>
#include <debond/input/csv_table.h>
#include <debond/models/closed_form_solution.h>
#include <debond/models/debonding_problem.h>
#include <debond/output/console.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/timer.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <set>

namespace Debond
{
  namespace
  {
    /** Fields and profiles of the answer of `Model = auto` go to the scene's
     *  directory, those of other levels nowhere. */
    void
    sort_files(const std::string &from, const std::string &to, bool is_answer)
    {
      namespace fs = std::filesystem;
      const std::set<std::string> stay{"torque.csv",
                                       "summary.json",
                                       "parameters.prm"};
      if (!fs::exists(from))
        return;
      std::vector<fs::path> files;
      for (const auto &entry : fs::directory_iterator(from))
        files.push_back(entry.path());
      for (const fs::path &file : files)
        {
          const fs::path name = file.filename();
          if (is_answer && name == "torque.csv")
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
      if (!level.done)
        return level.why_not;
      const bool is_sufficient = choice.is_sufficient(level);
      if (&level == choice.answer())
        return is_sufficient ? "the answer" : "the answer, but not sufficient";
      return is_sufficient              ? "sufficient" :
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
      for (const ModelLevel &level : choice.levels())
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



    /** The summary of the answer, and what only the choice knows. */
    void
    write_summary(const ModelChoice   &choice,
                  const dealii::Timer &clock,
                  const std::string   &filename)
    {
      const ModelLevel      &answer = *choice.answer();
      nlohmann::ordered_json json =
        read_json(answer.scene.output.directory + "/summary.json");
      json["wall_seconds"]    = clock.wall_time();
      json["converged"]       = choice.is_sufficient(answer);
      json["reason"]          = choice.reason();
      json["error_estimate"]  = answer.estimate;
      json["error_tolerance"] = choice.tolerance;
      json["answer"]          = answer.description();
      json["answer_rung"]     = &answer - choice.levels().data() + 1;
      json["rungs"]           = choice.levels().size();
      write_json(filename, json);
    }



    /** `Model = auto`: runs the models that a ModelChoice tries. Results of the
     *  answer are then in the scene's directory, those of every level in
     *  DIR/rung-1 and so on, and auto.csv lists them. If the tolerance was not
     *  reached the answer is the best model, and summary.json says so. */
    void
    run_auto(const Scene &scene)
    {
      const dealii::Timer   clock;
      ModelChoice           choice(scene);
      Console               console(scene.output.quiet, std::cout);
      const ResultDirectory directory(scene.output, scene.completed_parameters);
      remove_results(directory.path(), true);
      if (!scene.title.empty())
        console.headline(scene.title);
      choice.climb([&](const ModelLevel &level) {
        char seconds[40];
        std::snprintf(seconds, sizeof(seconds), "%.2f s", level.seconds);
        console.headline(Text() << "  level " << choice.levels().size() << ": "
                                << level.description() << ": "
                                << (level.done ? seconds : level.why_not));
      });

      write_table(choice, directory.file("auto.csv"));
      const ModelLevel *const answer = choice.answer();
      if (answer == nullptr)
        throw RunError("Model = auto: no model could be run; " +
                       directory.file("auto.csv") + " says why");
      for (const ModelLevel &level : choice.levels())
        sort_files(level.scene.output.directory,
                   directory.path(),
                   &level == answer);
      write_summary(choice, clock, directory.file("summary.json"));
      const bool reached = choice.is_sufficient(*answer);
      console.headline(
        Text() << (reached ? "Answer: " : "Best: ") << answer->description()
               << ", estimated error " << percent(answer->estimate)
               << " of the largest torque, " << largest_torque(answer->rows)
               << " N mm. Results are in " << directory.path());
      if (!reached)
        throw RunError("Model = auto: " + choice.reason());
    }



    /** Prints which models it would try. */
    void
    check_auto(const Scene &scene, std::ostream &out)
    {
      const ModelChoice     choice(scene);
      const ModelHierarchy &hierarchy = choice.hierarchy;
      const Materials      &richest   = hierarchy.materials.back();
      unsigned int          number    = 0;
      out << "Model auto would climb until the torque curve is right to "
          << percent(choice.tolerance) << ":\n";
      const auto print = [&](const ModelLevel  &level,
                             const std::string &remark) {
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



    /** Calls @p function; what it says of the scene gets a place. */
    template <typename Function>
    void
    with_place(const Scene &scene, const Function &function)
    {
      try
        {
          function();
        }
      catch (const InputError &error)
        {
          throw scene.with_place(error);
        }
    }
  } // namespace



  void
  run_scene(const Scene &scene, std::shared_ptr<BodyPair> bodies)
  {
    with_place(scene, [&] {
      const dealii::Timer clock;
      if (scene.model == ModelKind::finite_elements)
        DebondingProblem(scene, std::move(bodies)).run();
      else if (scene.model == ModelKind::automatic)
        run_auto(scene);
      else
        write_results(ClosedFormSolution(scene), clock);
    });
  }



  void
  check_scene(const Scene &scene, std::ostream &out)
  {
    with_place(scene, [&] {
      if (scene.model == ModelKind::finite_elements)
        DebondingProblem(scene).check(out);
      else if (scene.model == ModelKind::automatic)
        check_auto(scene, out);
      else
        describe(ClosedFormSolution(scene), out);
    });
  }
} // namespace Debond
