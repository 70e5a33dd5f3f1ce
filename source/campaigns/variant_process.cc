#include <debond/campaigns/run_scene.h>
#include <debond/campaigns/variant_process.h>
#include <debond/models/debonding_problem.h>
#include <debond/models/memory_estimate.h>
#include <debond/models/resumed_run.h>
#include <debond/support/interruption.h>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <vector>

namespace Debond
{
  namespace
  {
    /** From the checkpoint of a run that was ended, if it left one. */
    void
    run_variant(const Scene &scene, const std::shared_ptr<BodyPair> &bodies)
    {
      const bool without = scene.model != ModelKind::finite_elements ||
                           scene.output.overwrite_other_results;
      if (const auto checkpoint =
            without ? std::nullopt : find_checkpoint(scene))
        return DebondingProblem(scene, bodies).resume(*checkpoint);
      // a checkpoint that is of no use is not kept; the study has made sure
      // that there are no results of another scene
      Scene anew                          = scene;
      anew.output.overwrite_other_results = true;
      run_scene(anew, bodies);
    }



    /** What a child process does: it ends with the message on the pipe, an
     *  empty one if all went well. */
    [[noreturn]] void
    run_in_child(const Scene                     &scene,
                 const std::shared_ptr<BodyPair> &bodies,
                 const int                        write_end)
    {
      // a variant does not outlive its study
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      leave_interruptions_to_parent();
      std::string message;
      if (std::freopen("/dev/null", "w", stdout) == nullptr)
        message = "cannot redirect the output";
      try
        {
          if (message.empty())
            run_variant(scene, bodies);
        }
      catch (const std::bad_alloc &)
        {
          message = out_of_memory;
        }
      catch (const std::exception &error)
        {
          message = error.what();
        }
      dprintf(write_end, "%s", message.c_str());
      _exit(message.empty() ? 0 : 1);
    }



    /** Throws what went wrong in the last call of @p function. */
    [[noreturn]] void
    throw_system_error(const char *const function)
    {
      throw std::system_error(errno, std::generic_category(), function);
    }



    /** Waits for the end of a process. Returns its last words. */
    std::string
    end_of(const pid_t process, const int read_end)
    {
      std::string words;
      char        buffer[4096];
      for (ssize_t n; (n = read(read_end, buffer, sizeof(buffer))) > 0;)
        words.append(buffer, n);
      close(read_end);
      int status = 0;
      while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR)
          throw_system_error("waitpid");
      return WIFSIGNALED(status) ?
               std::string("the process was ended by the system: ") +
                 strsignal(WTERMSIG(status)) :
               words;
    }
  } // namespace



  VariantProcesses::VariantProcesses()
  {
    std::signal(SIGCHLD,
                SIG_DFL); // ignored, it would leave nothing to wait for
  }



  void
  VariantProcesses::start(const unsigned int               variant,
                          const Scene                     &scene,
                          const std::shared_ptr<BodyPair> &bodies)
  {
    int pipe_ends[2];
    if (pipe(pipe_ends) != 0)
      throw_system_error("pipe");
    const pid_t process = fork();
    if (process < 0)
      throw_system_error("fork");
    if (process == 0)
      {
        close(pipe_ends[0]);
        run_in_child(scene, bodies, pipe_ends[1]);
      }
    close(pipe_ends[1]);
    jobs[process] = {variant, pipe_ends[0]};
  }



  std::optional<VariantProcesses::Ended>
  VariantProcesses::wait_for_one()
  {
    std::vector<pollfd> waiting{{interruption_descriptor(), POLLIN, 0}};
    for (const auto &job : jobs)
      waiting.push_back({job.second.read_end, POLLIN, 0});
    while (poll(waiting.data(), waiting.size(), -1) < 0)
      if (errno != EINTR)
        throw_system_error("poll");
    if (interrupting_signal() != 0)
      return std::nullopt;
    auto job = jobs.begin();
    for (auto one = waiting.begin() + 1; one->revents == 0; ++one)
      ++job;
    const Ended ended{job->second.variant,
                      end_of(job->first, job->second.read_end)};
    jobs.erase(job);
    return ended;
  }



  void
  VariantProcesses::stop()
  {
    for (const auto &[process, job] : jobs)
      {
        kill(process, SIGTERM);
        end_of(process, job.read_end);
      }
    jobs.clear();
  }
} // namespace Debond
