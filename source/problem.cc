#include <debond/closed_form_problem.h>
#include <debond/debonding_problem.h>
#include <debond/problem.h>

namespace Debond
{
  std::unique_ptr<Problem>
  Problem::create(const Scene &scene)
  {
    if (scene.model == ModelKind::finite_elements)
      return std::make_unique<DebondingProblem>(scene);
    return std::make_unique<ClosedFormProblem>(scene);
  }
} // namespace Debond
