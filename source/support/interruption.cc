#include <debond/support/interruption.h>
#include <debond/support/ranks.h>

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace Debond
{
  namespace
  {
    volatile std::sig_atomic_t arrived = 0;
    bool                       is_ignored[NSIG]; // when the program began
    /** A pipe, because a signal may be handled by any thread and need not
     *  interrupt what the main one waits for. */
    int pipe_ends[2] = {-1, -1};



    // Calls nothing but what a signal handler may call.
    void
    handle(const int signal)
    {
      const int reason = errno;
      if (arrived != 0)
        {
          std::signal(signal, SIG_DFL);
          std::raise(signal);
        }
      arrived                                = signal;
      [[maybe_unused]] const ssize_t ignored = write(pipe_ends[1], "", 1);
      errno                                  = reason;
    }
  } // namespace



  void
  remember_ignored_signals()
  {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1})
      {
        struct sigaction action = {};
        sigaction(signal, nullptr, &action);
        is_ignored[signal] = action.sa_handler == SIG_IGN;
      }
  }



  void
  catch_interruptions()
  {
    if (pipe_ends[0] < 0 && pipe2(pipe_ends, O_CLOEXEC | O_NONBLOCK) != 0)
      return; // then signals end the process as they always do
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1})
      {
        struct sigaction action = {};
        sigaction(signal, nullptr, &action);
        if (action.sa_handler == SIG_IGN || is_ignored[signal])
          {
            std::signal(signal, SIG_IGN); // nohup
            continue;
          }
        action.sa_handler = handle;
        action.sa_flags   = SA_RESTART;
        sigaction(signal, &action, nullptr);
      }
  }



  void
  ignore_again_what_was_ignored()
  {
    for (int signal = 1; signal < NSIG; ++signal)
      if (is_ignored[signal])
        std::signal(signal, SIG_IGN);
  }



  void
  leave_interruptions_to_parent()
  {
    prctl(PR_SET_PDEATHSIG, SIGKILL); // nor does it outlive that
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGHUP, SIG_IGN);
    std::signal(SIGUSR1, SIG_IGN);
    std::signal(SIGTERM, SIG_DFL);
  }



  int
  interrupting_signal()
  {
    return arrived;
  }



  int
  interrupting_signal_of_any()
  {
    return static_cast<int>(Ranks::largest(arrived));
  }



  std::string
  signal_name(const int signal)
  {
    return "SIG" + std::string(sigabbrev_np(signal));
  }



  int
  interruption_descriptor()
  {
    return pipe_ends[0];
  }
} // namespace Debond
