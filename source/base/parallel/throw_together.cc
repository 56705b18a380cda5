// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/parallel/throw_together.h>

namespace undine
{
  std::string
  first_message(const std::string &message, const MPI_Comm communicator)
  {
    namespace MPI            = dealii::Utilities::MPI;
    const unsigned int ranks = MPI::n_mpi_processes(communicator);
    const unsigned int rank  = MPI::this_mpi_process(communicator);
    const unsigned int first = MPI::min(message.empty() ? ranks : rank, communicator);
    return first < ranks ? MPI::broadcast(communicator, message, first) : "";
  }
} // namespace undine
