#include <debond/campaigns/auto_problem.h>
#include <debond/models/closed_form_problem.h>
#include <debond/models/curve_error.h>
#include <debond/models/debonding_problem.h>
#include <debond/models/foundation_error.h>
#include <debond/models/memory_estimate.h>
#include <debond/output/earlier_results.h>
#include <debond/support/input_error.h>
#include <debond/support/interruption.h>

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



    /** What the scene prescribes, densely: expressions may do anything between
     *  planned steps. Each phase has at least a thousand points, the ends of
     *  planned steps among them. */
    std::vector<Chuck::Vector6>
    prescribed_values(const Scene &scene)
    {
      const Chuck                 chuck(scene.chuck,
                        Eigen::Vector3d::Zero(),
                        scene.implant.characteristic_radius());
      const std::vector<double>  &times = scene.load_steps.times;
      std::vector<Chuck::Vector6> values{chuck.values(times.front())};
      for (std::size_t p = 0; p + 1 < times.size(); ++p)
        {
          const unsigned int steps = scene.load_steps.steps[p],
                             n     = steps * ((999 + steps) / steps);
          for (unsigned int i = 1; i <= n; ++i)
            values.push_back(chuck.values(
              i == n ? times[p + 1] :
                       times[p] + (times[p + 1] - times[p]) * i / n));
        }
      return values;
    }



    /** The component of the chuck that changes while the angle holds and after
     *  the rotation began, where torque is no function of the angle; rotation_z
     * if there is none. */
    unsigned int
    component_that_changes_in_a_hold(const std::vector<Chuck::Vector6> &values)
    {
      Chuck::Vector6 scale = Chuck::Vector6::Zero();
      for (const Chuck::Vector6 &value : values)
        scale = scale.cwiseMax(value.cwiseAbs());
      const auto changes = [&](const unsigned int k, const std::size_t i) {
        return std::abs(values[i][k] - values[i - 1][k]) > 1e-12 * scale[k];
      };
      bool began = false;
      for (std::size_t i = 1; i < values.size(); ++i)
        {
          began = began || changes(ChuckComponent::rotation_z, i);
          for (unsigned int k = 0; k < ChuckComponent::rotation_z; ++k)
            if (began && !changes(ChuckComponent::rotation_z, i) &&
                changes(k, i))
              return k;
        }
      return ChuckComponent::rotation_z;
    }



    void
    refuse_what_has_no_curve(const Scene &scene)
    {
      const std::string entry = "Chuck / Rotation z / ";
      if (scene.chuck.component[ChuckComponent::rotation_z].loaded)
        throw EntryError(entry + "Control",
                         "Model = auto compares torques and takes this "
                         "rotation as prescribed");
      const std::vector<Chuck::Vector6> values = prescribed_values(scene);
      double                            turned = 0.;
      for (std::size_t i = 1; i < values.size(); ++i)
        turned += std::abs(values[i][ChuckComponent::rotation_z] -
                           values[i - 1][ChuckComponent::rotation_z]);
      if (turned == 0.)
        throw EntryError(entry + "Value",
                         "Model = auto judges a model by its torque curve, and "
                         "nothing rotates about z in this scene: choose a "
                         "model with Model");
      if (turned > std::abs(values.back()[ChuckComponent::rotation_z] -
                            values.front()[ChuckComponent::rotation_z]) *
                     (1. + 1e-9))
        throw EntryError(entry + "Value",
                         "Model = auto compares torques over the angle and "
                         "knows no rotation that reverses");
      const unsigned int k = component_that_changes_in_a_hold(values);
      if (k < 5)
        throw EntryError(ChuckParameters::entry_name(k, "Value"),
                         "Model = auto compares torques over the angle and "
                         "would not see what this does while the rotation "
                         "about z pauses or has ended; it may change before "
                         "the rotation begins and during it");
    }



    std::string
    percent(const double ratio)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%.2g %%", 100. * ratio);
      return std::isnan(ratio) ? "unknown" : text;
    }



    double
    largest_torque(const std::vector<TorqueRow> &rows)
    {
      return measure_torque_curve(rows, CurveSettings()).T_max_Nmm;
    }

  } // namespace



  AutoProblem::AutoProblem(const Scene &scene)
    : scene(scene)
    , tolerance(scene.load_steps.tolerance)
    , step_tolerance(share_of_steps * tolerance)
    , step_error(reserve_of_steps * step_tolerance)
    , ladder(scene)
    , console(scene.output.console, std::cout)
    , refined(ladder.materials().back())
  {
    refuse_what_has_no_curve(scene);
  }

  AutoProblem::~AutoProblem() = default;



  const std::vector<TorqueRow> &
  AutoProblem::rows() const
  {
    static const std::vector<TorqueRow> none;
    return answer == nullptr ? none : answer->rows;
  }



  void
  AutoProblem::run()
  {
    const ResultDirectory directory(scene.output, scene.completed_parameters);
    remove_rungs(directory.path());
    if (!scene.title.empty())
      console.headline(scene.title);
    climb();
    write_results(directory);
  }



  void
  AutoProblem::climb()
  {
    try_foundation();
    for (const Materials &materials : ladder.materials())
      if (sufficient() == nullptr)
        try_finite_elements(materials, 0);
    if (linearisation_error() <= share_of_linearisation * tolerance)
      refined = ladder.linear_materials();
    while (sufficient() == nullptr && why_no_further.empty())
      refine();
    answer = sufficient() != nullptr ? sufficient() : best();
  }



  void
  AutoProblem::try_foundation()
  {
    const dealii::Timer timer;
    Rung                rung = ladder.foundation(1, step_tolerance);
    try
      {
        ClosedFormProblem problem(rung.scene);
        problem.run();
        rung.rows     = problem.rows();
        rung.done     = true;
        rung.estimate = foundation_estimate(rung, problem.linear_solution());
      }
    catch (const InputError &error)
      {
        rung.why_not = std::string("refused: ") + error.what();
      }
    rung.seconds = timer.wall_time();
    rungs.push_back(rung);
    report(rung);
  }



  double
  AutoProblem::foundation_estimate(const Rung                &rung,
                                   const FoundationStiffness &stiffness) const
  {
    double      cell_ratio = 0.;
    const Scene coarser    = ladder.below_coarsest(cell_ratio);
    if (cell_ratio < smallest_cell_ratio)
      return Rung::undefined; // nothing to compare the mesh with
    return foundation_error(rung.scene,
                            rung.rows,
                            stiffness,
                            foundation_stiffness(coarser),
                            cell_ratio) +
           step_error;
  }



  void
  AutoProblem::try_finite_elements(const Materials   &materials,
                                   const unsigned int mesh)
  {
    const dealii::Timer timer;
    Rung                rung =
      ladder.finite_elements(rungs.size() + 1, materials, mesh, step_tolerance);
    try
      {
        DebondingProblem problem(rung.scene);
        problem.run();
        rung.rows = problem.rows();
        rung.done = true;
      }
    catch (const NotEnoughMemory &error)
      {
        rung.why_not = std::string("refused: ") + error.what();
      }
    catch (const InputError &)
      {
        throw;
      }
    catch (const WriteError &)
      {
        throw;
      }
    catch (const Interrupted &interruption)
      {
        throw Interrupted(interruption.signal,
                          "interrupted by " + signal_name(interruption.signal) +
                            " in rung " + std::to_string(rungs.size() + 1) +
                            ": Model = auto keeps no checkpoints");
      }
    catch (const std::exception &error)
      {
        rung.why_not = std::string("failed: ") + error.what();
      }
    rung.seconds = timer.wall_time();
    rungs.push_back(rung);
    estimate_errors();
    report(rungs.back());
  }



  void
  AutoProblem::refine()
  {
    unsigned int mesh = 0;
    while (find(refined, mesh) != nullptr)
      ++mesh;
    if (mesh == 0)
      why_no_further = "the scene's own bodies could not be solved for";
    else
      why_no_further = ladder.limit(refined, mesh);
    if (!why_no_further.empty())
      return;
    try_finite_elements(refined, mesh);
    if (!rungs.back().done)
      why_no_further = "the next mesh " + rungs.back().why_not;
  }



  const Rung *
  AutoProblem::find(const Materials &materials, const unsigned int mesh) const
  {
    for (const Rung &rung : rungs)
      if (rung.done && rung.model != "foundation" &&
          rung.materials == materials && rung.mesh == mesh)
        return &rung;
    return nullptr;
  }



  // The finest mesh of the materials that are refined; if these could not be
  // solved for, the richest model that could.
  const Rung *
  AutoProblem::best() const
  {
    const bool  is_solved = find(refined, 0) != nullptr;
    const Rung *best      = nullptr;
    for (const Rung &rung : rungs)
      if (rung.done && (!is_solved || (rung.materials == refined &&
                                       rung.model != "foundation")))
        best = &rung;
    return best;
  }



  const Rung *
  AutoProblem::sufficient() const
  {
    for (const Rung &rung : rungs)
      if (rung.done && rung.estimate <= tolerance)
        return &rung;
    return nullptr;
  }



  double
  AutoProblem::linearisation_error() const
  {
    if (ladder.linear_materials() == ladder.materials().back())
      return 0.;
    const Rung *const linear = find(ladder.linear_materials(), 0);
    const Rung *const exact  = find(ladder.materials().back(), 0);
    return linear == nullptr || exact == nullptr ?
             Rung::undefined :
             reserve_of_linearisation *
               largest_difference(linear->rows, exact->rows);
  }



  // The error of the finest mesh from its neighbours, that of the others from
  // how far they are from it.
  void
  AutoProblem::estimate_errors()
  {
    std::vector<double> differences;
    for (unsigned int mesh = 1; find(refined, mesh) != nullptr; ++mesh)
      differences.push_back(largest_difference(find(refined, mesh - 1)->rows,
                                               find(refined, mesh)->rows));
    if (differences.empty())
      return;
    const Rung  *finest = best();
    const double error =
      discretisation_error(differences) + step_error +
      (refined == ladder.materials().back() ? 0. : linearisation_error());
    for (Rung &rung : rungs)
      if (rung.done)
        {
          rung.difference =
            &rung == finest ? 0. : largest_difference(rung.rows, finest->rows);
          // the largest torque may itself be less by the error
          rung.estimate = error < 1. ? rung.difference / (1. - error) + error :
                                       Rung::undefined;
        }
  }



  std::string
  AutoProblem::verdict(const Rung &rung) const
  {
    if (!rung.done)
      return rung.why_not;
    if (&rung == answer)
      return rung.estimate <= tolerance ? "the answer" :
                                          "the answer, but not sufficient";
    return std::isnan(rung.estimate)  ? "not estimated" :
           rung.estimate <= tolerance ? "sufficient" :
                                        "not sufficient";
  }



  // When a rung is done, its error is mostly not known yet.
  void
  AutoProblem::report(const Rung &rung)
  {
    char text[40];
    std::snprintf(text, sizeof(text), "%.2f s", rung.seconds);
    console.headline("  rung " + std::to_string(rungs.size()) + ": " +
                     rung.description() + ": " +
                     (rung.done ? text : rung.why_not));
  }



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
  } // namespace



  void
  AutoProblem::write_results(const ResultDirectory &directory)
  {
    write_table(directory);
    if (answer == nullptr)
      throw RunError("Model = auto: no model could be run; " +
                     directory.file("auto.csv") + " says why");
    for (const Rung &rung : rungs)
      if (fs::exists(rung.scene.output.directory))
        sort_files(rung.scene.output.directory,
                   directory.path(),
                   &rung == answer);
    write_summary(directory);
    const bool         reached = answer->estimate <= tolerance;
    std::ostringstream text;
    text << (reached ? "Answer: " : "Best: ") << answer->description()
         << ", estimated error " << percent(answer->estimate)
         << " of the largest torque, " << largest_torque(answer->rows)
         << " N mm. Results are in " << directory.path();
    console.headline(text.str());
    if (!reached)
      throw RunError("Model = auto: " + reason());
  }



  std::string
  AutoProblem::reason() const
  {
    if (answer->estimate <= tolerance)
      return "the estimated error is within the tolerance";
    std::string estimate;
    if (!std::isnan(answer->estimate))
      estimate = "the estimated error is " + percent(answer->estimate);
    else if (find(refined, 0) == nullptr || find(refined, 1) == nullptr)
      estimate = "there is no second mesh to estimate the error with";
    else
      estimate = "the curves of its meshes give no estimate of the error: they "
                 "do not converge, are off by more than the largest torque or "
                 "have no angle beyond zero in common";
    return "the tolerance of " + percent(tolerance) +
           " was not reached: " + estimate + "; " + why_no_further;
  }



  void
  AutoProblem::write_table(const ResultDirectory &directory) const
  {
    const auto cells = [](const BodyParameters &body) {
      std::ostringstream text;
      text << body.cells[0] << " x " << body.cells[1] << " x " << body.cells[2];
      return text.str();
    };
    std::ostringstream table;
    table.precision(6);
    table << "rung,model,bone_material,implant_material,bone_cells,"
             "implant_cells,unknowns,steps,seconds,T_max_Nmm,difference,"
             "estimate,verdict\n";
    for (std::size_t i = 0; i < rungs.size(); ++i)
      {
        const Rung &rung  = rungs[i];
        std::string words = verdict(rung);
        std::replace(words.begin(), words.end(), '"', '\'');
        table << i + 1 << ',' << rung.model << ',' << name_of(rung.materials[0])
              << ',' << name_of(rung.materials[1]) << ','
              << cells(rung.scene.bone) << ',' << cells(rung.scene.implant)
              << ',' << rung.unknowns() << ','
              << (rung.done ? rung.rows.back().step : 0) << ',' << rung.seconds
              << ',' << largest_torque(rung.rows) << ',' << rung.difference
              << ',' << rung.estimate << ",\"" << words << "\"\n";
      }
    write_file(directory.file("auto.csv"), table.str());
  }



  void
  AutoProblem::write_summary(const ResultDirectory &directory) const
  {
    JsonObject json =
      JsonObject::from_file(answer->scene.output.directory + "/summary.json");
    json.add("wall_seconds", clock.wall_time());
    json.add("converged", answer->estimate <= tolerance);
    json.add("reason", reason());
    json.add("error_estimate", answer->estimate);
    json.add("error_tolerance", tolerance);
    json.add("answer", answer->description());
    json.add("answer_rung", answer - rungs.data() + 1);
    json.add("rungs", rungs.size());
    write_file(directory.file("summary.json"), json.text());
  }



  void
  AutoProblem::check(std::ostream &out)
  {
    out << "Model auto would climb until the torque curve is right to "
        << percent(tolerance) << ":\n";
    unsigned int number = 0;
    const auto   print  = [&](const Rung &rung, const std::string &remark) {
      out << "  " << ++number << " " << rung.description() << ", "
          << rung.unknowns() << " unknowns" << remark << '\n';
    };
    Rung closed_form = ladder.foundation(1, step_tolerance);
    try
      {
        ClosedFormProblem problem(closed_form.scene);
        print(closed_form, "");
      }
    catch (const InputError &error)
      {
        print(closed_form, std::string("; refused: ") + error.what());
      }
    for (const Materials &materials : ladder.materials())
      print(ladder.finite_elements(1, materials, 0, step_tolerance), "");
    unsigned int mesh = 1;
    for (; ladder.limit(refined, mesh).empty(); ++mesh)
      print(ladder.finite_elements(1, refined, mesh, step_tolerance),
            refined == ladder.linear_materials() ?
              "" :
              ", or linear if that is accurate enough");
    out << "and no further: " << ladder.limit(refined, mesh) << '\n';
  }
} // namespace Debond
