#pragma once

#include <string>

namespace Debond
{
  /** Remembers which signals are ignored, as SIGHUP below nohup. Libraries may
   *  catch them while they are loaded, as UCX does: before that. */
  void
  remember_ignored_signals();

  /** Before another program takes the place of this one: what libraries have
   *  caught would be lost. */
  void
  ignore_again_what_was_ignored();

  /** From now on SIGINT, SIGTERM, SIGHUP and SIGUSR1, but for those that are
   * ignored, only ask to stop; a second one ends the process at once. */
  void
  catch_interruptions();

  /** For the processes of a study: what a terminal sends to all of them is for
   *  the one that started them; SIGTERM ends them at once, and so does the end
   *  of that one. */
  void
  leave_interruptions_to_parent();

  /** The signal that has asked to stop; 0: none. */
  int
  interrupting_signal();

  /** The same on all ranks, which a signal reaches one after the other.
   *  Collective. */
  int
  interrupting_signal_of_any();

  /** "SIGTERM". */
  std::string
  signal_name(int signal);

  /** What poll() can wait for: it becomes readable when a signal asks to stop.
   *  -1 if none is caught. */
  int
  interruption_descriptor();
} // namespace Debond
