#include <debond/support/input_error.h>
#include <debond/support/ranks.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <unistd.h>

#include <cstdlib>
#include <mutex>
#include <optional>

// MPI where there is more than one process, or a library that works with it.
// Initialising it takes 0.3 s, as long as whole runs of this program, so that
// a process by itself does not do it before it has to. Who uses the library may
// have done so, and may do so later; deal.II's MPI_InitFinalize, which wants to
// be the only one, is of no use here.
namespace Debond::Ranks
{
  namespace
  {
    bool
    says_yes(int (*const question)(int *))
    {
      int answer = 0;
      question(&answer);
      return answer != 0;
    }



    pid_t process_that_initialised = 0;



    // Called when the program exits, before the static objects of the libraries
    // go, or earlier by finish(). A process that was forked from this one has
    // nothing to end.
    void
    finalise()
    {
      if (process_that_initialised == getpid() && !says_yes(MPI_Finalized))
        MPI_Finalize();
    }



    // @p threads: what MPI calls the level of their support.
    void
    initialise(const int threads)
    {
      static std::mutex                 mutex;
      const std::lock_guard<std::mutex> guard(mutex);
      if (says_yes(MPI_Finalized))
        throw InputError("MPI has been finalised, and cannot be started again: "
                         "run what needs it before (several processes, or "
                         "Expert / Bone / Solver = multigrid)");
      if (says_yes(MPI_Initialized))
        return;
      int provided = 0;
      MPI_Init_thread(nullptr, nullptr, threads, &provided);
      process_that_initialised = getpid();
      std::atexit(finalise);
    }



    int
    number_in_environment(const char *const name)
    {
      const char *const text = std::getenv(name);
      return text == nullptr ? 0 : std::atoi(text);
    }



    // Of a thread, since several may run a scene each. Those that help one
    // with its loops ask nothing of this file.
    thread_local Ranks::TeamPointer at_work;
  } // namespace



  // A communicator of its own, so that messages of the caller are not taken
  // for those of a run, and none is lost without a word: those of mpi4py
  // return errors, which Trilinos does not look at.
  struct Team
  {
    /** Takes over @p communicator. @p n_here: number_on_this_machine(), 0 to
     *  count. */
    explicit Team(const MPI_Comm communicator, const unsigned int n_here = 0)
      : communicator(communicator)
      , number(dealii::Utilities::MPI::n_mpi_processes(communicator))
      , own(dealii::Utilities::MPI::this_mpi_process(communicator))
      , n_here(n_here > 0 ? n_here : count_here())
    {
      MPI_Comm_set_errhandler(communicator, MPI_ERRORS_ARE_FATAL);
    }
    Team(const Team &) = delete;

    // Others may not get here where an exception ends it.
    ~Team()
    {
      MPI_Comm mine = communicator;
      if (std::uncaught_exceptions() == 0 && !says_yes(MPI_Finalized))
        MPI_Comm_free(&mine);
    }

    unsigned int
    count_here() const
    {
      MPI_Comm here;
      MPI_Comm_split_type(
        communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
      const unsigned int n = dealii::Utilities::MPI::n_mpi_processes(here);
      MPI_Comm_free(&here);
      return n;
    }

    const MPI_Comm     communicator;
    const unsigned int number, own, n_here;
  };



  TeamPointer
  make_team(const MPI_Comm communicator)
  {
    if (!says_yes(MPI_Initialized) || says_yes(MPI_Finalized))
      throw InputError("processes can solve a scene together only between "
                       "MPI_Init and MPI_Finalize");
    int is_between_groups = 0;
    if (communicator != MPI_COMM_NULL)
      MPI_Comm_test_inter(communicator, &is_between_groups);
    if (communicator == MPI_COMM_NULL || is_between_groups != 0)
      throw InputError("this is no communicator of processes that could "
                       "solve a scene together: expected one within a group, "
                       "to which this process belongs");
    MPI_Comm own;
    MPI_Comm_dup(communicator, &own);
    return std::make_shared<const Team>(own);
  }



  TeamPointer
  team()
  {
    return at_work;
  }



