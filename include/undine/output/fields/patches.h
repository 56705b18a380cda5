// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_fields_patches_h
#define undine_output_fields_patches_h

#include <deal.II/base/data_out_base.h>

#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace undine
{
  /// A part of the solution for visualisation: this rank's pieces of space with numbers at their
  /// points. Every rank has the same fields, perhaps no pieces. Pieces have `dim` directions and
  /// lie in a space of `spacedim`.
  template <int dim, int spacedim = dim>
  struct Patches
  {
    using Ranges =
      std::vector<std::tuple<unsigned int,
                             unsigned int,
                             std::string,
                             dealii::DataComponentInterpretation::DataComponentInterpretation>>;

    /// Whether points of several patches at one place carry the same numbers.
    enum class Continuity
    {
      continuous,
      discontinuous
    };

    std::string                                            name; ///< "bodies", "fluid", ...
    std::vector<dealii::DataOutBase::Patch<dim, spacedim>> patches;
    std::vector<std::string>           components; ///< names, as rows of patch.data
    Ranges                             vectors;    ///< components that form vectors
    std::map<std::string, std::string> units;      ///< of fields, by name
    Continuity                         continuity = Continuity::discontinuous;

    /// Append a field of one component, of which patch.data has the row next in turn.
    void
    add_scalar(const std::string &field, const std::string &unit);

    /// Append a field of `spacedim` components.
    void
    add_vector(const std::string &field, const std::string &unit);
  };

  /// One compressed .vtu file from the patches of all ranks. Collective. Throws FileError.
  template <int dim, int spacedim>
  void
  write_vtu(MPI_Comm                             communicator,
            const std::filesystem::path         &path,
            const Patches<dim, spacedim>        &patches,
            const dealii::DataOutBase::VtkFlags &flags);

  /// One HDF5 file from the patches of all ranks: arrays `nodes` [m], `cells` (indices of nodes)
  /// and one for every field, vectors padded to three components. Returns the XDMF description of
  /// `path` at `time` [s], of the same content on all ranks; it names the file `shown_as`.
  /// Collective. Throws FileError.
  template <int dim, int spacedim>
  dealii::XDMFEntry
  write_hdf5(MPI_Comm                      communicator,
             const std::filesystem::path  &path,
             const std::string            &shown_as,
             const Patches<dim, spacedim> &patches,
             double                        time);
} // namespace undine

#endif
