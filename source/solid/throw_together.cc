// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/solid/throw_together.h>

namespace undine
{
  void
  throw_together(const std::string &message, const MPI_Comm communicator)
  {
    namespace MPI            = dealii::Utilities::MPI;
    const unsigned int ranks = MPI::n_mpi_processes(communicator);
    const unsigned int rank  = MPI::this_mpi_process(communicator);
    const unsigned int first = MPI::min(message.empty() ? ranks : rank, communicator);
    if (first < ranks)
      throw SolveError(MPI::broadcast(communicator, message, first));
  }
} // namespace undine
