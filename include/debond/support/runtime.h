#ifndef debond_support_runtime_h
#define debond_support_runtime_h

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

  /** While it lives, BLAS uses all these threads. */
  class ThreadedBlas
  {
  public:
    explicit ThreadedBlas(bool wanted);
    ~ThreadedBlas();
    ThreadedBlas(const ThreadedBlas &) = delete;
    ThreadedBlas &
    operator=(const ThreadedBlas &) = delete;
  };

  /** Largest memory that this process has held so far [MB]. */
  double
  peak_memory_MB();
} // namespace Debond
#endif
