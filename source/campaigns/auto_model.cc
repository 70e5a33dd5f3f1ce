#include <debond/bulk/side.h>
#include <debond/campaigns/auto_model.h>
#include <debond/campaigns/model_choice.h>
#include <debond/input/csv_table.h>
#include <debond/models/closed_form_results.h>
#include <debond/models/debonding_problem.h>
#include <debond/output/console.h>
#include <debond/support/input_error.h>
#include <debond/support/number_text.h>

#include <deal.II/base/timer.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace Debond
{
  namespace
  {
    namespace fs = std::filesystem;

    bool
    is_kept_by_every_rung(const std::string &name)
    {
      return name == "torque.csv" || name == "summary.json" ||
             name == "parameters.prm";
    }



    /** Fields and profiles of the answer go to the scene's directory, those of
     *  other rungs nowhere. */
    void
    sort_files(const std::string &from, const std::string &to, bool is_answer)
    {
      std::vector<fs::path> files;
      for (const auto &entry : fs::directory_iterator(from))
        files.push_back(entry.path());
      for (const fs::path &file : files)
        {
          const std::string name = file.filename().string();
          if (is_answer && name == "torque.csv")
            fs::copy_file(file,
                          to + "/" + name,
                          fs::copy_options::overwrite_existing);
          else if (is_answer && !is_kept_by_every_rung(name))
            fs::rename(file, to + "/" + name);
          else if (!is_kept_by_every_rung(name))
            fs::remove(file);
        }
    }



    void
    run_rung(const ModelChoice &choice, Rung &rung)
    {
      rung.scene.complete();
      if (rung.is_foundation())
        {
          const dealii::Timer      clock;
          const ClosedFormSolution solution(rung.scene);
          write_results(solution, clock);
          rung.rows = solution.rows();
          rung.estimate =
            choice.foundation_estimate(rung, solution.linear_solution);
        }
      else
        {
          DebondingProblem problem(rung.scene);
          problem.run();
          rung.rows = problem.rows();
        }
    }



    double
    largest_torque(const std::vector<TorqueRow> &rows)
    {
      return measure_torque_curve(rows, CurveSettings()).T_max_Nmm;
    }



    std::string
    verdict(const ModelChoice &choice, const Rung &rung)
    {
      if (!rung.done)
        return rung.why_not;
      const bool is_sufficient = choice.is_sufficient(rung);
      if (&rung == choice.answer())
        return is_sufficient ? "the answer" : "the answer, but not sufficient";
      return is_sufficient             ? "sufficient" :
             std::isnan(rung.estimate) ? "not estimated" :
                                         "not sufficient";
    }



    void
    write_table(const ModelChoice &choice, const std::string &filename)
    {
      std::string  table  = "rung,model,bone_material,implant_material,"
                            "bone_cells,implant_cells,unknowns,steps,seconds,"
                            "T_max_Nmm,difference,estimate,verdict\n";
      unsigned int number = 0;
      for (const Rung &rung : choice.rungs())
        table +=
          csv_line({std::to_string(++number),
                    rung.model(),
                    name_of(rung.materials[0]),
                    name_of(rung.materials[1]),
                    in_words(rung.scene.bone.cells),
                    in_words(rung.scene.implant.cells),
                    to_text(rung.unknowns(), 6),
                    std::to_string(rung.done ? rung.rows.back().step : 0),
                    to_text(rung.seconds, 6),
                    to_text(largest_torque(rung.rows), 6),
                    to_text(rung.difference, 6),
                    to_text(rung.estimate, 6),
                    verdict(choice, rung)});
      write_file(filename, table);
    }



    /** The summary of the answer, and what only the choice knows. */
    void
    write_summary(const ModelChoice   &choice,
                  const dealii::Timer &clock,
                  const std::string   &filename)
    {
      const Rung            &answer = *choice.answer();
      nlohmann::ordered_json json =
        read_json(answer.scene.output.directory + "/summary.json");
      json["wall_seconds"]    = clock.wall_time();
      json["converged"]       = choice.is_sufficient(answer);
      json["reason"]          = choice.reason();
      json["error_estimate"]  = answer.estimate;
      json["error_tolerance"] = choice.tolerance;
      json["answer"]          = answer.description();
      json["answer_rung"]     = &answer - choice.rungs().data() + 1;
      json["rungs"]           = choice.rungs().size();
      write_json(filename, json);
    }
  } // namespace



  void
  run_auto(const Scene &scene)
  {
    const dealii::Timer   clock;
    ModelChoice           choice(scene);
    Console               console(scene.output.console, std::cout);
    const ResultDirectory directory(scene.output, scene.completed_parameters);
    remove_results(directory.path(), true);
    if (!scene.title.empty())
      console.headline(scene.title);
    choice.climb([&](Rung &rung) { run_rung(choice, rung); },
                 [&](const Rung &rung) {
                   char text[40];
                   std::snprintf(text, sizeof(text), "%.2f s", rung.seconds);
                   console.headline("  rung " +
                                    std::to_string(choice.rungs().size()) +
                                    ": " + rung.description() + ": " +
                                    (rung.done ? text : rung.why_not));
                 });

    write_table(choice, directory.file("auto.csv"));
    const Rung *const answer = choice.answer();
    if (answer == nullptr)
      throw RunError("Model = auto: no model could be run; " +
                     directory.file("auto.csv") + " says why");
    for (const Rung &rung : choice.rungs())
      if (fs::exists(rung.scene.output.directory))
        sort_files(rung.scene.output.directory,
                   directory.path(),
                   &rung == answer);
    write_summary(choice, clock, directory.file("summary.json"));
    const bool         reached = choice.is_sufficient(*answer);
    std::ostringstream text;
    text << (reached ? "Answer: " : "Best: ") << answer->description()
         << ", estimated error " << percent(answer->estimate)
         << " of the largest torque, " << largest_torque(answer->rows)
         << " N mm. Results are in " << directory.path();
    console.headline(text.str());
    if (!reached)
      throw RunError("Model = auto: " + choice.reason());
  }



  void
  check_auto(const Scene &scene, std::ostream &out)
  {
    const ModelChoice choice(scene);
    out << "Model auto would climb until the torque curve is right to "
        << percent(choice.tolerance) << ":\n";
    const ModelLadder &ladder  = choice.ladder;
    const Materials   &refined = choice.refined_materials();
    unsigned int       number  = 0;
    const auto print = [&](const Rung &rung, const std::string &remark) {
      out << "  " << ++number << " " << rung.description() << ", "
          << rung.unknowns() << " unknowns" << remark << '\n';
    };
    Rung closed_form = ladder.foundation(1);
    try
      {
        ClosedFormSolution solution(closed_form.scene);
        print(closed_form, "");
      }
    catch (const InputError &error)
      {
        print(closed_form, std::string("; refused: ") + error.what());
      }
    for (const Materials &materials : ladder.materials())
      print(ladder.finite_elements(1, materials, 0), "");
    unsigned int mesh = 1;
    for (; ladder.limit(refined, mesh).empty(); ++mesh)
      print(ladder.finite_elements(1, refined, mesh),
            refined == ladder.linear_materials() ?
              "" :
              ", or linear if that is accurate enough");
    out << "and no further: " << ladder.limit(refined, mesh) << '\n';
  }
} // namespace Debond
