#ifndef debond_support_available_memory_h
#define debond_support_available_memory_h

#include <filesystem>

namespace Debond
{
  /** Memory that this process can still take [MB]: the least of what the
   *  machine has left, what a limit of the address space (`ulimit -v`) leaves,
   *  and what control groups leave, in which containers and batch systems
   *  run. */
  double
  available_memory_MB();

  /**
   * What the memory limits of control groups leave [MB]: of those that
   * @p groups (/proc/self/cgroup) names and of all that hold them, below
   * @p mount (/sys/fs/cgroup), of version 1 or 2. Cached files are not counted
   * as taken. Infinity if there is no limit.
   */
  double
  memory_within_control_groups_MB(const std::filesystem::path &groups,
                                  const std::filesystem::path &mount);
} // namespace Debond
#endif
