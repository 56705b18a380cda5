// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_throw_together_h
#define undine_solid_throw_together_h

#include <deal.II/base/mpi.h>

#include <string>

namespace undine
{
  /// Throws SolveError on all ranks if `message` is not empty on any of them, with the message of
  /// the lowest of these: a rank that throws alone would leave the others waiting for it.
  /// Collective.
  void
  throw_together(const std::string &message, MPI_Comm communicator);
} // namespace undine

#endif
