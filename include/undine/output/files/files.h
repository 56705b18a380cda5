// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_files_files_h
#define undine_output_files_files_h

#include <undine/base/core/errors.h>

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace undine
{
  /// Throws FileError on all ranks, with the first rank's text, if `failure` is not empty on any.
  /// Collective.
  void
  throw_on_all_ranks(MPI_Comm communicator, const std::string &failure);

  /// Run `action` on the first rank; what it throws becomes a FileError on every rank. Collective.
  template <class Action>
  void
  on_first_rank(MPI_Comm communicator, const Action &action)
  {
    std::string failure;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      try
        {
          action();
        }
      catch (const std::exception &error)
        {
          failure = error.what();
        }
    throw_on_all_ranks(communicator, failure);
  }

  /// "cannot write 'PATH': REASON. Check ...": what the user can do about a file.
  std::string
  cannot_write(const std::filesystem::path &path, const std::string &reason);

  /// Make a folder and those above it. Throws FileError. One rank.
  void
  make_folder(const std::filesystem::path &path);

  /// The name under which a file is written before it is whole.
  std::filesystem::path
  temporary_name(const std::filesystem::path &path);

  /// Throws FileError if there is no room for a file of this size; an empty one is left at `path`.
  /// One rank.
  void
  assert_room(const std::filesystem::path &path, std::uintmax_t bytes);

  /// Returns when a file is on the disk, as far as it has been written. Throws FileError. One rank.
  void
  reach_disk(const std::filesystem::path &path);

  /// Move what was written under temporary_name(path) to `path`, after it has reached the disk: at
  /// any moment, also if the machine stops, `path` is the old file or the new one. Throws
  /// FileError. One rank.
  void
  put_in_place(const std::filesystem::path &path);

  /// Write a whole file under a temporary name, then put it in place. Throws FileError. One rank.
  void
  write_file(const std::filesystem::path &path, const std::string &text);

  /// Append to a file; the text is in the file, as a whole, when this returns. Throws FileError.
  /// One rank.
  void
  append_to_file(const std::filesystem::path &path, const std::string &text);

  /// The text of a file. Throws FileError. One rank.
  std::string
  read_file(const std::filesystem::path &path);

  /// A number that changes with every byte of a text; 0 is that of an empty one. The text may be
  /// given in pieces: `before` is that of the pieces so far [FNV-1a, 64 bits; G. Fowler, L. Noll,
  /// K.-P. Vo].
  std::uint64_t
  digest(std::uint64_t before, const std::string &text);

  /// The number that a line of the file at `path` begins with. Throws FileError if there is none.
  double
  leading_number(const std::string &line, const std::filesystem::path &path);
} // namespace undine

#endif
