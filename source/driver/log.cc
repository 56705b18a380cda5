// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/driver/log.h>

#include <iostream>

namespace undine
{
  Log::Log(const MPI_Comm communicator)
    : communicator(communicator)
    , speaks(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
  }


  void
  Log::open(const std::filesystem::path &directory, const std::ios::openmode mode)
  {
    if (speaks)
      file.open(directory / "log.txt", std::ios::out | mode);
    const bool opened = !speaks || file.good();
    if (dealii::Utilities::MPI::min(opened ? 1 : 0, communicator) == 0)
      throw FileError("cannot write '" + (directory / "log.txt").string() +
                      "'. Check the permissions of the folder, or choose another with --output.");
    record(early);
    early.clear();
  }


  bool
  Log::has_notes(const Report &report) const
  {
    return !report.note.empty() || !new_warnings(report.warnings, told).empty();
  }


  void
  Log::print_notes(const Report &report)
  {
    if (!report.note.empty())
      print("note: {}", report.note);
    for (const auto &text : new_warnings(report.warnings, told))
      print("note: {}", text);
    told = report.warnings;
  }


  void
  Log::write(const std::string &text)
  {
    std::cout << text << std::flush;
    record(text);
  }


  void
  Log::record(const std::string &text)
  {
    if (file.is_open())
      file << text << std::flush;
    else if (speaks)
      early += text;
  }
} // namespace undine
