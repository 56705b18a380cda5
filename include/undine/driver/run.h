// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_run_h
#define undine_driver_run_h

#include <undine/base/options/options.h>
#include <undine/driver/command_line.h>

#include <deal.II/base/mpi.h>

namespace undine
{
  /// Do what the user asks, in the dimension of the scene. Collective. Throws Error.
  void
  execute(const Request &request, MPI_Comm communicator);
} // namespace undine

#endif
