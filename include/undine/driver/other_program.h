// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_other_program_h
#define undine_driver_other_program_h

#include <chrono>
#include <string>
#include <vector>

namespace undine
{
  /// Starts another program, found in PATH, with these arguments (the first is its name) and
  /// additional variables of the environment ("NAME=value"), and waits for it. What it prints is
  /// lost; it does not hear of Ctrl-C, and is ended if it takes longer than `limit`. Returns why it
  /// has failed, by the last line of its error messages; empty if its exit code is 0. Never throws
  /// an Error.
  std::string
  call_program(const std::vector<std::string> &words,
               const std::vector<std::string> &environment,
               std::chrono::milliseconds       limit);
} // namespace undine

#endif
