// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_files_hdf5_handle_h
#define undine_output_files_hdf5_handle_h

#include <hdf5.h>

#include <string>

namespace undine
{
  /// Remembers HDF5's innermost reason for a failure, as long as it exists, instead of printing it.
  class HDF5Watch
  {
  public:
    /// HDF5 prints nothing from here on.
    HDF5Watch();
    HDF5Watch(const HDF5Watch &) = delete;
    HDF5Watch &
    operator=(const HDF5Watch &) = delete;
    ~HDF5Watch();

    /// HDF5 says by a negative number that something failed.
    template <class Result>
    Result
    check(const Result result)
    {
      if (result < 0 && failure.empty())
        failure = innermost_reason();
      return result;
    }

    std::string failure; ///< the first one; empty: none

  private:
    static std::string
    innermost_reason();

    H5E_auto2_t printer = nullptr;
    void       *data    = nullptr;
  };


  /// A thing of HDF5 that is released at the end of its scope.
  class HDF5Handle
  {
  public:
    HDF5Handle(const hid_t id, herr_t (*release)(hid_t))
      : id(id)
      , release(release)
    {
    }

    HDF5Handle(const HDF5Handle &) = delete;
    HDF5Handle &
    operator=(const HDF5Handle &) = delete;

    ~HDF5Handle()
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
} // namespace undine

#endif
