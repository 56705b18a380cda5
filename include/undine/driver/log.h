// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_log_h
#define undine_driver_log_h

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace undine
{
  /// What the user reads during a run: the screen and log.txt, from the first rank only.
  class Log
  {
  public:
    explicit Log(MPI_Comm communicator);

    /// Also write to DIRECTORY/log.txt from now on, after what is there if `mode` is std::ios::app.
    /// Throws FileError on all ranks if it cannot be opened.
    void
    open(const std::filesystem::path &directory, std::ios::openmode mode);

    template <class... Values>
    void
    print(fmt::format_string<Values...> format, Values &&...values)
    {
      if (speaks)
        write(fmt::format(format, std::forward<Values>(values)...) + "\n");
    }

  private:
    void
    write(const std::string &text);

    MPI_Comm      communicator;
    bool          speaks;
    std::ofstream file;
  };
} // namespace undine

#endif
