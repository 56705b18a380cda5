// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_engine_failures_h
#define undine_particles_engine_failures_h

#include <undine/particles/model/step_control.h>

#include <string>

namespace undine::particles
{
  /// In words: what went wrong in a frame, when, and what to try.
  std::string
  reason_of_failure(const StepControl &control);
} // namespace undine::particles

#endif
