#include <debond/campaigns/variant_process.h>
#include <debond/models/debonding_problem.h>
#include <debond/models/memory_estimate.h>
#include <debond/models/problem.h>
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
#include <stdexcept>
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
      Problem::create(anew, bodies)->run();
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
      const char *text = message.c_str();
      for (std::size_t left = message.size(); left > 0;)
        {
          const ssize_t written = write(write_end, text, left);
          if (written <= 0)
            break;
          text += written;
          left -= written;
        }
      _exit(message.empty() ? 0 : 1);
    }



    std::string
    read_to_end(const int read_end)
    {
      std::string text;
      char        buffer[4096];
      for (ssize_t n; (n = read(read_end, buffer, sizeof(buffer))) > 0;)
        text.append(buffer, n);
      close(read_end);
      return text;
    }



    /** Waits for the end of a process. Returns its last words. */
    std::string
    end_of(const pid_t process, const int read_end)
    {
      std::string words  = read_to_end(read_end);
      int         status = 0;
      while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR)
          throw std::runtime_error(std::string("waitpid: ") +
                                   std::strerror(errno));
      if (WIFSIGNALED(status))
        words = std::string("the process was ended by the system: ") +
                strsignal(WTERMSIG(status));
      return words;
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
      throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
    const pid_t process = fork();
    if (process < 0)
      throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
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
        throw std::runtime_error(std::string("poll: ") + std::strerror(errno));
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
