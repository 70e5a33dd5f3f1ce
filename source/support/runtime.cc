#include <debond/support/runtime.h>

#include <deal.II/base/utilities.h>

#include <csignal>

// Declared here because the headers of OpenBLAS declare LAPACK, too, and
// because this program does not use OpenMP itself.
extern "C"
{
  void
  openblas_set_num_threads(int n_threads);
  void
  omp_set_max_active_levels(int n_levels);
}

namespace Debond
{
  void
  set_up_libraries()
  {
    dealii::deal_II_exceptions::disable_abort_on_exception();
    dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();
    // a file beyond a limit of its size is an error like a full disk
    std::signal(SIGXFSZ, SIG_IGN);
    set_number_of_threads(1);
  }



  void
  set_number_of_threads(const unsigned int n)
  {
    dealii::MultithreadInfo::set_thread_limit(n);
    // CHOLMOD divides small loops among four threads, however few processors
    // there are: that costs a quarter of a factorisation. Each thread that
    // factorises has to say so.
    omp_set_max_active_levels(0);
    openblas_set_num_threads(1);
  }



  void
  thread_blas(const bool wanted)
  {
    openblas_set_num_threads(wanted ? dealii::MultithreadInfo::n_threads() : 1);
  }



  double
  peak_memory_MB()
  {
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    return memory.VmHWM / 1024.; // from kB
  }
} // namespace Debond
