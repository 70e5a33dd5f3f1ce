#include <debond/support/input_error.h>
#include <debond/support/ranks.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <vector>

// MPI where there is more than one process, or a library that works with it.
// Initialising it takes 0.3 s, as long as whole runs of this program, so that
// a process by itself does not do it before it has to.
namespace Debond
{
  namespace
  {
    // Not ended with the static objects: those of other libraries may be gone.
    dealii::Utilities::MPI::MPI_InitFinalize *mpi = nullptr;

    /** Of the group that this process belongs to for the time being. */
    MPI_Comm at_work = MPI_COMM_NULL;

    unsigned int n_here = 1; ///< processes on this machine



    int
    number_in_environment(const char *const name)
    {
      const char *const text = std::getenv(name);
      return text == nullptr ? 0 : std::atoi(text);
    }
  } // namespace



  namespace Ranks
  {
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
      if (mpi)
        return;
      static int    n_arguments = 1;
      static char   name[]      = "debond";
      static char  *words[]     = {name, nullptr};
      static char **arguments   = words;
      mpi                       = new dealii::Utilities::MPI::MPI_InitFinalize(
        n_arguments, arguments, dealii::MultithreadInfo::n_threads());
      at_work = MPI_COMM_WORLD;
      MPI_Comm here;
      MPI_Comm_split_type(
        MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
      n_here = dealii::Utilities::MPI::n_mpi_processes(here);
      MPI_Comm_free(&here);
    }



    void
    finish()
    {
      delete mpi;
      mpi = nullptr;
    }



    MPI_Comm
    communicator()
    {
      start();
      return at_work;
    }



    unsigned int
    number()
    {
      return mpi ? dealii::Utilities::MPI::n_mpi_processes(at_work) : 1;
    }



    unsigned int
    own()
    {
      return mpi ? dealii::Utilities::MPI::this_mpi_process(at_work) : 0;
    }



    unsigned int
    number_on_this_machine()
    {
      return n_here;
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



    void
    take_largest(double *const values, const std::size_t n)
    {
      if (number() > 1)
        MPI_Allreduce(
          MPI_IN_PLACE, values, n, MPI_DOUBLE, MPI_MAX, communicator());
    }



    void
    meet()
    {
      if (number() > 1)
        MPI_Barrier(communicator());
    }



    Groups::Groups(const unsigned int size)
    {
      const int rank = own();
      MPI_Comm_split(MPI_COMM_WORLD, rank / size, rank, &group);
      at_work = group;
    }



    Groups::~Groups()
    {
      at_work = MPI_COMM_WORLD;
      if (std::uncaught_exceptions() == 0)
        MPI_Comm_free(&group);
    }



    void
    in_agreement(const std::function<void()> &work)
    {
      if (number() == 1)
        return work();
      std::vector<std::string> own_words; // of an error, one or four
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
      for (const auto &words :
           dealii::Utilities::MPI::all_gather(communicator(), own_words))
        if (words.size() == 1)
          throw InputError(words[0]);
        else if (words.size() == 4)
          throw EntryError(words[0],
                           words[1],
                           words[2].empty() ?
                             std::nullopt :
                             std::optional<std::string>(words[2]),
                           words[3]);
    }



    void
    end_all(const int code)
    {
      MPI_Abort(MPI_COMM_WORLD, code);
      std::abort();
    }
  } // namespace Ranks
} // namespace Debond
