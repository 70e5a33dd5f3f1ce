#include <debond/campaigns/auto_model.h>
#include <debond/campaigns/run_scene.h>
#include <debond/models/closed_form_results.h>
#include <debond/models/debonding_problem.h>
#include <debond/support/input_error.h>

#include <deal.II/base/timer.h>

#include <utility>

namespace Debond
{
  namespace
  {
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
