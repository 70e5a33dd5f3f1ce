#ifndef debond_models_closed_form_results_h
#define debond_models_closed_form_results_h

#include <debond/models/closed_form_solution.h>

#include <iosfwd>

namespace dealii
{
  class Timer;
}

namespace Debond
{
  /** Writes the files of a scene that a closed form has solved into its
   *  directory: those of finite elements, with what closed forms know.
   *  @p clock was started before the solution. */
  void
  write_results(const ClosedFormSolution &solution, const dealii::Timer &clock);

  /** What `--check` says of it. */
  void
  describe(const ClosedFormSolution &solution, std::ostream &out);
} // namespace Debond
#endif
