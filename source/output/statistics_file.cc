// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files.h>
#include <undine/output/statistics_file.h>

#include <fmt/format.h>

#include <cmath>
#include <sstream>

namespace undine
{
  namespace
  {
    constexpr int width = 18;


    std::string
    header_of(const Columns &columns)
    {
      std::string  text;
      unsigned int number = 0;
      for (const auto &column : columns)
        text += fmt::format("# {}: {} [{}]\n", ++number, column.name, column.unit);
      return text;
    }


    /// Counts as whole numbers, everything else with ten digits.
    std::string
    format(const Column &column)
    {
      const bool is_count =
        column.unit == "1" && column.value == std::floor(column.value) && column.value < 1e9;
      return is_count ? fmt::format("{:>{}.0f}", column.value, width)
                      : fmt::format("{:>{}.9e}", column.value, width);
    }


    std::string
    row_of(const Columns &columns)
    {
      std::string text;
      for (const auto &column : columns)
        text += format(column);
      return text + "\n";
    }


    void
    assert_finite(const Columns &columns)
    {
      for (const auto &column : columns)
        if (!std::isfinite(column.value))
          throw SolveError(fmt::format("after step {:.0f} '{}' is {}, not a number. Try a shorter "
                                       "Time/Step; 'statistics' ends with the step before.",
                                       columns.front().value,
                                       column.name,
                                       column.value));
    }


    /// What is kept of an older file.
    struct Kept
    {
      std::string header;
      std::string rows;
    };


    Kept
    keep(const std::string &text, const unsigned int last_step, const std::filesystem::path &path)
    {
      Kept               kept;
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line) && !lines.eof();)
        if (line.rfind("#", 0) == 0)
          kept.header += line + "\n";
        else if (leading_number(line, path) <= last_step)
          kept.rows += line + "\n";
      return kept;
    }
  } // namespace


  StatisticsFile::StatisticsFile(const MPI_Comm               communicator,
                                 const std::filesystem::path &path,
                                 const unsigned int           last_step)
    : communicator(communicator)
    , path(path)
  {
    on_first_rank(communicator, [&] {
      Kept kept;
      if (last_step > 0 && std::filesystem::exists(path))
        kept = keep(read_file(path), last_step, path);
      header = kept.header;
      write_file(path, kept.header + kept.rows);
    });
  }


  void
  StatisticsFile::append(const Columns &columns)
  {
    assert_finite(columns);
    on_first_rank(communicator, [&] {
      const std::string wanted = header_of(columns);
      if (!header.empty() && header != wanted)
        throw FileError("'" + path.string() +
                        "' has other columns than this run, so its rows cannot be continued. Keep "
                        "bodies, boundaries, effects and probes as they were, or move the file "
                        "away.");
      append_to_file(path, (header.empty() ? wanted : "") + row_of(columns));
      header = wanted;
    });
  }
} // namespace undine
