// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_run_directory_h
#define undine_driver_run_directory_h

#include <undine/base/core/timing.h>
#include <undine/base/options/options.h>
#include <undine/driver/log.h>
#include <undine/scene/scene.h>

#include <filesystem>

namespace undine
{
  /// Make the folder of a run and write original.prm, parameters.prm and parameters.json into it.
  /// Collective. Throws FileError, on all ranks, if it cannot be written.
  void
  prepare_directory(const std::filesystem::path &directory,
                    const Options               &options,
                    const bool                   resumed,
                    MPI_Comm                     communicator);

  /// Write a file of the run's folder, whole or not at all. Collective. Throws FileError, on all
  /// ranks.
  void
  write_whole_file(const std::filesystem::path &path,
                   const std::string           &text,
                   MPI_Comm                     communicator);

  /// Versions and ranks, and what the scene is.
  template <int dim>
  void
  print_header(Log &log, const Scene<dim> &scene, const Options &options, MPI_Comm communicator);

  /// The sizes of the discrete problem.
  template <int dim>
  void
  print_unknowns(Log &log, const Scene<dim> &scene);

  /// The table of seconds by phase, to the log and to the file `timing`.
  void
  write_timing(const std::filesystem::path &directory,
               const TimingTree            &timing,
               Log                         &log,
               MPI_Comm                     communicator);
} // namespace undine

#endif
