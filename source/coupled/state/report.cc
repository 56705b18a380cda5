// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/coupled/state/report.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  void
  Report::warn(const std::string &subject, const std::string &text)
  {
    const auto same = [&](const Warning &warning) { return warning.subject == subject; };
    if (!text.empty() && std::none_of(warnings.begin(), warnings.end(), same))
      warnings.push_back({subject, text});
  }


  std::vector<std::string>
  new_warnings(const std::vector<Report::Warning> &now, const std::vector<Report::Warning> &before)
  {
    std::vector<std::string> result;
    for (const auto &warning : now)
      if (std::none_of(before.begin(), before.end(), [&](const auto &earlier) {
            return earlier.subject == warning.subject;
          }))
        result.push_back(warning.text);
    return result;
  }


  void
  assert_finite(const Columns &columns)
  {
    for (const auto &column : columns)
      if (!std::isfinite(column.value))
        throw SolveError("'" + column.name +
                         "' is not a finite number. Check the expressions of the scene at this "
                         "time, or try a smaller Time/Step.");
  }
} // namespace undine
