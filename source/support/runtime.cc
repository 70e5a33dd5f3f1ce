#include <debond/support/number_text.h>
#include <debond/support/runtime.h>

#include <deal.II/base/utilities.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>

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
    // there are: that costs a quarter of a factorisation.
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



  namespace
  {
    constexpr double no_limit = std::numeric_limits<double>::infinity();



    /** The number behind a name in a file of lines `name number`; 0 if it is
     *  not there. */
    double
    entry(const std::filesystem::path &filename, const std::string &wanted)
    {
      Classic<std::ifstream> file(filename);
      std::string            name, rest;
      double                 number = 0.;
      while (file >> name >> number && std::getline(file, rest))
        if (name == wanted)
          return number;
      return 0.;
    }



    /** Of the address space [bytes]. */
    double
    limit_of_memory()
    {
      rlimit limit{};
      return getrlimit(RLIMIT_AS, &limit) != 0 ||
                 limit.rlim_cur == RLIM_INFINITY ?
               no_limit :
               limit.rlim_cur;
    }



    /** What that leaves [bytes], without the buffer of each thread that calls
     *  BLAS, which waits for ever if there is no room for it. */
    double
    memory_within_limit()
    {
      constexpr double blas_buffer = 1 << 27;
      double           pages       = 0.;
      Classic<std::ifstream>("/proc/self/statm") >> pages;
      return std::max(0.,
                      limit_of_memory() - pages * sysconf(_SC_PAGESIZE) -
                        blas_buffer * dealii::MultithreadInfo::n_threads());
    }



    /** What the limit of one control group of version 1 or 2 leaves
     *  [bytes]. */
    double
    memory_within(const std::filesystem::path &group, const bool is_version_2)
    {
      double limit = 0., taken = 0.;
      // without a limit the file says `max', or is not there
      if (!(Classic<std::ifstream>(group / (is_version_2 ?
                                              "memory.max" :
                                              "memory.limit_in_bytes")) >>
            limit) ||
          !(Classic<std::ifstream>(group / (is_version_2 ?
                                              "memory.current" :
                                              "memory.usage_in_bytes")) >>
            taken))
        return no_limit;
      // in version 1 these are sums over the groups that it holds
      const std::string prefix = is_version_2 ? "" : "total_";
      for (const char *const files : {"inactive_file", "active_file"})
        taken -= entry(group / "memory.stat", prefix + files);
      return std::max(0., limit - std::max(0., taken));
    }
  } // namespace



  int
  exit_code(const int code)
  {
    if (limit_of_memory() < no_limit)
      {
        std::cout.flush();
        std::_Exit(code);
      }
    return code;
  }



  double
  memory_within_control_groups_MB(const std::filesystem::path &groups,
                                  const std::filesystem::path &mount)
  {
    double                 bytes = no_limit;
    Classic<std::ifstream> file(groups);
    // number:controllers:path, version 2 being `0::path'
    for (std::string line; std::getline(file, line);)
      {
        Classic<std::istringstream> fields(line);
        std::string                 number, controllers, path;
        std::getline(fields, number, ':');
        std::getline(fields, controllers, ':');
        std::getline(fields, path);
        const bool is_version_2 = number == "0" && controllers.empty();
        if (!is_version_2 && controllers != "memory")
          continue;
        const auto top = is_version_2 ? mount : mount / "memory";
        // in a container, of these only the last may be there
        for (std::filesystem::path group = path;; group = group.parent_path())
          {
            bytes = std::min(bytes,
                             memory_within(top / group.relative_path(),
                                           is_version_2));
            if (!group.has_relative_path())
              break;
          }
      }
    return 1e-6 * bytes;
  }



  double
  available_memory_MB()
  {
    // what the system says it could give away without swapping
    const double kB = entry("/proc/meminfo", "MemAvailable:");
    return std::min(
      {kB > 0. ? 1024e-6 * kB : no_limit,
       1e-6 * memory_within_limit(),
       memory_within_control_groups_MB("/proc/self/cgroup", "/sys/fs/cgroup")});
  }
} // namespace Debond
