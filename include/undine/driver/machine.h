// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_machine_h
#define undine_driver_machine_h

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <limits>
#include <string>

namespace undine
{
  /// Free memory or disk space of a machine, and the limit by which it is known.
  struct Room
  {
    double      bytes = std::numeric_limits<double>::infinity(); ///< infinity: nothing bounds it
    std::string by;
  };

  /// Memory that the processes of this host may still take: what /proc/meminfo calls available and
  /// what the control groups of this process (versions 1 and 2) leave of their limits. Other `root`
  /// than "/" are for tests.
  Room
  free_memory_of_host(const std::filesystem::path &root = "/");

  /// Memory that this process may still take by its own limits (`ulimit -v`, `ulimit -d`).
  Room
  free_memory_of_process();

  /// The memory that each rank may still take, if those of a host share its memory evenly: the
  /// least of all ranks. Collective.
  Room
  free_memory_of_each_rank(MPI_Comm communicator);

  /// Memory in use by this process now [bytes]; 0 if the system does not tell.
  double
  memory_in_use();

  /// The largest memory that this process has ever used [bytes]; 0 if the system does not tell.
  double
  peak_memory();

  /// What this process has used of processors so far [s].
  double
  core_seconds();

  /// Free space on the disk on which `folder` is or will be.
  Room
  free_disk(const std::filesystem::path &folder);
} // namespace undine

#endif
