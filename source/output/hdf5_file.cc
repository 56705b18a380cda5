// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files.h>
#include <undine/output/hdf5_file.h>

#include <algorithm>
#include <utility>

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


    /// Remembers HDF5's innermost reason instead of printing it.
    class Watch
    {
    public:
      Watch()
      {
        H5Eget_auto2(H5E_DEFAULT, &printer, &data);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      }

      ~Watch()
      {
        H5Eset_auto2(H5E_DEFAULT, printer, data);
      }

      /// HDF5 says that something failed by a negative number.
      template <class Result>
      Result
      check(const Result result)
      {
        if (result < 0 && failure.empty())
          {
            failure = "HDF5 reports an error";
            H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, &innermost, &failure);
          }
        return result;
      }

      std::string failure;

    private:
      static herr_t
      innermost(const unsigned int depth, const H5E_error2_t *error, void *text)
      {
        if (depth == 0 && error->desc != nullptr)
          *static_cast<std::string *>(text) = error->desc;
        return 0;
      }

      H5E_auto2_t printer = nullptr;
      void       *data    = nullptr;
    };


    /// A thing of HDF5 that is released at the end of its scope.
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*release)(hid_t))
        : id(id)
        , release(release)
      {
      }

      Handle(const Handle &) = delete;
      Handle &
      operator=(const Handle &) = delete;

      ~Handle()
      {
        if (id >= 0)
          release(id);
      }

      operator hid_t() const
      {
        return id;
      }

    private:
      hid_t id;
      herr_t (*release)(hid_t);
    };


    Handle
    parallel_access(Watch &watch, const MPI_Comm communicator)
    {
      const hid_t list = watch.check(H5Pcreate(H5P_FILE_ACCESS));
      watch.check(H5Pset_fapl_mpio(list, communicator, MPI_INFO_NULL));
      return Handle(list, H5Pclose);
    }


    Handle
    collective_transfer(Watch &watch)
    {
      const hid_t list = watch.check(H5Pcreate(H5P_DATASET_XFER));
      watch.check(H5Pset_dxpl_mpio(list, H5FD_MPIO_COLLECTIVE));
      return Handle(list, H5Pclose);
    }


    hsize_t
    product(const std::vector<hsize_t> &counts)
    {
      hsize_t result = 1;
      for (const auto count : counts)
        result *= count;
      return result;
    }


    /// Select the rank's box of the space of the whole array.
    void
    select(Watch &watch, const hid_t space, const HDF5File::Selection &selection)
    {
      if (product(selection.count) == 0)
        watch.check(H5Sselect_none(space));
      else
        watch.check(H5Sselect_hyperslab(space,
                                        H5S_SELECT_SET,
                                        selection.offset.data(),
                                        nullptr,
                                        selection.count.data(),
                                        nullptr));
    }


    /// The space of the rank's values in memory.
    Handle
    memory_space(Watch &watch, const HDF5File::Selection &selection)
    {
      const hsize_t size  = product(selection.count);
      const hsize_t shown = std::max<hsize_t>(size, 1);
      const hid_t   space = watch.check(H5Screate_simple(1, &shown, nullptr));
      if (size == 0)
        watch.check(H5Sselect_none(space));
      return Handle(space, H5Sclose);
    }


    std::vector<hsize_t>
    size_of(Watch &watch, const hid_t space)
    {
      std::vector<hsize_t> size(std::max(0, watch.check(H5Sget_simple_extent_ndims(space))));
      if (!size.empty())
        watch.check(H5Sget_simple_extent_dims(space, size.data(), nullptr));
      return size;
    }


    std::string
    cannot_read(const std::filesystem::path &path, const std::string &reason)
    {
      return "cannot read '" + path.string() + "': " + reason;
    }
  } // namespace


  HDF5File::HDF5File(const hid_t file, const std::filesystem::path &path, MPI_Comm communicator)
    : file(file)
    , path(path)
    , communicator(communicator)
  {
  }


  HDF5File::HDF5File(HDF5File &&other) noexcept
    : file(std::exchange(other.file, -1))
    , path(std::move(other.path))
    , communicator(other.communicator)
  {
  }


  HDF5File::~HDF5File()
  {
    Watch watch;
    if (file >= 0)
      H5Fclose(file);
  }


  HDF5File
  HDF5File::create(const std::filesystem::path &path, const MPI_Comm communicator)
  {
    Watch       watch;
    const auto  access = parallel_access(watch, communicator);
    const hid_t file   = watch.check(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access));
    throw_on_all_ranks(communicator,
                       watch.failure.empty() ? "" : cannot_write(path, watch.failure));
    return HDF5File(file, path, communicator);
  }


  HDF5File
  HDF5File::open(const std::filesystem::path &path, const MPI_Comm communicator)
  {
    Watch       watch;
    const auto  access = parallel_access(watch, communicator);
    const hid_t file   = watch.check(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access));
    throw_on_all_ranks(communicator, watch.failure.empty() ? "" : cannot_read(path, watch.failure));
    return HDF5File(file, path, communicator);
  }


  template <class Value>
  void
  HDF5File::write_attribute(const std::string &name, const Value &value)
  {
    Watch watch;
    {
      const Handle space(watch.check(H5Screate(H5S_SCALAR)), H5Sclose);
      const Handle attribute(
        watch.check(H5Acreate2(file, name.c_str(), type<Value>(), space, H5P_DEFAULT, H5P_DEFAULT)),
        H5Aclose);
      watch.check(H5Awrite(attribute, type<Value>(), &value));
    }
    throw_on_all_ranks(communicator,
                       watch.failure.empty() ? "" : cannot_write(path, watch.failure));
  }


  template <class Value>
  Value
  HDF5File::read_attribute(const std::string &name) const
  {
    Watch watch;
    Value value{};
    {
      const Handle attribute(watch.check(H5Aopen(file, name.c_str(), H5P_DEFAULT)), H5Aclose);
      watch.check(H5Aread(attribute, type<Value>(), &value));
    }
    throw_on_all_ranks(communicator, watch.failure.empty() ? "" : cannot_read(path, watch.failure));
    return value;
  }


  template <class Value>
  void
  HDF5File::write(const std::string        &name,
                  const Selection          &selection,
                  const std::vector<Value> &values)
  {
    Watch watch;
    {
      const Handle links(watch.check(H5Pcreate(H5P_LINK_CREATE)), H5Pclose);
      watch.check(H5Pset_create_intermediate_group(links, 1));
      const Handle space(
        watch.check(H5Screate_simple(selection.size.size(), selection.size.data(), nullptr)),
        H5Sclose);
      const Handle data(
        watch.check(
          H5Dcreate2(file, name.c_str(), type<Value>(), space, links, H5P_DEFAULT, H5P_DEFAULT)),
        H5Dclose);
      select(watch, space, selection);
      const auto memory   = memory_space(watch, selection);
      const auto transfer = collective_transfer(watch);
      watch.check(H5Dwrite(data, type<Value>(), memory, space, transfer, values.data()));
    }
    throw_on_all_ranks(communicator,
                       watch.failure.empty() ? "" : cannot_write(path, watch.failure));
  }


  template <class Value>
  std::vector<Value>
  HDF5File::read(const std::string &name, const Selection &selection) const
  {
    Watch              watch;
    std::vector<Value> values(product(selection.count));
    {
      const Handle data(watch.check(H5Dopen2(file, name.c_str(), H5P_DEFAULT)), H5Dclose);
      const Handle space(watch.check(H5Dget_space(data)), H5Sclose);
      if (watch.failure.empty() && size_of(watch, space) != selection.size)
        watch.failure = "'" + name + "' has another size than this scene gives it";
      if (watch.failure.empty())
        {
          select(watch, space, selection);
          const auto memory   = memory_space(watch, selection);
          const auto transfer = collective_transfer(watch);
          watch.check(H5Dread(data, type<Value>(), memory, space, transfer, values.data()));
        }
    }
    throw_on_all_ranks(communicator, watch.failure.empty() ? "" : cannot_read(path, watch.failure));
    return values;
  }


  bool
  HDF5File::contains(const std::string &name) const
  {
    Watch watch;
    bool  found = true;
    // H5Lexists looks at the last link of a path only: every folder must be asked for.
    for (std::size_t end = name.find('/'); found; end = name.find('/', end + 1))
      {
        found = watch.check(H5Lexists(file, name.substr(0, end).c_str(), H5P_DEFAULT)) > 0;
        if (end == std::string::npos)
          break;
      }
    throw_on_all_ranks(communicator, watch.failure.empty() ? "" : cannot_read(path, watch.failure));
    return found;
  }


  std::vector<hsize_t>
  HDF5File::size(const std::string &name) const
  {
    Watch                watch;
    std::vector<hsize_t> result;
    {
      const Handle data(watch.check(H5Dopen2(file, name.c_str(), H5P_DEFAULT)), H5Dclose);
      const Handle space(watch.check(H5Dget_space(data)), H5Sclose);
      result = size_of(watch, space);
    }
    throw_on_all_ranks(communicator, watch.failure.empty() ? "" : cannot_read(path, watch.failure));
    return result;
  }


  void
  HDF5File::close()
  {
    Watch watch;
    watch.check(H5Fflush(file, H5F_SCOPE_LOCAL));
    watch.check(H5Fclose(std::exchange(file, -1)));
    throw_on_all_ranks(communicator,
                       watch.failure.empty() ? "" : cannot_write(path, watch.failure));
  }


  template void
  HDF5File::write_attribute(const std::string &, const double &);
  template void
  HDF5File::write_attribute(const std::string &, const std::uint64_t &);
  template double
  HDF5File::read_attribute(const std::string &) const;
  template std::uint64_t
  HDF5File::read_attribute(const std::string &) const;
  template void
  HDF5File::write(const std::string &, const Selection &, const std::vector<double> &);
  template void
  HDF5File::write(const std::string &, const Selection &, const std::vector<unsigned int> &);
  template void
  HDF5File::write(const std::string &, const Selection &, const std::vector<std::uint64_t> &);
  template std::vector<double>
  HDF5File::read(const std::string &, const Selection &) const;
  template std::vector<unsigned int>
  HDF5File::read(const std::string &, const Selection &) const;
  template std::vector<std::uint64_t>
  HDF5File::read(const std::string &, const Selection &) const;
} // namespace undine
