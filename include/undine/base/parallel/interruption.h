// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_parallel_interruption_h
#define undine_base_parallel_interruption_h

#include <deal.II/base/mpi.h>

namespace undine
{
  /// Throws Interruption on all ranks if any of them has been asked to stop. Collective.
  void
  throw_if_interrupted(MPI_Comm communicator);
} // namespace undine

#endif
