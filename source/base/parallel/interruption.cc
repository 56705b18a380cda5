// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/interruption.h>
#include <undine/base/parallel/interruption.h>

namespace undine
{
  void
  throw_if_interrupted(const MPI_Comm communicator)
  {
    namespace MPI              = dealii::Utilities::MPI;
    const unsigned int n_ranks = MPI::n_mpi_processes(communicator);
    const unsigned int rank    = MPI::this_mpi_process(communicator);
    const unsigned int first   = MPI::min(interruption_requested() ? rank : n_ranks, communicator);
    if (first < n_ranks)
      throw Interruption("stopped by " + MPI::broadcast(communicator, interruption_name(), first));
  }
} // namespace undine
