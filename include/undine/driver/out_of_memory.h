// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_out_of_memory_h
#define undine_driver_out_of_memory_h

namespace undine
{
  /// Exit code of a run that has run out of memory.
  constexpr int exit_code_of_memory = 6;

  /// From now on, when memory runs out on this rank, say so and end all ranks with
  /// exit_code_of_memory. Nothing is thrown: other ranks may wait for this one in MPI at that
  /// moment, and libraries that a std::bad_alloc passes through may take it for something else. MPI
  /// must have been initialised.
  void
  end_run_when_out_of_memory();
} // namespace undine

#endif