  Together::Together(TeamPointer team)
    : before(at_work)
  {
    at_work = std::move(team);
  }



  Together::~Together()
  {
    at_work = before;
  }



  // Open MPI, MPICH and its relatives, and srun say it each in their way. A
  // script that a batch system started is one process, whatever it has
  // reserved.
  bool
  are_launched()
  {
    return number_in_environment("OMPI_COMM_WORLD_SIZE") > 1 ||
           number_in_environment("PMI_SIZE") > 1 ||
           (number_in_environment("SLURM_STEP_NUM_TASKS") > 1 &&
            std::getenv("SLURM_PROCID") != nullptr);
  }



  void
  start()
  {
    initialise(MPI_THREAD_SERIALIZED);
    at_work = make_team(MPI_COMM_WORLD);
  }



  void
  finish()
  {
    at_work.reset();
    finalise();
  }



  MPI_Comm
  communicator()
  {
    if (at_work)
      return at_work->communicator;
    // others of Python's threads may use MPI at the same time
    initialise(MPI_THREAD_MULTIPLE);
    return MPI_COMM_SELF;
  }



  unsigned int
  number()
  {
    return at_work ? at_work->number : 1;
  }



  unsigned int
  own()
  {
    return at_work ? at_work->own : 0;
  }



  unsigned int
  number_on_this_machine()
  {
    return at_work ? at_work->n_here : 1;
  }



  void
  add_up(double *const values, const std::size_t n)
  {
    if (number() > 1)
      MPI_Allreduce(
        MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_SUM, communicator());
  }



  double
  sum(double value)
  {
    add_up(&value, 1);
    return value;
  }



  double
  largest(const double value)
  {
    return number() > 1 ? dealii::Utilities::MPI::max(value, communicator()) :
                          value;
  }



  void
  meet()
  {
    if (number() > 1)
      MPI_Barrier(communicator());
  }



  void
  in_agreement(const std::function<void()> &work)
  {
    if (number() == 1)
      return work();
    std::vector<std::string> own_words; // of an error: one, two or four
    std::exception_ptr       others_cannot_throw;
    try
      {
        work();
      }
    catch (const EntryError &error)
      {
        own_words = {error.entry,
                     error.why,
                     error.value.value_or(""),
                     error.place};
      }
    catch (const InputError &error)
      {
        own_words = {error.what()};
      }
    catch (const std::exception &error)
      {
        // of Python the traceback follows
        const std::string what = error.what();
        own_words = {std::to_string(own()), what.substr(0, what.find('\n'))};
        others_cannot_throw = std::current_exception();
      }
    if (largest(own_words.size()) == 0.)
      return;
    const auto all_words =
      dealii::Utilities::MPI::all_gather(communicator(), own_words);
    if (others_cannot_throw)
      std::rethrow_exception(others_cannot_throw);
    for (const auto &words : all_words)
      if (words.size() == 1)
        throw InputError(words[0]);
      else if (words.size() == 2)
        throw RunError("rank " + words[0] +
                       " of those that solve together has ended: " + words[1]);
      else if (words.size() == 4)
        throw EntryError(words[0],
                         words[1],
                         words[2].empty() ?
                           std::nullopt :
                           std::optional<std::string>(words[2]),
                         words[3]);
  }



  bool
  all_meet(const std::exception_ptr &thrown)
  {
    if (number() == 1)
      return true;
    try
      {
        std::rethrow_exception(thrown);
      }
    catch (const WriteError &)
      {
        return false;
      }
    catch (const std::exception &error)
      {
        return dynamic_cast<const InputError *>(&error) != nullptr ||
               dynamic_cast<const RunError *>(&error) != nullptr ||
               dynamic_cast<const Interrupted *>(&error) != nullptr;
      }
    catch (...)
      {
        return false;
      }
  }



  std::vector<std::string>
  of_first(const std::vector<std::string> &texts)
  {
    return dealii::Utilities::MPI::broadcast(communicator(), texts);
  }



  void
  end_all(const int code)
  {
    MPI_Abort(communicator(), code);
    std::abort();
  }
} // namespace Debond::Ranks
