#ifndef debond_support_ranks_h
#define debond_support_ranks_h

#include <Eigen/Core>
#include <mpi.h>

#include <functional>

namespace Debond
{
  /**
   * The processes that solve one scene together, started by `mpirun` or `srun`.
   * Each does the same; what is dealt out among them is said where it is. A
   * process by itself is the only rank, and does without MPI until something
   * asks for the communicator.
   *
   * Functions that all ranks have to call at the same time are collective. What
   * they return is the same on all ranks.
   */
  namespace Ranks
  {
    /** Whether this process is one of several that MPI has started. */
    bool
    are_launched();
    /** Initialises MPI, if that has not been done. */
    void
    start();
    /** The last thing that a program does: ends MPI, if it has been started. */
    void
    finish();

    MPI_Comm
    communicator();
    unsigned int
    number();
    unsigned int
    own();
    /** Whether this rank speaks for all: it writes files and lines. */
    inline bool
    is_first()
    {
      return own() == 0;
    }
    /** How many ranks share the processors and the memory of this machine. */
    unsigned int
    number_on_this_machine();

    /** Sums over all ranks, in place. Collective. */
    void
    add_up(double *values, std::size_t n);
    template <typename Derived>
    void
    add_up(Eigen::PlainObjectBase<Derived> &values)
    {
      add_up(values.data(), values.size());
    }
    double
    sum(double value);
    /** The largest of all ranks, in place, one by one. Collective. */
    void
    take_largest(double *values, std::size_t n);
    /** Waits for all. Collective. */
    void
    meet();

    /** Deals all ranks out in groups of @p size that follow each other. While
     *  such an object lives all other functions speak of the own group, which
     *  has a first rank of its own. Collective over all; where an exception
     *  ends it nothing waits for other ranks. */
    class Groups
    {
    public:
      explicit Groups(unsigned int size);
      Groups(const Groups &) = delete;
      ~Groups();

    private:
      MPI_Comm group;
    };

    /** Does some @p work of each rank's own. Where it throws an InputError on
     *  some of them, which others would wait for in vain, all throw that of the
     *  first of these. Collective. */
    void
    in_agreement(const std::function<void()> &work);

    /** Ends all ranks, with an exit code. */
    [[noreturn]] void
    end_all(int code);
  } // namespace Ranks
} // namespace Debond
#endif
