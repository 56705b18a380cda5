// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_files_time_records_h
#define undine_output_files_time_records_h

#include <undine/base/core/clock.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <map>
#include <string>

namespace undine
{
  /// An XML file that lists what was written at which time, such as solution.pvd. It is replaced as
  /// a whole at every new record, so that it is valid at any moment.
  class TimeRecords
  {
  public:
    /// The lines before and after the records.
    struct Frame
    {
      std::string head;
      std::string tail;
    };

    /// Records of an existing file are kept up to the clock's time; with the clock at step 0 there
    /// are none. Collective. Throws FileError.
    TimeRecords(MPI_Comm                     communicator,
                const std::filesystem::path &path,
                const Frame                 &frame,
                const Clock                 &clock);

    /// The lines (ended by a line break) about `time` [s]; those of the same time are replaced.
    /// Collective. Throws FileError.
    void
    add(double time, const std::string &lines);

  private:
    void
    write() const;

    MPI_Comm                      communicator;
    std::filesystem::path         path;
    Frame                         frame;
    std::map<double, std::string> records; ///< on the first rank, by time [s]
  };
} // namespace undine

#endif
