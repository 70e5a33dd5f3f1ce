#include <debond/campaigns/model_choice.h>
#include <debond/models/curve_error.h>
#include <debond/models/foundation_error.h>
#include <debond/models/memory_estimate.h>
#include <debond/support/input_error.h>
#include <debond/support/interruption.h>

#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace Debond
{
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
    , ladder(scene, share_of_steps * tolerance)
    , step_error(reserve_of_steps * share_of_steps * tolerance)
    , refined(ladder.materials().back())
  {
    refuse_what_has_no_curve(scene);
  }



  void
  ModelChoice::climb(const std::function<void(Rung &)>       &run,
                     const std::function<void(const Rung &)> &report)
  {
    const auto run_and_report = [&](Rung rung) {
      try_rung(std::move(rung), run);
      report(tried.back());
    };
    run_and_report(ladder.foundation(1));
    for (const Materials &materials : ladder.materials())
      if (sufficient() == nullptr)
        run_and_report(ladder.finite_elements(tried.size() + 1, materials, 0));
    if (linearisation_error() <= share_of_linearisation * tolerance)
      refined = ladder.linear_materials();
    unsigned int mesh = 0;
    while (sufficient() == nullptr && why_no_further.empty())
      {
        while (find(refined, mesh) != nullptr)
          ++mesh;
        why_no_further = mesh == 0 ?
                           "the scene's own bodies could not be solved for" :
                           ladder.limit(refined, mesh);
        if (!why_no_further.empty())
          return;
        run_and_report(ladder.finite_elements(tried.size() + 1, refined, mesh));
        if (!tried.back().done)
          why_no_further = "the next mesh " + tried.back().why_not;
      }
  }



  void
  ModelChoice::try_rung(Rung rung, const std::function<void(Rung &)> &run)
  {
    const dealii::Timer timer;
    try
      {
        run(rung);
        rung.done = true;
      }
    catch (const Interrupted &interruption)
      {
        throw Interrupted(interruption.signal,
                          "interrupted by " + signal_name(interruption.signal) +
                            " in rung " + std::to_string(tried.size() + 1) +
                            ": Model = auto keeps no checkpoints");
      }
    catch (const WriteError &)
      {
        throw;
      }
    catch (const InputError &error)
      {
        // of other mistakes of the scene every rung would complain
        if (!rung.is_foundation() &&
            dynamic_cast<const NotEnoughMemory *>(&error) == nullptr)
          throw;
        rung.why_not = std::string("refused: ") + error.what();
      }
    catch (const std::exception &error)
      {
        rung.why_not = std::string("failed: ") + error.what();
      }
    rung.seconds = timer.wall_time();
    tried.push_back(std::move(rung));
    estimate_errors();
  }



  double
  ModelChoice::foundation_estimate(const Rung                &foundation,
                                   const FoundationStiffness &stiffness) const
  {
    double      ratio   = 0.; // of the sizes of cells
    const Scene coarser = ladder.below_coarsest(ratio);
    if (ratio < smallest_cell_ratio)
      return Rung::undefined; // nothing to compare the mesh with
    return step_error + foundation_error(foundation.scene,
                                         foundation.rows,
                                         stiffness,
                                         foundation_stiffness(coarser),
                                         ratio);
  }



  const Rung *
  ModelChoice::find(const Materials &materials, const unsigned int mesh) const
  {
    for (const Rung &rung : tried)
      if (rung.done && !rung.is_foundation() && rung.materials == materials &&
          rung.mesh == mesh)
        return &rung;
    return nullptr;
  }



  // The finest mesh of the materials that are refined; if these could not be
  // solved for, the richest model that could.
  const Rung *
  ModelChoice::best() const
  {
    const bool  is_solved = find(refined, 0) != nullptr;
    const Rung *best      = nullptr;
    for (const Rung &rung : tried)
      if (rung.done &&
          (!is_solved || (rung.materials == refined && !rung.is_foundation())))
        best = &rung;
    return best;
  }



  const Rung *
  ModelChoice::sufficient() const
  {
    for (const Rung &rung : tried)
      if (is_sufficient(rung))
        return &rung;
    return nullptr;
  }



  double
  ModelChoice::linearisation_error() const
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
  ModelChoice::estimate_errors()
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
    for (Rung &rung : tried)
      if (rung.done)
        {
          rung.difference =
            &rung == finest ? 0. : largest_difference(rung.rows, finest->rows);
          // the largest torque may itself be less by the error
          rung.estimate = error < 1. ? rung.difference / (1. - error) + error :
                                       Rung::undefined;
        }
  }



  const Rung *
  ModelChoice::answer() const
  {
    return sufficient() != nullptr ? sufficient() : best();
  }



  std::string
  ModelChoice::reason() const
  {
    const Rung *const answer = this->answer();
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
