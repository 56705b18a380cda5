// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_hdf5_file_h
#define undine_output_hdf5_file_h

#include <deal.II/base/mpi.h>

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <vector>

namespace undine
{
  /// An HDF5 file that all ranks write or read together. Every function is collective and throws
  /// FileError on all ranks if it fails on any; HDF5 itself prints nothing. (deal.II's classes for
  /// HDF5 check return values in debug mode only, where they abort: a full disk would pass
  /// unnoticed.)
  class HDF5File
  {
  public:
    /// A box of an array, the last direction running fastest.
    struct Selection
    {
      std::vector<hsize_t> size;   ///< of the whole array
      std::vector<hsize_t> offset; ///< first entry of this rank
      std::vector<hsize_t> count;  ///< entries of this rank; 0: none
    };

    /// A new file, in place of one of this name.
    static HDF5File
    create(const std::filesystem::path &path, MPI_Comm communicator);

    /// An existing file, for reading.
    static HDF5File
    open(const std::filesystem::path &path, MPI_Comm communicator);

    HDF5File(HDF5File &&other) noexcept;
    HDF5File(const HDF5File &) = delete;
    HDF5File &
    operator=(const HDF5File &) = delete;

    /// Closes without a word if close() was not called.
    ~HDF5File();

    /// One number that belongs to the file; the same on all ranks. Value: double, std::uint64_t. @{
    template <class Value>
    void
    write_attribute(const std::string &name, const Value &value);
    template <class Value>
    Value
    read_attribute(const std::string &name) const;
    /// @}

    /// A new array from the boxes of all ranks. Value: double, unsigned int, std::uint64_t. Folders
    /// in `name` ("fluid/pressure") are made.
    template <class Value>
    void
    write(const std::string &name, const Selection &selection, const std::vector<Value> &values);

    /// This rank's box of an array. Throws also if the array has another size.
    template <class Value>
    std::vector<Value>
    read(const std::string &name, const Selection &selection) const;

    bool
    contains(const std::string &name) const;

    /// Of a whole array.
    std::vector<hsize_t>
    size(const std::string &name) const;

    /// Everything is in the file when this returns.
    void
    close();

  private:
    HDF5File(hid_t file, const std::filesystem::path &path, MPI_Comm communicator);

    hid_t                 file;
    std::filesystem::path path;
    MPI_Comm              communicator;
  };
} // namespace undine

#endif
