// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_run_directory_h
#define undine_driver_run_directory_h

#include <undine/base/core/timing.h>
#include <undine/base/options/options.h>
#include <undine/driver/command_line.h>
#include <undine/driver/log.h>
#include <undine/output/checkpoint/checkpoint.h>
#include <undine/output/files/result_folder.h>
#include <undine/scene/scene.h>

#include <optional>
#include <string>

namespace undine
{
  /// Throws FileError if a new run in the folder would replace files that no run has written, or,
  /// unless the user asks for that, a run that has not reached its end and can be taken up again.
  /// Collective.
  void
  assert_replaceable(const ResultFolder &folder, const Request &request, MPI_Comm communicator);

  /// Make the folder that of a new run, or, if that is where the run is taken up again `from`, that
  /// of a run which goes on, and write original.prm, parameters.prm and parameters.json into it. A
  /// run that goes on in another folder takes its `statistics` along. Collective. Throws FileError.
  void
  prepare_directory(ResultFolder                     &folder,
                    const Options                    &options,
                    const std::optional<ResumedFrom> &from,
                    MPI_Comm                          communicator);

  /// Write a file of the run's folder, whole or not at all. Collective. Throws FileError.
  void
  write_whole_file(ResultFolder      &folder,
                   const std::string &name,
                   const std::string &text,
                   MPI_Comm           communicator);

  /// Print versions, number of ranks, title of the scene and folders.
  template <int dim>
  void
  print_header(Log &log, const Scene<dim> &scene, const Options &options, MPI_Comm communicator);

  /// Print the sizes of the discrete problem and warnings about locking.
  template <int dim>
  void
  print_unknowns(Log &log, const Scene<dim> &scene);

  /// Seconds by phase, as text.
  std::string
  timing_table(const TimingTree &timing);

  /// Write the table of seconds by phase to the log and to the file `timing`. Collective. Throws
  /// FileError.
  void
  write_timing(ResultFolder &folder, const TimingTree &timing, Log &log, MPI_Comm communicator);
} // namespace undine

#endif
