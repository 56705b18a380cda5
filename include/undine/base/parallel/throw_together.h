// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_parallel_throw_together_h
#define undine_base_parallel_throw_together_h

#include <undine/base/core/errors.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace undine
{
  /// The message of the lowest rank that has one, on all ranks; empty if none has. Collective.
  std::string
  first_message(const std::string &message, MPI_Comm communicator);

  /// Throws a `Kind` of Error on all ranks if `message` is not empty on any of them, with the
  /// message of the lowest of these: a rank that throws alone would leave the others waiting for
  /// it. Collective.
  template <class Kind = SolveError>
  void
  throw_together(const std::string &message, const MPI_Comm communicator)
  {
    const std::string first = first_message(message, communicator);
    if (!first.empty())
      throw Kind(first);
  }
} // namespace undine

#endif
