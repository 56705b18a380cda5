// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_column_h
#define undine_base_core_column_h

#include <string>
#include <vector>

namespace undine
{
  /// One number of a step, as it appears in the file `statistics`. Whoever contributes columns
  /// contributes the same names in the same order at every step.
  struct Column
  {
    std::string name;
    std::string unit; ///< "1" if it has none
    double      value;
  };

  using Columns = std::vector<Column>;
} // namespace undine

#endif
