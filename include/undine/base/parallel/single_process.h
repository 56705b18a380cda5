// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_parallel_single_process_h
#define undine_base_parallel_single_process_h

#include <cstdlib>

namespace undine
{
  /// To be called before MPI starts: a process that no launcher (mpirun, srun) has started is
  /// alone, and needs neither the daemon nor the network that Open MPI would look for, which takes
  /// a good part of the start of a short run. What the user's environment says stays. Without
  /// effect on other implementations of MPI.
  inline void
  tell_mpi_if_process_is_alone()
  {
    for (const char *by_launcher : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"})
      if (std::getenv(by_launcher) != nullptr)
        return;
    constexpr int keep = 0;
    setenv("OMPI_MCA_ess_singleton_isolated", "1", keep);
    setenv("OMPI_MCA_pml", "ob1", keep);
    setenv("OMPI_MCA_btl", "self", keep);
    // All such processes of a host would use, and remove, one folder.
    setenv("OMPI_MCA_orte_create_session_dirs", "0", keep);
  }
} // namespace undine

#endif
