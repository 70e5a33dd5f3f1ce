#include <debond/campaigns/model_choice.h>
#include <debond/models/closed_form_solution.h>
#include <debond/models/debonding_problem.h>
#include <debond/models/memory_estimate.h>
#include <debond/support/input_error.h>
#include <debond/support/interruption.h>

#include <deal.II/base/timer.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace Debond
{
  double
  largest_difference(const std::vector<TorqueRow> &rows,
                     const std::vector<TorqueRow> &reference)
  {
    // two polygons differ most at a corner of one of them
    const auto measures = [](const std::vector<TorqueRow> &rows,
                             const std::vector<TorqueRow> &others) {
      CurveSettings settings;
      for (const TorqueRow &row : others)
        settings.reference.emplace_back(row.angle_deg, row.torque_Nmm);
      return measure_torque_curve(rows, settings);
    };
    const auto   there           = measures(rows, reference);
    const auto   back            = measures(reference, rows);
    const double difference_back = back["difference_max"].get<double>() *
                                   there["T_max_Nmm"].get<double>() /
                                   back["T_max_Nmm"].get<double>();
    return std::isnan(difference_back) ?
             difference_back :
             std::max(difference_back, there["difference_max"].get<double>());
  }



  double
  discretisation_error(const std::vector<double> &differences)
  {
    constexpr double reserve = 1.25, lowest_order = 0.5, highest_order = 2.;
    const double     last = differences.back();
    if (last == 0.)
      return 0.;
    double order = 1.;
    if (differences.size() > 1)
      order = std::min(std::log2(differences[differences.size() - 2] / last),
                       highest_order);
    if (!(order >= lowest_order))
      return ModelLevel::undefined;
    return reserve * last / (std::exp2(order) - 1.);
  }



  std::string
  percent(const double ratio)
  {
    char text[32];
    std::snprintf(text, sizeof(text), "%.2g %%", 100. * ratio);
    return std::isnan(ratio) ? "unknown" : text;
  }



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



    void
    refuse_what_has_no_curve(const Scene &scene)
    {
      constexpr auto    z     = ChuckComponent::rotation_z;
      const std::string entry = "Chuck / Rotation z / ";
      if (scene.chuck.component[z].loaded)
        throw EntryError(entry + "Control",
                         "Model = auto compares torques and takes this "
                         "rotation as prescribed");
      const std::vector<Chuck::Vector6> values = prescribed_values(scene);
      Chuck::Vector6 rounding = Chuck::Vector6::Zero(), moved = rounding;
      for (const Chuck::Vector6 &value : values)
        rounding = rounding.cwiseMax(1e-12 * value.cwiseAbs());
      unsigned int moves_in_hold = z; // another component, if there is one
      for (std::size_t i = 1; i < values.size(); ++i)
        {
          const Chuck::Vector6 change =
            (values[i] - values[i - 1]).cwiseAbs().eval();
          moved += change;
          for (unsigned int k = 0; k < z && moves_in_hold == z; ++k)
            if (moved[z] > rounding[z] && change[z] <= rounding[z] &&
                change[k] > rounding[k])
              moves_in_hold = k;
        }
      if (moved[z] == 0.)
        throw EntryError(entry + "Value",
                         "Model = auto judges a model by its torque curve, and "
                         "nothing rotates about z in this scene: choose a "
                         "model with Model");
      if (moved[z] >
          std::abs(values.back()[z] - values.front()[z]) * (1. + 1e-9))
        throw EntryError(entry + "Value",
                         "Model = auto compares torques over the angle and "
                         "knows no rotation that reverses");
      if (moves_in_hold != z)
        throw EntryError(ChuckParameters::entry_name(moves_in_hold, "Value"),
                         "Model = auto compares torques over the angle and "
                         "would not see what this does while the rotation "
                         "about z pauses or has ended; it may change before "
                         "the rotation begins and during it");
    }
  } // namespace



  ModelChoice::ModelChoice(const Scene &scene)
    : tolerance(scene.load_steps.tolerance)
    , hierarchy(scene, share_of_steps * tolerance)
    , step_error(reserve_of_steps * share_of_steps * tolerance)
    , refined(hierarchy.materials.back())
  {
    refuse_what_has_no_curve(scene);
  }



  void
  ModelChoice::climb(const std::function<void(const ModelLevel &)> &report)
  {
    const auto run_and_report = [&](ModelLevel level) {
      try_level(std::move(level));
      report(tried.back());
    };
    run_and_report(hierarchy.foundation());
    for (const Materials &materials : hierarchy.materials)
      if (sufficient() == nullptr)
        run_and_report(hierarchy.finite_elements(materials, 0));
    if (linearisation_error() <= share_of_linearisation * tolerance)
      refined = hierarchy.linear_materials;
    unsigned int mesh = 0;
    while (sufficient() == nullptr && why_no_further.empty())
      {
        while (find(refined, mesh) != nullptr)
          ++mesh;
        why_no_further = mesh == 0 ?
                           "the scene's own bodies could not be solved for" :
                           hierarchy.limit(refined, mesh);
        if (!why_no_further.empty())
          return;
        run_and_report(hierarchy.finite_elements(refined, mesh));
        if (!tried.back().done)
          why_no_further = "the next mesh " + tried.back().why_not;
      }
  }



  // The foundation has an estimate of its own; the others are compared.
  void
  ModelChoice::run(ModelLevel &level) const
  {
    level.scene.complete();
    if (!level.is_foundation())
      {
        DebondingProblem problem(level.scene);
        problem.run();
        level.rows = problem.rows();
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
  ModelChoice::try_level(ModelLevel level)
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
                          "interrupted by " + signal_name(interruption.signal) +
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
  }



  const ModelLevel *
  ModelChoice::find(const Materials &materials, const unsigned int mesh) const
  {
    for (const ModelLevel &level : tried)
      if (level.done && !level.is_foundation() &&
          level.materials == materials && level.mesh == mesh)
        return &level;
    return nullptr;
  }



  // The finest mesh of the materials that are refined; if these could not be
  // solved for, the richest model that could.
  const ModelLevel *
  ModelChoice::best() const
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
  ModelChoice::sufficient() const
  {
    for (const ModelLevel &level : tried)
      if (is_sufficient(level))
        return &level;
    return nullptr;
  }



  double
  ModelChoice::linearisation_error() const
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



  // The error of the finest mesh from its neighbours, that of the others from
  // how far they are from it.
  void
  ModelChoice::estimate_errors()
  {
    std::vector<double> differences;
    for (unsigned int mesh = 1; find(refined, mesh) != nullptr; ++mesh)
      differences.push_back(largest_difference(find(refined, mesh - 1)->rows,
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



  const ModelLevel *
  ModelChoice::answer() const
  {
    return sufficient() != nullptr ? sufficient() : best();
  }



  std::string
  ModelChoice::reason() const
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
      estimate = "the curves of its meshes give no estimate of the error: they "
                 "do not converge, are off by more than the largest torque or "
                 "have no angle beyond zero in common";
    return "the tolerance of " + percent(tolerance) +
           " was not reached: " + estimate + "; " + why_no_further;
  }
} // namespace Debond
