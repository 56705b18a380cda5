// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files/files.h>
#include <undine/output/files/hdf5_handle.h>
#include <undine/output/files/hdf5_writer.h>
#include <undine/output/files/shared_file.h>

#include <cstring>
#include <numeric>

namespace undine
{
  namespace
  {
    hsize_t
    product(const std::vector<hsize_t> &counts)
    {
      return std::accumulate(counts.begin(), counts.end(), hsize_t(1), std::multiplies<hsize_t>());
    }


    template <class Value>
    void
    write_attribute(HDF5Watch         &watch,
                    const hid_t        file,
                    const std::string &name,
                    const hid_t        type,
                    const Value       &value)
    {
      const HDF5Handle space(watch.check(H5Screate(H5S_SCALAR)), H5Sclose);
      const HDF5Handle attribute(
        watch.check(H5Acreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT)),
        H5Aclose);
      watch.check(H5Awrite(attribute, type, &value));
    }


    /// Make room for an array in a file and tell where it is.
    std::uint64_t
    make_array(HDF5Watch                  &watch,
               const hid_t                 file,
               const std::string          &name,
               const hid_t                 type,
               const std::vector<hsize_t> &size)
    {
      const HDF5Handle links(watch.check(H5Pcreate(H5P_LINK_CREATE)), H5Pclose);
      watch.check(H5Pset_create_intermediate_group(links, 1));
      const HDF5Handle layout(watch.check(H5Pcreate(H5P_DATASET_CREATE)), H5Pclose);
      watch.check(H5Pset_alloc_time(layout, H5D_ALLOC_TIME_EARLY));
      watch.check(H5Pset_fill_time(layout, H5D_FILL_TIME_NEVER));
      const HDF5Handle space(watch.check(H5Screate_simple(size.size(), size.data(), nullptr)),
                             H5Sclose);
      const HDF5Handle data(
        watch.check(H5Dcreate2(file, name.c_str(), type, space, links, layout, H5P_DEFAULT)),
        H5Dclose);
      const haddr_t place = H5Dget_offset(data);
      if (place == HADDR_UNDEF && product(size) > 0 && watch.failure.empty())
        watch.failure = "HDF5 gives no room to '" + name + "'";
      return place;
    }


    /// Call `action(first, position)` for every contiguous row of the box: its first entry in the
    /// whole array, and in the box.
    template <class Action>
    void
    for_each_row(const Selection &box, const Action &action)
    {
      const std::size_t    last = box.count.size() - 1;
      std::vector<hsize_t> index(box.count.size(), 0);
      const hsize_t        n_rows = box.count[last] == 0 ? 0 : product(box.count) / box.count[last];
      for (hsize_t row = 0; row < n_rows; ++row)
        {
          hsize_t first = 0;
          for (std::size_t d = 0; d <= last; ++d)
            first = first * box.size[d] + box.offset[d] + index[d];
          action(first, row * box.count[last]);
          for (std::size_t d = last; d-- > 0;)
            {
              if (++index[d] < box.count[d])
                break;
              index[d] = 0;
            }
        }
    }


    /// The same box with directions joined that are contiguous: fewer and longer rows.
    Selection
    flattened(Selection box)
    {
      while (box.size.size() > 1 && box.offset.back() == 0 && box.count.back() == box.size.back())
        {
          const hsize_t length = box.size.back();
          for (auto *numbers : {&box.size, &box.offset, &box.count})
            {
              numbers->pop_back();
              numbers->back() *= length;
            }
        }
      return box;
    }
  } // namespace


  HDF5Writer::HDF5Writer(const std::filesystem::path &path, const MPI_Comm communicator)
    : path(path)
    , communicator(communicator)
  {
  }


  void
  HDF5Writer::add_attribute(const std::string &name, const double value)
  {
    real_attributes[name] = value;
  }


  void
  HDF5Writer::add_attribute(const std::string &name, const std::uint64_t value)
  {
    whole_attributes[name] = value;
  }


  template <class Value>
  void
  HDF5Writer::add_array(const std::string        &name,
                        const hid_t               type,
                        const Selection          &selection,
                        const std::vector<Value> &values)
  {
    std::vector<char> bytes(values.size() * sizeof(Value));
    if (!values.empty())
      std::memcpy(bytes.data(), values.data(), bytes.size());
    arrays.push_back({name, type, sizeof(Value), selection, std::move(bytes), 0});
  }


  void
  HDF5Writer::add(const std::string         &name,
                  const Selection           &selection,
                  const std::vector<double> &values)
  {
    add_array(name, H5T_NATIVE_DOUBLE, selection, values);
  }


  void
  HDF5Writer::add(const std::string               &name,
                  const Selection                 &selection,
                  const std::vector<unsigned int> &values)
  {
    add_array(name, H5T_NATIVE_UINT, selection, values);
  }


  void
  HDF5Writer::lay_out()
  {
    // HDF5 itself crashes at the program's end after it could not close a file on a full disk.
    std::uintmax_t bytes = 1 << 16;
    for (const auto &array : arrays)
      bytes += (1 << 10) + product(array.selection.size) * array.type_size;
    const auto name = temporary_name(path);
    assert_room(name, bytes);

    HDF5Watch   watch;
    const hid_t file =
      watch.check(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    if (file >= 0)
      {
        for (const auto &attribute : real_attributes)
          write_attribute(watch, file, attribute.first, H5T_NATIVE_DOUBLE, attribute.second);
        for (const auto &attribute : whole_attributes)
          write_attribute(watch, file, attribute.first, H5T_NATIVE_UINT64, attribute.second);
        for (auto &array : arrays)
          array.place = make_array(watch, file, array.name, array.type, array.selection.size);
        watch.check(H5Fclose(file));
      }
    if (!watch.failure.empty())
      throw FileError(cannot_write(path, watch.failure));
  }


  void
  HDF5Writer::write_boxes() const
  {
    SharedFile file(communicator, temporary_name(path));
    for (const auto &array : arrays)
      {
        const auto box    = flattened(array.selection);
        const auto length = box.count.back() * array.type_size;
        for_each_row(box, [&](const hsize_t first, const hsize_t position) {
          file.write_at(array.place + first * array.type_size,
                        array.bytes.data() + position * array.type_size,
                        length);
        });
      }
    file.close();
  }


  void
  HDF5Writer::commit()
  {
    on_first_rank(communicator, [&] { lay_out(); });
    for (auto &array : arrays)
      array.place = dealii::Utilities::MPI::broadcast(communicator, array.place);
    write_boxes();
    on_first_rank(communicator, [&] { put_in_place(path); });
  }
} // namespace undine
