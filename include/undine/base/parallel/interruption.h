// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_parallel_interruption_h
#define undine_base_parallel_interruption_h

#include <undine/base/core/interruption.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace undine
{
  /// From now on SIGINT, SIGTERM and SIGUSR1, which batch systems and mpirun can pass on, only ask
  /// the run to stop. One that comes a second or more after the first ends the process at once, as
  /// if nobody listened, unless it is the launcher's answer to the first.
  void
  listen_for_interruption();

  /// Has this process been asked to stop? Ranks are asked at different moments: see
  /// throw_if_interrupted().
  bool
  interruption_requested();

  /// "SIGTERM", or "" if nothing was asked.
  std::string
  interruption_name();

  /// Throws Interruption on all ranks if any of them has been asked to stop. Collective.
  void
  throw_if_interrupted(MPI_Comm communicator);
} // namespace undine

#endif
