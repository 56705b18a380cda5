// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_out_of_memory_h
#define undine_driver_out_of_memory_h

namespace undine
{
  /// Exit code of a run that has run out of memory.
  constexpr int exit_code_of_memory = 6;

  /// From now on, when memory runs out on this rank, say so and end all ranks with
  /// exit_code_of_memory. Others may wait for this one in MPI at that moment, and a bad_alloc on
  /// its way out of here would find libraries that take it for something else; so nothing is
  /// thrown. MPI must have been initialised.
  void
  end_run_when_out_of_memory();
} // namespace undine

#endif
