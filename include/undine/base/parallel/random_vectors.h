// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_parallel_random_vectors_h
#define undine_base_parallel_random_vectors_h

#include <deal.II/base/mpi.h>

#include <ml_utils.h>

namespace undine
{
  /// To be called before a hierarchy of Trilinos' ML is made. ML estimates eigenvalues from random
  /// vectors, whose generator goes on from one hierarchy to the next: without this, a hierarchy
  /// would depend on how many were made before it, and a resumed run would differ from one that was
  /// never stopped.
  inline void
  restart_random_vectors(const MPI_Comm communicator)
  {
    ML_set_random_seed(
      1 + 7919 * static_cast<int>(dealii::Utilities::MPI::this_mpi_process(communicator)));
  }
} // namespace undine

#endif
