// SPDX-License-Identifier: LGPL-2.1-or-later
// What a machine has, from files like those of Linux.
#include <undine/driver/machine.h>
#include <undine/driver/size_check.h>

#include <catch2/catch.hpp>

#include <fstream>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

using namespace undine;

namespace
{
  namespace fs = std::filesystem;

  /// A folder with files like those of a machine, gone at the end.
  class Machine
  {
  public:
    Machine()
      : root(fs::temp_directory_path() / ("undine_machine_" + std::to_string(getpid())))
    {
      fs::remove_all(root);
      write("proc/meminfo", "MemTotal: 9000 kB\nMemAvailable:    8000 kB\nCached: 1 kB\n");
    }

    ~Machine()
    {
      std::error_code ignored;
      fs::remove_all(root, ignored);
    }

    void
    write(const std::string &path, const std::string &text) const
    {
      fs::create_directories((root / path).parent_path());
      std::ofstream(root / path) << text;
    }

    const fs::path root;
  };
} // namespace


TEST_CASE("free memory is what /proc/meminfo calls available")
{
  const Machine machine;
  const auto    room = free_memory_of_host(machine.root);
  CHECK(room.bytes == 8000 * 1024.);
  CHECK(room.by.find("MemAvailable") != std::string::npos);
}


TEST_CASE("control groups of version 2 bound memory, and those above them do")
{
  const Machine machine;
  machine.write("proc/self/cgroup", "0::/batch/job\n");
  machine.write("sys/fs/cgroup/batch/job/memory.max", "max\n");
  machine.write("sys/fs/cgroup/batch/job/memory.current", "1000000\n");
  CHECK(free_memory_of_host(machine.root).bytes == 8000 * 1024.);

  machine.write("sys/fs/cgroup/batch/memory.max", "5000000\n");
  machine.write("sys/fs/cgroup/batch/memory.current", "3000000\n");
  machine.write("sys/fs/cgroup/batch/memory.stat", "anon 5\ninactive_file 500000\n");
  CHECK(free_memory_of_host(machine.root).bytes == 2500000);

  machine.write("sys/fs/cgroup/batch/job/memory.max", "1500000\n");
  const auto room = free_memory_of_host(machine.root);
  CHECK(room.bytes == 500000);
  CHECK(room.by.find("memory.max") != std::string::npos);
}


TEST_CASE("control groups of version 1 bound memory, also where the group is not seen")
{
  const Machine machine;
  machine.write("proc/self/cgroup", "5:cpu,cpuacct:/x\n4:memory:/docker/abc\n");
  machine.write("sys/fs/cgroup/memory/memory.limit_in_bytes", "4000000\n");
  machine.write("sys/fs/cgroup/memory/memory.usage_in_bytes", "1000000\n");
  machine.write("sys/fs/cgroup/memory/memory.stat", "cache 7\ntotal_inactive_file 250000\n");
  CHECK(free_memory_of_host(machine.root).bytes == 3250000);
}


#ifndef __SANITIZE_ADDRESS__ // which takes memory of its own
TEST_CASE("limits of the process bound its memory")
{
  rlimit before;
  getrlimit(RLIMIT_DATA, &before);
  const double most = 8e9;
  rlimit       limit{static_cast<rlim_t>(most), before.rlim_max};
  REQUIRE(setrlimit(RLIMIT_DATA, &limit) == 0);
  const auto room = free_memory_of_process();
  setrlimit(RLIMIT_DATA, &before);
  CHECK(room.bytes < most);
  CHECK(room.bytes > 0);
  CHECK(room.by.find("ulimit -d") != std::string::npos);
}


TEST_CASE("memory in use grows with what is used")
{
  const double      before = memory_in_use();
  std::vector<char> some(64 << 20, 'x');
  CHECK(memory_in_use() - before == Approx(some.size()).epsilon(0.1));
}
#endif


TEST_CASE("the disk of a folder that does not exist yet is that of the one above it")
{
  const auto here       = free_disk(fs::temp_directory_path());
  const auto new_folder = free_disk(fs::temp_directory_path() / "undine_none" / "of" / "these");
  CHECK(here.bytes > 0);
  CHECK(new_folder.bytes == Approx(here.bytes).epsilon(0.1));
}


TEST_CASE("numbers are readable")
{
  CHECK(readable_bytes(1.25e9) == "1.2 GB");
  CHECK(readable_bytes(43e6) == "43 MB");
  CHECK(readable_bytes(2e17) == "200 PB");
  CHECK(readable_seconds(0.5) == "0.5 s");
  CHECK(readable_seconds(7200) == "2.0 h");
  CHECK(readable_seconds(86400 * 40) == "40 d");
}
