#ifndef debond_campaigns_variant_queue_h
#define debond_campaigns_variant_queue_h

#include <sys/types.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Debond
{
  struct BodyPair;
  struct Scene;

  /**
   * The variants of a study that wait to be run, and the bodies that they
   * share: variants that agree in all that their bodies and the condensation on
   * the contact surfaces depend on follow each other, and those bodies are
   * built once, by the process that then starts the variants by fork(), which
   * inherit them (the pages of memory are copied when they change). Results are
   * the same to the last digit.
   *
   * Building takes one thread, whatever the variants use: a pool of threads
   * would not survive fork(). Only the bodies of the last variant are kept.
   */
  class VariantQueue
  {
  public:
    /** @p n_jobs variants run at a time: fewer than that share nothing, because
     *  they would wait for each other. */
    explicit VariantQueue(const unsigned int n_jobs)
      : n_jobs(n_jobs)
    {}

    /** Appends a variant. @p scene must outlive the queue. @p may_share: false
     *  if the seconds of its set-up are of interest. */
    void
    add(unsigned int variant, const Scene &scene, bool may_share);

    bool
    empty() const
    {
      return waiting.empty();
    }

    struct Next
    {
      unsigned int variant;
      /** None if it shares them with no other or if they cannot be built: then
       *  the variant is to build them, and to say what is wrong with them. */
      std::shared_ptr<BodyPair> bodies;
    };
    /** Removes the variant that is to be started next. */
    Next
    next();

  private:
    const unsigned int n_jobs;
    /** By the number of their group, those of a group in the order of add();
     *  none for the scene of one that shares nothing. */
    std::multimap<unsigned int, std::pair<unsigned int, const Scene *>> waiting;
    /** Numbers of the groups by what their scenes agree in. */
    std::map<std::string, unsigned int> group_of;
    unsigned int                        last_group = -1; ///< one that is begun
    std::shared_ptr<BodyPair>           bodies;
  };



  /** What scenes agree in if they can share bodies: what the bodies are, and
   *  where they are when the interface is set up. Empty if the scene shares
   *  them with none. */
  std::string
  what_bodies_depend_on(const Scene &scene);

  /** Runs a variant in this process, from the checkpoint of a run that was
   *  ended, if it left one. */
  void
  run_variant(const Scene &scene, const std::shared_ptr<BodyPair> &bodies);



  /** A process that runs a variant. It does not outlive its study. It leaves
   *  its results in its directory and, if it fails, says why on a pipe. */
  struct VariantProcess
  {
    unsigned int variant;
    pid_t        id;
    int          read_end; ///< of the pipe with its last words
  };

  /** Starts a variant, with bodies that it shares or none; it goes on from the
   *  checkpoint of a run that was ended, if there is one. */
  VariantProcess
  start_process(unsigned int                     variant,
                const Scene                     &scene,
                const std::shared_ptr<BodyPair> &bodies);

  /** Waits until one of them ends; their end() if a signal asks to stop. */
  std::vector<VariantProcess>::iterator
  wait_for_one(std::vector<VariantProcess> &processes);

  /** Waits for the end of a process. Returns why it failed, if it did. */
  std::string
  end_of(const VariantProcess &process);
} // namespace Debond
#endif
