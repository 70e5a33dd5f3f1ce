#ifndef debond_support_timed_section_h
#define debond_support_timed_section_h

#include <deal.II/base/timer.h>

#include <optional>
#include <string>

namespace Debond
{
  /** From here to the end of the block, seconds go to a section of a timer if
   *  there is one. Nothing that is computed depends on it. */
  class TimedSection
  {
  public:
    TimedSection(dealii::TimerOutput *const timer, const std::string &name)
    {
      if (timer != nullptr)
        scope.emplace(*timer, name);
    }

  private:
    std::optional<dealii::TimerOutput::Scope> scope;
  };
} // namespace Debond
#endif
