#pragma once

#include <Eigen/Core>
#include <mpi.h>

#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/**
 * The processes that solve one scene together. Each does the same; what is
 * dealt out among them is said where it is.
 *
 * Which they are is said by who uses this library, before a scene is read: a
 * process works alone, as the only rank, whatever has started it, until a
 * Together names others. It does without MPI until something asks for the
 * communicator. Whoever has initialised MPI ends it: if that was this
 * library, it does so when the program exits.
 *
 * Functions that all ranks have to call at the same time are collective. What
 * they return is the same on all ranks.
 */
namespace Debond::Ranks
{
  /** Processes that work together; null: this one by itself. */
  struct Team;
  using TeamPointer = std::shared_ptr<const Team>;

  /** The processes of @p communicator, which may be freed afterwards.
   *  Collective over these. Throws InputError if it is none, or if MPI has
   *  not been initialised. */
  TeamPointer
  make_team(MPI_Comm communicator);
  /** That of this thread at present. */
  TeamPointer
  team();

  /** While such an object lives the functions below, called by the same
   *  thread, speak of its team. */
  class Together
  {
  public:
    explicit Together(TeamPointer team);
    explicit Together(const MPI_Comm communicator)
      : Together(make_team(communicator))
    {}
    Together(const Together &) = delete;
    ~Together();

  private:
    const TeamPointer before;
  };

  /** Whether this process is one of several that MPI has started. */
  bool
  are_launched();
  /** What a program does that takes all processes of `mpirun`: initialises
   *  MPI, if that has not been done, and lets all work together. */
  void
  start();
  /** The last thing that such a program does: ends MPI, if start() or the
   *  need of a communicator has begun it. */
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
  /** The largest of all ranks. Collective. */
  double
  largest(double value);
  /** Waits for all. Collective. */
  void
  meet();

  /** Does some @p work of each rank's own. Where it throws an InputError on
   *  some of them, which others would wait for in vain, all throw that of the
   *  first of these. Where it throws something else, the others throw a
   *  RunError that says so. Collective. */
  void
  in_agreement(const std::function<void()> &work);

  /** Whether all ranks meet what has been thrown. What one of several meets
   *  alone, a full disk or a lack of memory, the others wait for in vain. */
  bool
  all_meet(const std::exception_ptr &thrown);

  /** The @p texts of the first rank. Collective. */
  std::vector<std::string>
  of_first(const std::vector<std::string> &texts);

  /** Ends all ranks, with an exit code. */
  [[noreturn]] void
  end_all(int code);
} // namespace Debond::Ranks
