// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_files_hdf5_reader_h
#define undine_output_files_hdf5_reader_h

#include <undine/output/files/selection.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <string>
#include <vector>

namespace undine
{
  /// Reads an HDF5 file on all ranks. All functions are collective and throw FileError on all ranks
  /// if they fail on any; HDF5 itself prints nothing.
  class HDF5Reader
  {
  public:
    /// Opens the file.
    HDF5Reader(const std::filesystem::path &path, MPI_Comm communicator);
    HDF5Reader(const HDF5Reader &) = delete;
    HDF5Reader &
    operator=(const HDF5Reader &) = delete;
    ~HDF5Reader();

    /// The number of this name that belongs to the file. Value: double, std::uint64_t.
    template <class Value>
    Value
    attribute(const std::string &name) const;

    /// Is there an array of this name?
    bool
    contains(const std::string &name) const;

    /// The size of a whole array in each direction.
    std::vector<hsize_t>
    size(const std::string &name) const;

    /// This rank's box of an array. Throws also if the array has another size. Value: double,
    /// unsigned int.
    template <class Value>
    std::vector<Value>
    read(const std::string &name, const Selection &selection) const;

  private:
    hid_t                 file;
    std::filesystem::path path;
    MPI_Comm              communicator;
  };
} // namespace undine

#endif
