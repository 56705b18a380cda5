// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_unit_solid_reference_table_h
#define undine_unit_solid_reference_table_h

#include <deal.II/base/utilities.h>

#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace undine_tests
{
  using ReferenceRow = std::map<std::string, std::string>;

  /// The first row of tests/reference/FILE.csv whose columns have the wanted values. Lines that
  /// begin with # are comments, the first other line names the columns.
  inline ReferenceRow
  reference_row(const std::string &file, const ReferenceRow &wanted)
  {
    std::ifstream in(std::string(UNDINE_SOURCE_DIR) + "/tests/reference/" + file + ".csv");
    std::string   line;
    std::vector<std::string> names;
    while (std::getline(in, line))
      {
        if (line.empty() || line[0] == '#')
          continue;
        const auto values = dealii::Utilities::split_string_list(line, ',');
        if (names.empty())
          {
            names = values;
            continue;
          }
        ReferenceRow row;
        for (unsigned int i = 0; i < names.size() && i < values.size(); ++i)
          row[names[i]] = values[i];
        bool matches = true;
        for (const auto &entry : wanted)
          matches = matches && row[entry.first] == entry.second;
        if (matches)
          return row;
      }
    throw std::runtime_error("tests/reference/" + file + ".csv has no such row");
  }


  inline double
  number(const ReferenceRow &row, const std::string &column)
  {
    return std::stod(row.at(column));
  }
} // namespace undine_tests

#endif
