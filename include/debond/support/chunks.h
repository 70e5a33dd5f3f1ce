#ifndef debond_support_chunks_h
#define debond_support_chunks_h

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/parallel.h>

namespace Debond
{
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
} // namespace Debond
#endif
