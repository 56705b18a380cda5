// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_files_hdf5_writer_h
#define undine_output_files_hdf5_writer_h

#include <undine/output/files/selection.h>

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace undine
{
  /// Writes an HDF5 file of all ranks' data. The first rank lays out the file; then all ranks write
  /// their boxes at the places that HDF5 tells. (Parallel HDF5 waits for ever when the disk is full
  /// for one rank, and deal.II's classes check return values in debug mode only.) All functions are
  /// collective.
  class HDF5Writer
  {
  public:
    /// For a file at `path`, which commit() writes.
    HDF5Writer(const std::filesystem::path &path, MPI_Comm communicator);

    /// One number that belongs to the file; the same on all ranks. @{
    void
    add_attribute(const std::string &name, double value);
    void
    add_attribute(const std::string &name, std::uint64_t value);
    /// @}

    /// An array from the boxes of all ranks. Folders in `name` ("fluid/pressure") are made. @{
    void
    add(const std::string &name, const Selection &selection, const std::vector<double> &values);
    void
    add(const std::string               &name,
        const Selection                 &selection,
        const std::vector<unsigned int> &values);
    /// @}

    /// Write it all under a temporary name and put it in place. Throws FileError on all ranks; an
    /// older file is then still whole.
    void
    commit();

  private:
    struct Array
    {
      std::string       name;
      hid_t             type;
      std::size_t       type_size; ///< [bytes]
      Selection         selection;
      std::vector<char> bytes;
      std::uint64_t     place = 0; ///< in the file [bytes]
    };

    template <class Value>
    void
    add_array(const std::string        &name,
              hid_t                     type,
              const Selection          &selection,
              const std::vector<Value> &values);

    /// One rank: the whole file but for the numbers in the arrays. Fills Array::place.
    void
    lay_out();

    /// The numbers of all ranks.
    void
    write_boxes() const;

    std::filesystem::path                path;
    MPI_Comm                             communicator;
    std::map<std::string, double>        real_attributes;
    std::map<std::string, std::uint64_t> whole_attributes;
    std::vector<Array>                   arrays;
  };
} // namespace undine

#endif
