// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_log_h
#define undine_driver_log_h

#include <undine/coupled/state/report.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace undine
{
  /// The messages of a run to the user: standard output and log.txt, from the first rank only.
  class Log
  {
  public:
    explicit Log(MPI_Comm communicator);

    /// Also write to DIRECTORY/log.txt, what was printed so far included; after what is there if
    /// `mode` is std::ios::app. Collective. Throws FileError on all ranks if it cannot be opened.
    void
    open(const std::filesystem::path &directory, std::ios::openmode mode);

    /// A line, formatted by {fmt}; nothing on other ranks than the first.
    template <class... Values>
    void
    print(fmt::format_string<Values...> format, Values &&...values)
    {
      if (speaks)
        write(fmt::format(format, std::forward<Values>(values)...) + "\n");
    }

    /// Has `report` something for print_notes()?
    bool
    has_notes(const Report &report) const;

    /// The note and the warnings of `report`; a warning only if the report before had none of the
    /// same subject.
    void
    print_notes(const Report &report);

    /// To log.txt only: what is printed elsewhere but belongs to the history of the run.
    void
    record(const std::string &text);

  private:
    void
    write(const std::string &text);

    MPI_Comm                     communicator;
    bool                         speaks;
    std::string                  early; ///< printed before the file was open
    std::ofstream                file;
    std::vector<Report::Warning> told; ///< of the last report
  };
} // namespace undine

#endif
