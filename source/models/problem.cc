#include <debond/campaigns/auto_problem.h>
#include <debond/models/closed_form_problem.h>
#include <debond/models/debonding_problem.h>
#include <debond/models/problem.h>
#include <debond/support/input_error.h>

namespace Debond
{
  std::unique_ptr<Problem>
  Problem::create(const Scene &scene)
  {
    return create(scene, nullptr);
  }



  std::unique_ptr<Problem>
  Problem::create(const Scene &scene, std::shared_ptr<BodyPair> bodies)
  {
    try
      {
        if (scene.model == ModelKind::finite_elements)
          return std::make_unique<DebondingProblem>(scene, std::move(bodies));
        if (scene.model == ModelKind::automatic)
          return std::make_unique<AutoProblem>(scene);
        return std::make_unique<ClosedFormProblem>(scene);
      }
    catch (const InputError &error)
      {
        throw scene.with_place(error);
      }
  }
} // namespace Debond
