// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_columns_of_step_h
#define undine_output_columns_of_step_h

#include <undine/base/core/clock.h>
#include <undine/coupled/state/report.h>

#include <string>

namespace undine
{
  /// The columns with which a row of the file `statistics` begins: when, and how the step went.
  Columns
  columns_of_step(const Clock &clock, const Report &report);

  /// Throws InputError if two columns of that file had the same name. `scene`: the name of its
  /// file.
  void
  assert_different_names(const Clock &clock, const Report &report, const std::string &scene);
} // namespace undine

#endif
