// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files/files.h>
#include <undine/output/statistics_file.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
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
    assert_finite_columns(const Columns &columns)
    {
      const double step = columns.front().value;
      for (const auto &column : columns)
        if (!std::isfinite(column.value))
          throw SolveError(
            step == 0
              ? fmt::format(
                  "at the start '{}' is {}, not a number: an expression of the scene from "
                  "which it follows has no value somewhere. Try: look at initial values, "
                  "loads and pressures for a division by zero, or a root or logarithm of "
                  "what may be negative.",
                  column.name,
                  column.value)
              : fmt::format("after step {:.0f} '{}' is {}, not a number. Try a shorter Time/Step; "
                            "'statistics' ends with the step before.",
                            step,
                            column.name,
                            column.value));
    }


    /// The part of an older file that stays.
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
        if (line.rfind('#', 0) == 0)
          kept.header += line + "\n";
        else if (leading_number(line, path) <= last_step)
          kept.rows += line + "\n";
      return kept;
    }


    /// Is there one row for each step until `last_step`, each as long as the header?
    bool
    are_whole(const Kept &kept, const unsigned int last_step, const std::size_t n_columns)
    {
      std::istringstream lines(kept.rows);
      double             next = -1;
      for (std::string line; std::getline(lines, line);)
        {
          std::istringstream  words(line);
          std::vector<double> row;
          for (std::string word; words >> word;)
            row.push_back(std::strtod(word.c_str(), nullptr));
          if (row.size() != n_columns || (next >= 0 && row[0] != next))
            return false;
          next = row[0] + 1;
        }
      return next == last_step + 1.;
    }


    FileError
    other_columns(const std::filesystem::path &path)
    {
      return FileError("'" + path.string() +
                       "' has other columns than this run, so its rows cannot be continued. Keep "
                       "bodies, boundaries, effects and probes as they were, or move the file "
                       "away: the run then goes on with a new one.");
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
      header      = kept.header;
      text_digest = undine::digest(0, kept.header + kept.rows);
      write_file(path, kept.header + kept.rows);
    });
  }


  void
  StatisticsFile::append(const Columns &columns)
  {
    assert_finite_columns(columns);
    on_first_rank(communicator, [&] {
      const std::string wanted = header_of(columns);
      if (!header.empty() && header != wanted)
        throw other_columns(path);
      const auto text = (header.empty() ? wanted : "") + row_of(columns);
      append_to_file(path, text);
      text_digest = undine::digest(text_digest, text);
      header      = wanted;
    });
  }


  std::uint64_t
  StatisticsFile::digest() const
  {
    return text_digest;
  }


  void
  StatisticsFile::assert_continues(const MPI_Comm               communicator,
                                   const std::filesystem::path &path,
                                   const unsigned int           last_step,
                                   const Columns               &columns,
                                   const std::uint64_t          expected_digest)
  {
    on_first_rank(communicator, [&] {
      if (!std::filesystem::exists(path))
        return;
      const auto text = read_file(path);
      if (text.empty())
        return; // of a run that was stopped before it wrote a row
      const auto kept = keep(text, last_step, path);
      if (kept.header != header_of(columns))
        throw other_columns(path);
      const bool as_written =
        expected_digest == 0 || expected_digest == undine::digest(0, kept.header + kept.rows);
      if (!as_written || !are_whole(kept, last_step, columns.size()))
        throw FileError(fmt::format("'{}' is not what this run had written when it reached step "
                                    "{}: rows are missing or have been changed. Put the file back "
                                    "as it was, or move it away: the run then goes on with a new "
                                    "one.",
                                    path.string(),
                                    last_step));
    });
  }
} // namespace undine
