// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_files_result_folder_h
#define undine_output_files_result_folder_h

#include <undine/output/files/folder_lock.h>

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace undine
{
  /// The folder of a run's results, and which of the files in it are results of this program.
  ///
  /// Its file `record.txt` lists them, each before it is written for the first time, and says
  /// whether the last run has reached its end. Nothing else in the folder is ever replaced or
  /// removed. All functions are collective and throw FileError on all ranks.
  class ResultFolder
  {
  public:
    /// Makes the folder if there is none and keeps other runs out as long as it lives. Throws if
    /// another run is in it.
    ResultFolder(MPI_Comm communicator, const std::filesystem::path &path);
    ResultFolder(const ResultFolder &) = delete;
    ResultFolder &
    operator=(const ResultFolder &) = delete;

    /// Folders that the constructor has made go if they are still empty.
    ~ResultFolder();

    const std::filesystem::path &
    path() const;

    /// Did the last run in it reach its end? Also true if there was none.
    bool
    is_finished() const;

    /// Throws if files of the names that results have are in the folder, but not in the record:
    /// somebody else's, or of a run whose record is lost.
    void
    assert_nothing_foreign() const;

    /// A new run: removes what earlier ones have written. Throws as assert_nothing_foreign().
    void
    begin();

    /// An earlier run goes on. What is there under the names of results counts as its own.
    void
    go_on();

    /// The run is about to write the file `name` ("solution/fluid_000010.vtu"). Throws if there is
    /// one that no run has written.
    void
    claim(const std::filesystem::path &name);

    /// The run has reached its end.
    void
    finish();

    /// The digest of the rows of `statistics` so far, on the first rank; checkpoints store it to
    /// find the rows that they belong to.
    std::uint64_t statistics_digest = 0;

  private:
    std::filesystem::path
    record() const;
    void
    read_record();
    void
    write_record() const;
    void
    remove_results();
    void
    assert_ours(const std::filesystem::path &name) const;

    MPI_Comm                           communicator;
    std::filesystem::path              folder;
    std::unique_ptr<const FolderLock>  lock;         ///< on the first rank
    std::vector<std::filesystem::path> made_folders; ///< the innermost last
    std::set<std::string>              names;        ///< of files; on the first rank
    bool                               finished = true;
  };
} // namespace undine

#endif
