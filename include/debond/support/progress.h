#pragma once

#include <chrono>
#include <string>

namespace Debond
{
  /** To be called by a program whose standard output is a terminal: from here
   *  on Progress shows a line there, which whatever else is written to
   *  std::cout replaces. Without it nothing is shown. */
  void
  show_progress_on_terminal();

  /** Whether there is such a line, so that others need not be written. */
  bool
  progress_is_shown();

  /** Takes the line away. */
  void
  hide_progress();

  /** How far something is that takes its time. */
  class Progress
  {
  public:
    Progress()
      : start(std::chrono::steady_clock::now())
    {}

    /** Replaces the line, not more often than eyes can follow: @p what with a
     *  bar and the time that is left if the @p fraction that is done is known,
     *  which is not negative then. */
    void
    show(const std::string &what, double fraction);

  private:
    std::chrono::steady_clock::time_point start, last_shown;
    double first_fraction = -1.; ///< what was done before is no measure of pace
  };
} // namespace Debond
