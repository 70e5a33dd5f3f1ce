#ifndef debond_campaigns_variant_process_h
#define debond_campaigns_variant_process_h

#include <sys/types.h>

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace Debond
{
  struct BodyPair;
  struct Scene;

  /**
   * The variants of a study that run, each as a process of its own. Such a
   * process does not outlive its study. It leaves its results in its directory
   * and, if it fails, says why on a pipe.
   */
  class VariantProcesses
  {
  public:
    VariantProcesses();

    /** Starts a variant, with bodies that it shares or none; it goes on from
     *  the checkpoint of a run that was ended, if there is one. */
    void
    start(unsigned int                     variant,
          const Scene                     &scene,
          const std::shared_ptr<BodyPair> &bodies);

    /** Number of variants that run. */
    unsigned int
    size() const
    {
      return jobs.size();
    }

    struct Ended
    {
      unsigned int variant;
      std::string  failure; ///< why it failed, if it did
    };
    /** Waits until one of them ends; none if a signal asks to stop. */
    std::optional<Ended>
    wait_for_one();

    /** Asks all of them to end, and waits until they have. */
    void
    stop();

  private:
    struct Job
    {
      unsigned int variant  = 0;
      int          read_end = -1; ///< of the pipe with its last words
    };
    std::map<pid_t, Job> jobs;
  };
} // namespace Debond
#endif
