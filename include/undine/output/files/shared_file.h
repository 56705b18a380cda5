// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_files_shared_file_h
#define undine_output_files_shared_file_h

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace undine
{
  /// A file that all ranks write at places of their own, each for itself. (MPI's files are no help
  /// here: Open MPI says nothing of a write that a full disk cut short.)
  class SharedFile
  {
  public:
    /// The file may exist. Collective. Throws FileError on all ranks.
    SharedFile(MPI_Comm communicator, const std::filesystem::path &path);
    SharedFile(const SharedFile &) = delete;
    SharedFile &
    operator=(const SharedFile &) = delete;
    ~SharedFile();

    /// Nothing is in the file. Collective. Throws FileError on all ranks.
    void
    make_empty();

    /// `size` [bytes] from `data`, `place` [bytes] from the beginning. An error is kept for
    /// close().
    void
    write_at(std::uint64_t place, const char *data, std::size_t size);

    /// The data of all ranks have reached the disk when this returns. Collective. Throws FileError
    /// on all ranks if one could not write.
    void
    close();

  private:
    MPI_Comm              communicator;
    std::filesystem::path path;
    int                   descriptor;
    std::string           failure; ///< of this rank; empty: none
  };

  /// Write a file whose text is that of all ranks, one after the other, by parallel input and
  /// output. Collective. Throws FileError on all ranks; an older file is then still whole.
  void
  write_file_together(MPI_Comm                     communicator,
                      const std::filesystem::path &path,
                      const std::string           &text);
} // namespace undine

#endif
