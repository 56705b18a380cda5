// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_files_folder_lock_h
#define undine_output_files_folder_lock_h

#include <filesystem>

namespace undine
{
  /// Keeps other runs out of a folder as long as it lives: the file `lock` in it names the host and
  /// the process, which also holds it locked for the operating system (flock). What a process that
  /// was killed leaves behind is taken over on the same host. One rank.
  class FolderLock
  {
  public:
    /// Throws FileError if another run is in the folder, or was, on another host: whether that one
    /// goes on cannot be known.
    explicit FolderLock(const std::filesystem::path &folder);
    FolderLock(const FolderLock &) = delete;
    FolderLock &
    operator=(const FolderLock &) = delete;
    ~FolderLock();

  private:
    std::filesystem::path file;
    int                   descriptor;
  };
} // namespace undine

#endif
