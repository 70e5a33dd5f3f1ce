#pragma once

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/parallel.h>
#include <deal.II/base/timer.h>

#include <filesystem>
#include <optional>
#include <string>

namespace Debond
{
  /** What a program does once before it uses this library: one thread, and
   *  errors inside deal.II as exceptions without stack trace instead of an
   *  abort, and files that grow beyond a limit as errors of writing. */
  void
  set_up_libraries();

  /** Threads for what follows: loops over points and cells, and the large
   *  dense blocks of a factorisation. Small dense systems always take one (two
   *  BLAS threads on a busy machine turn 0.7 ms into 16 ms). */
  void
  set_number_of_threads(unsigned int n);

  /** Parts that a loop is divided into. Their number does not depend on the
   *  number of threads: sums that are formed part by part, and then added in
   *  the order of the parts, are the same to the last digit for any number of
   *  threads. More than four threads gain nothing here: what takes longest, the
   *  triangular solves, waits for the memory. */
  constexpr unsigned int n_chunks = 4;

  /** Calls work(chunk, first, end) for the parts [first, end) of [0, n), at the
   *  same time as far as there are threads. With one thread it starts no thread
   *  pool, so that the process may fork. */
  template <typename Work>
  void
  for_each_chunk(const unsigned int n, const Work &work)
  {
    const auto work_on = [&](const unsigned int begin, const unsigned int end) {
      for (unsigned int chunk = begin; chunk < end; ++chunk)
        work(chunk,
             std::size_t(n) * chunk / n_chunks,
             std::size_t(n) * (chunk + 1) / n_chunks);
    };
    if (dealii::MultithreadInfo::n_threads() == 1)
      work_on(0, n_chunks);
    else
      dealii::parallel::apply_to_subranges(0U, n_chunks, work_on, 1);
  }

  /** Whether BLAS uses all these threads, or one. */
  void
  thread_blas(bool wanted);

  /** Largest memory that this process has held so far [MB]. */
  double
  peak_memory_MB();

  /** Memory that this process can still take [MB]: the least of what the
   *  machine has left, what a limit of the address space (`ulimit -v`) leaves,
   *  and what control groups leave, in which containers and batch systems
   *  run. */
  double
  available_memory_MB();

  /** What main() returns: @p code. Where the address space is limited it does
   *  not return but ends the program: a thread of OpenBLAS that finds no room
   *  waits for ever, and exit() for it. */
  int
  exit_code(int code);

  /**
   * What the memory limits of control groups leave [MB]: of those that
   * @p groups (/proc/self/cgroup) names and of all that hold them, below
   * @p mount (/sys/fs/cgroup), of version 1 or 2. Cached files are not counted
   * as taken. Infinity if there is no limit.
   */
  double
  memory_within_control_groups_MB(const std::filesystem::path &groups,
                                  const std::filesystem::path &mount);



  /** From here to the end of the block, seconds go to a section of a timer if
   *  there is one. Nothing that is computed depends on it. */
  class TimedSection
  {
  public:
    TimedSection(dealii::TimerOutput *const timer, const std::string &name)
    {
      if (timer != nullptr)
        scope.emplace(*timer, name);
    }

  private:
    std::optional<dealii::TimerOutput::Scope> scope;
  };
} // namespace Debond
