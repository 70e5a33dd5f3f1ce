// Memory limits of control groups, of both versions: the least that a group or
// one that holds it leaves, cached files not counted.

#include <debond/support/runtime.h>

#include <filesystem>
#include <fstream>
#include <iostream>

namespace
{
  const std::filesystem::path mount = "results/cgroup";

  void
  write(const std::filesystem::path &filename, const std::string &text)
  {
    std::filesystem::create_directories(filename.parent_path());
    std::ofstream(filename) << text;
  }



  void
  show(const std::string &what, const std::string &groups)
  {
    write("results/groups", groups);
    std::cout << what << ": "
              << Debond::memory_within_control_groups_MB("results/groups",
                                                         mount)
              << " MB\n";
  }
} // namespace



int
main()
{
  std::filesystem::remove_all("results");
  show("no groups at all", "");

  write(mount / "jobs/memory.max", "8000000000\n");
  write(mount / "jobs/memory.current", "3000000000\n");
  write(
    mount / "jobs/memory.stat",
    "anon 1500000000\nfile 1500000000\ninactive_file 600000000\nactive_file 400000000\n");
  write(mount / "jobs/step/memory.max", "max\n");
  write(mount / "jobs/step/memory.current", "2500000000\n");
  show("version 2, limit of the group that holds it", "0::/jobs/step\n");
  write(mount / "jobs/step/memory.max", "4000000000\n");
  show("version 2, limit of the group", "0::/jobs/step\n");
  write(mount / "jobs/step/memory.max", "2000000000\n");
  show("version 2, more taken than allowed", "0::/jobs/step\n");
  show("version 2, another group", "0::/idle\n");

  write(mount / "memory/memory.limit_in_bytes", "6000000000\n");
  write(mount / "memory/memory.usage_in_bytes", "2000000000\n");
  write(mount / "memory/memory.stat",
        "cache 7\ntotal_inactive_file 500000000\n");
  show("version 1, in a container",
       "9:name=systemd:/\n4:memory:/docker/1f2e\n1:cpu:/\n0::/\n");
  show("version 1, without control of memory", "1:cpu:/\n");
}
