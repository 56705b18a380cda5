// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_failures_h
#define undine_driver_failures_h

#include <undine/base/core/errors.h>
#include <undine/driver/log.h>
#include <undine/driver/run_directory.h>
#include <undine/driver/time_loop.h>

#include <string>

namespace undine
{
  /// About expressions of the scene that had no finite value at `since` [s] or later; empty if all
  /// had. Collective.
  std::string
  undefined_values(const Options &options, const double since, const MPI_Comm communicator);

  /// The same with the failure that may follow from it.
  std::string
  undefined_values(const Options &options,
                   const double   since,
                   const Error   &failure,
                   const MPI_Comm communicator);


  /// The time loop. A failed run keeps its last good state: it can be looked at, and resumed with
  /// other settings; so does one that is stopped. Throws what the loop threw, with what was kept;
  /// InputError in the place of what may follow from an expression without a value. Collective.
  template <int dim>
  void
  run_keeping_last_state(State<dim>         &state,
                         Scene<dim>         &scene,
                         const Options      &options,
                         const Watch<dim>   &watch,
                         const ResultFolder &folder,
                         Log                &log,
                         TimingTree         &timing);
} // namespace undine

#endif
