// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_files_schedule_h
#define undine_output_files_schedule_h

#include <undine/base/core/clock.h>

namespace undine
{
  /// Is it time for a picture: the initial state, a multiple of the clock's landing interval (the
  /// key `Output / Interval`), or the end?
  bool
  is_output_time(const Clock &clock);

  /// Is `time` [s] one that a run which has reached `clock` has already passed or reached?
  bool
  has_passed(const Clock &clock, double time);
} // namespace undine

#endif
