// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_statistics_file_h
#define undine_output_statistics_file_h

#include <undine/base/core/column.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <string>

namespace undine
{
  /// The numbers of every step as text: a header `# N: name [unit]` for each column, then one row
  /// for each step. Only what follows from the scene: no seconds, dates, paths or ranks, so that
  /// two files can be compared. The first column is the step.
  class StatisticsFile
  {
  public:
    /// Rows of steps up to `last_step` are kept, later ones and a torn last one are dropped; with
    /// `last_step` 0 the file starts anew. Collective. Throws FileError.
    StatisticsFile(MPI_Comm                     communicator,
                   const std::filesystem::path &path,
                   unsigned int                 last_step);

    /// Can a run that has reached `last_step` go on in the file at `path`? Throws FileError if it
    /// has other columns than `columns`, or if its rows until then are not those that were written:
    /// not one for each step, or of another digest than `expected_digest` (0: not known). Without
    /// a file it can. Collective.
    static void
    assert_continues(MPI_Comm                     communicator,
                     const std::filesystem::path &path,
                     unsigned int                 last_step,
                     const Columns               &columns,
                     std::uint64_t                expected_digest);

    /// Append one row, and the header if there is none. Collective; the columns must be the same on
    /// all ranks. Throws SolveError, and writes nothing, if a value is not finite; FileError.
    void
    append(const Columns &columns);

    /// The digest of header and rows so far, on the first rank; 0 elsewhere and without rows.
    std::uint64_t
    digest() const;

  private:
    MPI_Comm              communicator;
    std::filesystem::path path;
    std::string           header; ///< in the file; empty: not yet
    std::uint64_t         text_digest = 0;
  };
} // namespace undine

#endif
