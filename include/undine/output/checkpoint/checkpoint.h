// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_checkpoint_checkpoint_h
#define undine_output_checkpoint_checkpoint_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace undine
{
  /// Write the whole state to the older of the two slots `DIRECTORY/checkpoint/slot_[01].h5`. The
  /// other one is not touched, and the new one appears only when it is whole and on the disk: at
  /// any moment one is good. The file does not depend on the number of ranks. Collective. Throws
  /// FileError; SolveError, and writes nothing, if the state holds a value that is not finite.
  /// `statistics_digest`, on the first rank, is that of the rows of `statistics` until this state
  /// (ResultFolder).
  template <int dim>
  void
  write_checkpoint(const std::filesystem::path &directory,
                   const Models<dim>           &models,
                   const State<dim>            &state,
                   std::uint64_t                statistics_digest = 0);

  /// The files that write_checkpoint() may write, relative to the folder of the run.
  std::array<std::filesystem::path, 2>
  checkpoint_files();

  /// The step at which the run in `directory` can be taken up again; 0 if it cannot, or only from
  /// its start. One rank.
  std::uint64_t
  resumable_step(const std::filesystem::path &directory);

  /// The checkpoint from which a run was resumed.
  struct ResumedFrom
  {
    std::filesystem::path    directory;
    std::filesystem::path    slot;
    std::vector<std::string> skipped;               ///< why newer slots could not be used
    std::uint64_t            statistics_digest = 0; ///< 0: not known
  };

  /// Replace the values, the time and the step of an initialised `state` by those of the newest
  /// slot that is whole. Collective, on any number of ranks. Throws FileError if there is none, or
  /// if it belongs to another scene: with other arrays, or with another geometry.
  template <int dim>
  ResumedFrom
  read_checkpoint(const std::filesystem::path &directory,
                  const Models<dim>           &models,
                  State<dim>                  &state);
} // namespace undine

#endif
