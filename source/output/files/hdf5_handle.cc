// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/files/hdf5_handle.h>

namespace undine
{
  HDF5Watch::HDF5Watch()
  {
    H5Eget_auto2(H5E_DEFAULT, &printer, &data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }


  HDF5Watch::~HDF5Watch()
  {
    H5Eset_auto2(H5E_DEFAULT, printer, data);
  }


  std::string
  HDF5Watch::innermost_reason()
  {
    std::string reason = "HDF5 reports an error";
    const auto  keep   = [](const unsigned int depth, const H5E_error2_t *error, void *text) {
      if (depth == 0 && error->desc != nullptr)
        *static_cast<std::string *>(text) = error->desc;
      return herr_t(0);
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep, &reason);
    return reason;
  }
} // namespace undine
