// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_size_check_h
#define undine_driver_size_check_h

#include <undine/base/options/options.h>
#include <undine/driver/log.h>
#include <undine/driver/machine.h>
#include <undine/scene/estimate.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <optional>
#include <string>

namespace undine
{
  /// Compares what a scene will take with what the machine has, before any of it is built.
  class SizeCheck
  {
  public:
    /// Measure the scene by its parameter file. One with mistakes may have no size: reading it says
    /// why. Collective.
    template <int dim>
    static SizeCheck
    of(const Options &options, MPI_Comm communicator);

    /// True if the machine may have too little memory, within the estimate's uncertainty.
    bool
    may_be_too_large() const;

    /// Throws InputError if the scene needs clearly more memory than there is, by more than the
    /// estimate's uncertainty.
    void
    refuse_what_is_too_large() const;

    /// The estimate, and warnings if memory, or space on the disk of `folder`, may not suffice.
    void
    print(Log &log, const std::filesystem::path &folder) const;

  private:
    std::string
    lack_of_memory() const;

    std::optional<SceneSize> size; ///< nothing: the scene has mistakes
    Estimate                 needed;
    Room                     room; ///< memory of each rank
    unsigned int             n_ranks = 1;
  };


  /// "3.2 GB"
  std::string
  readable_bytes(double bytes);

  /// "40 s", "12 min", "3.4 h", "6.1 d"
  std::string
  readable_seconds(double seconds);
} // namespace undine

#endif
