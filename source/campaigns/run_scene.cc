#include <debond/campaigns/model_choice.h>
#include <debond/campaigns/run_scene.h>
#include <debond/models/closed_form_solution.h>
#include <debond/models/debonding_problem.h>
#include <debond/output/curve_comparison.h>
#include <debond/support/input_error.h>
#include <debond/support/ranks.h>

#include <deal.II/base/timer.h>

namespace Debond
{
  void
  run_scene(const Scene              &scene,
            std::shared_ptr<BodyPair> bodies,
            std::ostream *const       plan)
  {
    const dealii::Timer clock;
    scene.require_same_on_all_ranks();
    if (plan != nullptr && scene.model != ModelKind::finite_elements)
      for (const Warning &warning : scene.warnings())
        *plan << "warning: " << warning.text << '\n';
    if (plan != nullptr)
      if (const std::string line = scene.values_of_the_paper(); !line.empty())
        *plan << line << '\n';
    try
      {
        if (plan != nullptr)
          for (const std::string &doubt : doubts_of_reference(scene))
            *plan << "warning: " << doubt << '\n';
        if (scene.model == ModelKind::finite_elements)
          {
            DebondingProblem problem(scene, std::move(bodies));
            plan != nullptr ? problem.check(*plan) : problem.run();
          }
        else if (scene.model == ModelKind::automatic && Ranks::number() > 1)
          throw EntryError("Model",
                           "auto runs in one process: expected finite "
                           "elements, or one process");
        else if (scene.model == ModelKind::automatic)
          plan != nullptr ? check_auto(scene, *plan) : run_auto(scene);
        else
          {
            const ClosedFormSolution solution(scene);
            plan != nullptr ? describe(solution, *plan) :
                              write_results(solution, clock);
          }
      }
    catch (const InputError &error)
      {
        throw scene.with_place(error); // what is said of the scene gets a place
      }
  }
} // namespace Debond
