#include <debond/campaigns/run_scene.h>
#include <debond/campaigns/variant_queue.h>
#include <debond/models/debonding_problem.h>
#include <debond/models/resumed_run.h>
#include <debond/scene/scene.h>
#include <debond/shapes/modulus_field.h>
#include <debond/support/interruption.h>
#include <debond/support/number_text.h>
#include <debond/support/ranks.h>
#include <debond/support/runtime.h>
#include <debond/system/coupled_system.h>
#include <debond/system/memory_estimate.h>

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/timer.h>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <regex>
#include <system_error>
#include <thread>

namespace Debond
{
  std::string
  what_bodies_depend_on(const Scene &scene)
  {
    // a process that has begun with MPI may not fork
    if (scene.model != ModelKind::finite_elements ||
        (Ranks::number() == 1 && scene.bulk_solver() == BulkSolver::multigrid))
      return "";
    static const std::regex of_bodies(
      "(Bone|Implant) / [^/]*|Interface / (Slave|Quadrature points)");
    std::string text;
    Chuck       chuck(scene.chuck,
                scene.chuck.place(scene.implant.chuck_height()),
                scene.implant.characteristic_radius());
    chuck.place(scene.load_steps.times.front());
    for (const double q : chuck.position())
      text += to_text(q, 17) + " ";
    // which depends on motion, loads and path, too
    text += std::to_string(int(scene.bulk_solver())) + "\n";
    for (const SceneEntry &entry :
         read_scene_text(scene.completed_parameters, scene.name))
      {
        const std::string name = entry.full_name();
        if (std::regex_match(name, of_bodies))
          text += name + " = " + entry.value + "\n";
      }
    if (scene.bone.modulus && scene.bone.modulus->voxels())
      text += scene.bone.modulus->voxels()->identity;
    return text;
  }



  namespace
  {
    /** The bodies of a scene, condensed on what contact reaches at first; none
     *  if that is impossible. In a thread of its own that has ended: what TBB
     *  keeps for a thread, here that there is but one, would stay with this one
     *  and go on in the processes that it starts. */
    std::shared_ptr<BodyPair>
    condensed_bodies(Scene scene)
    {
      scene.interface.bonding      = {}; // that is not the bodies'
      const unsigned int n_threads = dealii::MultithreadInfo::n_threads();
      set_number_of_threads(1);
      std::shared_ptr<BodyPair> bodies;
      std::thread([&] {
        set_number_of_threads(1);
        try
          {
            require_memory(scene, scene.output.fields_every > 0, false);
            dealii::Timer clock;
            CoupledSystem system(scene);
            system.start(scene.load_steps.times.front());
            system.bodies()->seconds_shared = clock.wall_time();
            bodies                          = system.bodies();
          }
        catch (const std::exception &)
          {} // the variants will meet it again, and say so
      }).join();
      set_number_of_threads(n_threads);
      return bodies;
    }
  } // namespace



  void
  VariantQueue::add(const unsigned int variant,
                    const Scene       &scene,
                    const bool         may_share)
  {
    const std::string  key = may_share ? what_bodies_depend_on(scene) : "";
    const unsigned int group =
      group_of.emplace(key, group_of.size()).first->second;
    waiting.insert({group, {variant, key.empty() ? nullptr : &scene}});
  }



  VariantQueue::Next
  VariantQueue::next()
  {
    const auto [group, first] = *waiting.begin();
    if (group != last_group)
      {
        bodies.reset(); // before there are others
        if (first.second != nullptr &&
            waiting.count(group) >= std::max(2U, n_jobs))
          bodies = condensed_bodies(*first.second);
        last_group = group;
      }
    waiting.erase(waiting.begin());
    const Next result{first.first, bodies};
    if (waiting.find(group) == waiting.end())
      bodies.reset();
    return result;
  }



  void
  run_variant(const Scene &scene, const std::shared_ptr<BodyPair> &bodies)
  {
    const bool without = scene.model != ModelKind::finite_elements ||
                         scene.output.overwrite_other_results;
    if (const auto checkpoint = without ? std::nullopt : find_checkpoint(scene))
      try
        {
          return DebondingProblem(scene, bodies).run(&*checkpoint);
        }
      catch (const ForeignCheckpoint &) // of groups, or from before them
        {
          if (bodies)
            bodies->return_to_rest();
        }
    // a checkpoint that is of no use is not kept; the study has made sure
    // that there are no results of another scene
    Scene anew                          = scene;
    anew.output.overwrite_other_results = true;
    run_scene(anew, bodies);
  }



  namespace
  {
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
      try
        {
          if (std::freopen("/dev/null", "w", stdout) == nullptr)
            throw RunError("cannot redirect the output");
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



    /** Throws what went wrong in the last call of @p function, but for a
     *  signal that has interrupted it: then it is to be made again. */
    void
    throw_system_error(const char *const function)
    {
      if (errno != EINTR)
        throw std::system_error(errno, std::generic_category(), function);
    }
  } // namespace



  VariantProcess
  start_process(const unsigned int               variant,
                const Scene                     &scene,
                const std::shared_ptr<BodyPair> &bodies)
  {
    std::signal(SIGCHLD, SIG_DFL); // ignored, it leaves nothing to wait for
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
    return {variant, process, pipe_ends[0]};
  }



  std::vector<VariantProcess>::iterator
  wait_for_one(std::vector<VariantProcess> &processes)
  {
    std::vector<pollfd> waiting{{interruption_descriptor(), POLLIN, 0}};
    for (const VariantProcess &process : processes)
      waiting.push_back({process.read_end, POLLIN, 0});
    while (poll(waiting.data(), waiting.size(), -1) < 0)
      throw_system_error("poll");
    if (interrupting_signal() != 0)
      return processes.end();
    const auto ended =
      std::find_if(waiting.begin() + 1, waiting.end(), [](const pollfd &one) {
        return one.revents != 0;
      });
    return processes.begin() + (ended - waiting.begin() - 1);
  }



  std::string
  end_of(const VariantProcess &process)
  {
    std::string words;
    char        buffer[4096];
    for (ssize_t n; (n = read(process.read_end, buffer, sizeof(buffer))) > 0;)
      words.append(buffer, n);
    close(process.read_end);
    int status = 0;
    while (waitpid(process.id, &status, 0) < 0)
      throw_system_error("waitpid");
    return WIFSIGNALED(status) ?
             std::string("the process was ended by the system: ") +
               strsignal(WTERMSIG(status)) :
             words;
  }
} // namespace Debond
