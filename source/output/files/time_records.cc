// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files/files.h>
#include <undine/output/files/schedule.h>
#include <undine/output/files/time_records.h>

#include <fmt/format.h>

#include <sstream>

namespace undine
{
  namespace
  {
    // A comment in front of every record makes the file readable without an XML parser.
    const std::string mark = "<!-- time ";


    std::map<double, std::string>
    read_records(const std::string           &text,
                 const std::string           &tail,
                 const std::filesystem::path &path)
    {
      std::map<double, std::string> records;
      const std::string             body = text.substr(0, text.rfind(tail));
      std::istringstream            lines(body);
      std::string                  *current = nullptr;
      for (std::string line; std::getline(lines, line);)
        if (line.rfind(mark, 0) == 0)
          current = &records[leading_number(line.substr(mark.size()), path)];
        else if (current != nullptr)
          *current += line + "\n";
      return records;
    }
  } // namespace


  TimeRecords::TimeRecords(const MPI_Comm               communicator,
                           const std::filesystem::path &path,
                           const Frame                 &frame,
                           const Clock                 &clock)
    : communicator(communicator)
    , path(path)
    , frame(frame)
  {
    on_first_rank(communicator, [&] {
      if (clock.step > 0 && std::filesystem::exists(path))
        for (const auto &record : read_records(read_file(path), frame.tail, path))
          if (has_passed(clock, record.first))
            records.insert(record);
      write();
    });
  }


  void
  TimeRecords::add(const double time, const std::string &lines)
  {
    on_first_rank(communicator, [&] {
      records[time] = lines;
      write();
    });
  }


  void
  TimeRecords::write() const
  {
    std::string text = frame.head;
    for (const auto &record : records)
      text += fmt::format("{}{:.17g} s -->\n{}", mark, record.first, record.second);
    write_file(path, text + frame.tail);
  }
} // namespace undine
