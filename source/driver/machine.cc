// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/machine.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <sstream>

#include <sys/resource.h>

namespace undine
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr double kibi = 1024;


    /// The number that follows `word` in a file of lines "word number"; negative if there is none.
    double
    number_after(const fs::path &path, const std::string &word)
    {
      std::ifstream file(path);
      for (std::string line, first; std::getline(file, line);)
        {
          std::istringstream words(line);
          double             number;
          if (words >> first >> number && first == word)
            return number;
        }
      return -1;
    }


    /// The number in a file of one number; negative if there is none: the file, or "max" in it.
    double
    number_in(const fs::path &path)
    {
      std::ifstream file(path);
      double        number;
      return file >> number ? number : -1;
    }


    void
    lower(Room &room, const double bytes, const std::string &by)
    {
      if (bytes < room.bytes)
        room = {std::max(0., bytes), by};
    }


    /// Names of the files of one version of control groups.
    struct GroupFiles
    {
      std::string limit, usage, cache;
    };


    /// A group and all above it bound what a process may take. What they have in their cache of
    /// files is given back when it is needed.
    void
    lower_by_groups(Room &room, const fs::path &mount, fs::path group, const GroupFiles &files)
    {
      for (;; group = group.parent_path())
        {
          const auto   folder = mount / group.relative_path();
          const double limit  = number_in(folder / files.limit);
          const double usage  = number_in(folder / files.usage);
          const double cache  = number_after(folder / "memory.stat", files.cache);
          if (limit >= 0 && usage >= 0)
            lower(room,
                  limit - usage + std::max(0., cache),
                  "the limit of its control group (" + files.limit + ")");
          if (!group.has_relative_path())
            return;
        }
    }


    /// By limit `resource`, of which `used` [KiB] of /proc/self/status counts.
    void
    lower_by_limit(Room &room, const int resource, const std::string &used, const std::string &by)
    {
      rlimit       limit{};
      const double now = number_after("/proc/self/status", used);
      if (getrlimit(static_cast<__rlimit_resource>(resource), &limit) == 0 &&
          limit.rlim_cur != RLIM_INFINITY && now >= 0)
        lower(room, double(limit.rlim_cur) - kibi * now, by);
    }
  } // namespace


  Room
  free_memory_of_host(const fs::path &root)
  {
    Room         room;
    const double available = number_after(root / "proc/meminfo", "MemAvailable:");
    if (available >= 0)
      lower(room, kibi * available, "MemAvailable of /proc/meminfo");
    std::ifstream groups(root / "proc/self/cgroup");
    for (std::string line; std::getline(groups, line);)
      {
        // "0::/path" of version 2, "7:memory:/path" of version 1.
        const auto first = line.find(':'), second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos)
          continue;
        const auto controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const auto path        = line.substr(second + 1);
        if (controllers == ",,")
          lower_by_groups(
            room, root / "sys/fs/cgroup", path, {"memory.max", "memory.current", "inactive_file"});
        else if (controllers.find(",memory,") != std::string::npos)
          lower_by_groups(
            room,
            root / "sys/fs/cgroup/memory",
            path,
            {"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"});
      }
    return room;
  }


  Room
  free_memory_of_process()
  {
    Room room;
    lower_by_limit(room, RLIMIT_AS, "VmSize:", "the limit of its address space (ulimit -v)");
    lower_by_limit(room, RLIMIT_DATA, "VmData:", "the limit of its data (ulimit -d)");
    return room;
  }


  Room
  free_memory_of_each_rank(const MPI_Comm communicator)
  {
    MPI_Comm of_host;
    MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &of_host);
    Room room = free_memory_of_host();
    room.bytes /= dealii::Utilities::MPI::n_mpi_processes(of_host);
    MPI_Comm_free(&of_host);
    const auto own = free_memory_of_process();
    lower(room, own.bytes, own.by);
    const auto least = dealii::Utilities::MPI::min_max_avg(room.bytes, communicator);
    room.by          = dealii::Utilities::MPI::broadcast(communicator, room.by, least.min_index);
    room.bytes       = least.min;
    return room;
  }


  double
  memory_in_use()
  {
    return kibi * std::max(0., number_after("/proc/self/status", "VmRSS:"));
  }


  double
  peak_memory()
  {
    return kibi * std::max(0., number_after("/proc/self/status", "VmHWM:"));
  }


  double
  core_seconds()
  {
    return double(std::clock()) / CLOCKS_PER_SEC;
  }


  Room
  free_disk(const fs::path &folder)
  {
    std::error_code problem;
    auto            existing = fs::absolute(folder / ".", problem).lexically_normal();
    while (!existing.empty() && existing.has_relative_path() && !fs::exists(existing, problem))
      existing = existing.parent_path();
    const auto space = fs::space(existing, problem);
    if (problem)
      return {};
    return {double(space.available), "free space of the disk of " + existing.string()};
  }
} // namespace undine
