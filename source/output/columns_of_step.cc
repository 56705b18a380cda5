// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/output/columns_of_step.h>

#include <set>

namespace undine
{
  Columns
  columns_of_step(const Clock &clock, const Report &report)
  {
    return {{"Step", "1", double(clock.step)},
            {"Time", "s", clock.time},
            {"Step length", "s", report.dt},
            {"Newton iterations", "1", double(report.newton_iterations)},
            {"Linear iterations", "1", double(report.linear_iterations)},
            {"Step cuts", "1", double(report.cuts)}};
  }


  void
  assert_different_names(const Clock &clock, const Report &report, const std::string &scene)
  {
    std::set<std::string> names;
    for (const auto &columns : {columns_of_step(clock, report), report.columns})
      for (const auto &column : columns)
        if (!names.insert(column.name).second)
          throw InputError(scene + ": two columns of 'statistics' would be named '" + column.name +
                           "'. Try: another name for the probe, body, boundary or scalar that is "
                           "named so.");
  }
} // namespace undine
