// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_checkpoint_h
#define undine_output_checkpoint_h

#include <undine/coupled/models.h>
#include <undine/coupled/state.h>

#include <filesystem>
#include <string>
#include <vector>

namespace undine
{
  /// Write the whole state to the older of the two slots `DIRECTORY/checkpoint/slot_[01].h5`. The
  /// other one is not touched, and the new one appears only when it is whole and on the disk: at
  /// any moment one is good. The file does not depend on the number of ranks. Collective. Throws
  /// FileError; SolveError, and writes nothing, if the state holds a value that is not finite.
  template <int dim>
  void
  write_checkpoint(const std::filesystem::path &directory,
                   const Models<dim>           &models,
                   const State<dim>            &state);

  /// Where a run was taken up again.
  struct ResumedFrom
  {
    std::filesystem::path    slot;
    std::vector<std::string> skipped; ///< why newer slots could not be used
  };

  /// Replace the values, the time and the step of an initialised `state` by those of the newest
  /// slot that is whole. Collective, on any number of ranks. Throws FileError if there is none, or
  /// if it belongs to another scene.
  template <int dim>
  ResumedFrom
  read_checkpoint(const std::filesystem::path &directory,
                  const Models<dim>           &models,
                  State<dim>                  &state);
} // namespace undine

#endif
