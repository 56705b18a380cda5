// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files/files.h>
#include <undine/output/files/hdf5_handle.h>
#include <undine/output/files/hdf5_reader.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    template <class Value>
    hid_t
    type();

    template <>
    hid_t
    type<double>()
    {
      return H5T_NATIVE_DOUBLE;
    }

    template <>
    hid_t
    type<unsigned int>()
    {
      return H5T_NATIVE_UINT;
    }

    template <>
    hid_t
    type<std::uint64_t>()
    {
      return H5T_NATIVE_UINT64;
    }


    /// Throws FileError on all ranks if anything failed on any.
    void
    assert_success(const HDF5Watch             &watch,
                   const std::filesystem::path &path,
                   const MPI_Comm               communicator)
    {
      throw_on_all_ranks(
        communicator,
        watch.failure.empty() ? "" : "cannot read '" + path.string() + "': " + watch.failure);
    }


    std::vector<hsize_t>
    size_of(HDF5Watch &watch, const hid_t space)
    {
      std::vector<hsize_t> size(std::max(0, watch.check(H5Sget_simple_extent_ndims(space))));
      if (!size.empty())
        watch.check(H5Sget_simple_extent_dims(space, size.data(), nullptr));
      return size;
    }
  } // namespace


  HDF5Reader::HDF5Reader(const std::filesystem::path &path, const MPI_Comm communicator)
    : path(path)
    , communicator(communicator)
  {
    HDF5Watch watch;
    file = watch.check(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
    try
      {
        assert_success(watch, path, communicator);
      }
    catch (const FileError &)
      {
        if (file >= 0)
          H5Fclose(file);
        throw;
      }
  }


  HDF5Reader::~HDF5Reader()
  {
    HDF5Watch watch;
    H5Fclose(file);
  }


  template <class Value>
  Value
  HDF5Reader::attribute(const std::string &name) const
  {
    HDF5Watch watch;
    Value     value{};
    {
      const HDF5Handle attribute(watch.check(H5Aopen(file, name.c_str(), H5P_DEFAULT)), H5Aclose);
      watch.check(H5Aread(attribute, type<Value>(), &value));
    }
    assert_success(watch, path, communicator);
    return value;
  }


  bool
  HDF5Reader::contains(const std::string &name) const
  {
    HDF5Watch watch;
    bool      found = true;
    // H5Lexists looks at the last link of a path only: every folder must be asked for.
    for (std::size_t end = name.find('/'); found; end = name.find('/', end + 1))
      {
        found = watch.check(H5Lexists(file, name.substr(0, end).c_str(), H5P_DEFAULT)) > 0;
        if (end == std::string::npos)
          break;
      }
    assert_success(watch, path, communicator);
    return found;
  }


  std::vector<hsize_t>
  HDF5Reader::size(const std::string &name) const
  {
    HDF5Watch            watch;
    std::vector<hsize_t> result;
    {
      const HDF5Handle data(watch.check(H5Dopen2(file, name.c_str(), H5P_DEFAULT)), H5Dclose);
      const HDF5Handle space(watch.check(H5Dget_space(data)), H5Sclose);
      result = size_of(watch, space);
    }
    assert_success(watch, path, communicator);
    return result;
  }


  template <class Value>
  std::vector<Value>
  HDF5Reader::read(const std::string &name, const Selection &selection) const
  {
    hsize_t count = 1;
    for (const auto n : selection.count)
      count *= n;
    HDF5Watch          watch;
    std::vector<Value> values(count);
    {
      const HDF5Handle data(watch.check(H5Dopen2(file, name.c_str(), H5P_DEFAULT)), H5Dclose);
      const HDF5Handle space(watch.check(H5Dget_space(data)), H5Sclose);
      if (watch.failure.empty() && size_of(watch, space) != selection.size)
        watch.failure = "'" + name + "' has another size than this scene gives it";
      if (watch.failure.empty() && count > 0)
        {
          watch.check(H5Sselect_hyperslab(space,
                                          H5S_SELECT_SET,
                                          selection.offset.data(),
                                          nullptr,
                                          selection.count.data(),
                                          nullptr));
          const HDF5Handle memory(watch.check(H5Screate_simple(1, &count, nullptr)), H5Sclose);
          watch.check(H5Dread(data, type<Value>(), memory, space, H5P_DEFAULT, values.data()));
        }
    }
    assert_success(watch, path, communicator);
    return values;
  }


  template double
  HDF5Reader::attribute(const std::string &) const;
  template std::uint64_t
  HDF5Reader::attribute(const std::string &) const;
  template std::vector<double>
  HDF5Reader::read(const std::string &, const Selection &) const;
  template std::vector<unsigned int>
  HDF5Reader::read(const std::string &, const Selection &) const;
} // namespace undine
