#ifndef debond_runtime_h
#define debond_runtime_h

namespace Debond
{
  /**
   * What a program does once before it uses this library: one thread, because
   * the dense systems here are too small for more (two BLAS threads on a busy
   * machine turn 0.7 ms into 16 ms), and errors inside deal.II as exceptions
   * without stack trace instead of an abort.
   */
  void
  set_up_libraries();

  /** Largest memory that this process has held so far [MB]. */
  double
  peak_memory_MB();
} // namespace Debond
#endif
