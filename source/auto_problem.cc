#include <debond/auto_problem.h>
#include <debond/closed_form_problem.h>
#include <debond/curve_error.h>
#include <debond/debonding_problem.h>
#include <debond/foundation_error.h>
#include <debond/input_error.h>

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
     *  approximately: the measured error is up to 1.7 times their tolerance. */
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



    void
    refuse_what_has_no_curve(const Scene &scene)
    {
      const std::string entry = "Chuck / Rotation z / ";
      if (scene.chuck.component[5].loaded)
        throw InputError(entry + "Control: Model = auto compares torques and "
                                 "takes this rotation as prescribed");
      const Chuck        chuck(scene.chuck,
                        Eigen::Vector3d::Zero(),
                        scene.implant.characteristic_radius());
      const LoadStepping stepping(scene.load_steps);
      double             first = 0., last = 0., turned = 0.;
      for (unsigned int step = 0; step <= stepping.n_steps(); ++step)
        {
          const double angle = chuck.values(stepping.time(step))[5];
          turned += step == 0 ? 0. : std::abs(angle - last);
          first = step == 0 ? angle : first;
          last  = angle;
        }
      if (turned == 0.)
        throw InputError(entry +
                         "Value: Model = auto judges a model by its torque "
                         "curve, and nothing rotates about z in this scene: "
                         "choose a model with Model");
      if (turned > std::abs(last - first) * (1. + 1e-9))
        throw InputError(entry +
                         "Value: Model = auto compares torques over the angle "
                         "and knows no rotation that reverses");
    }



    std::string
    percent(const double ratio)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%.2g %%", 100. * ratio);
      return std::isnan(ratio) ? "?" : text;
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
    for (const auto &entry :
         std::filesystem::directory_iterator(directory.path()))
      if (entry.path().filename().string().compare(0, 5, "rung-") == 0)
        std::filesystem::remove_all(entry.path());
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
    catch (const InputError &)
      {
        throw;
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
    return "the tolerance of " + percent(tolerance) + " was not reached: " +
           (std::isnan(answer->estimate) ?
              "there is no second mesh to estimate the error with" :
              "the estimated error is " + percent(answer->estimate)) +
           "; " + why_no_further;
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
