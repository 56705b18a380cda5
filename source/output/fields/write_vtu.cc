// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/fields/patches.h>
#include <undine/output/files/shared_file.h>

#include <sstream>

namespace undine
{
  template <int dim, int spacedim>
  void
  write_vtu(const MPI_Comm                       communicator,
            const std::filesystem::path         &path,
            const Patches<dim, spacedim>        &patches,
            const dealii::DataOutBase::VtkFlags &flags)
  {
    namespace MPI              = dealii::Utilities::MPI;
    const unsigned int rank    = MPI::this_mpi_process(communicator);
    const unsigned int n_ranks = MPI::n_mpi_processes(communicator);
    const bool         nothing = MPI::sum(std::uint64_t(patches.patches.size()), communicator) == 0;

    std::ostringstream text;
    if (rank == 0)
      dealii::DataOutBase::write_vtu_header(text, flags);
    // ParaView stumbles over an empty piece, unless it is the only one.
    if (!patches.patches.empty() || (nothing && rank == 0))
      dealii::DataOutBase::write_vtu_main(
        patches.patches, patches.components, patches.vectors, flags, text);
    if (rank == n_ranks - 1)
      dealii::DataOutBase::write_vtu_footer(text);
    write_file_together(communicator, path, text.str());
  }


  template void
  write_vtu(MPI_Comm,
            const std::filesystem::path &,
            const Patches<0, 2> &,
            const dealii::DataOutBase::VtkFlags &);
  template void
  write_vtu(MPI_Comm,
            const std::filesystem::path &,
            const Patches<0, 3> &,
            const dealii::DataOutBase::VtkFlags &);
  template void
  write_vtu(MPI_Comm,
            const std::filesystem::path &,
            const Patches<1, 2> &,
            const dealii::DataOutBase::VtkFlags &);
  template void
  write_vtu(MPI_Comm,
            const std::filesystem::path &,
            const Patches<2, 3> &,
            const dealii::DataOutBase::VtkFlags &);
  template void
  write_vtu(MPI_Comm,
            const std::filesystem::path &,
            const Patches<2> &,
            const dealii::DataOutBase::VtkFlags &);
  template void
  write_vtu(MPI_Comm,
            const std::filesystem::path &,
            const Patches<3> &,
            const dealii::DataOutBase::VtkFlags &);
} // namespace undine
