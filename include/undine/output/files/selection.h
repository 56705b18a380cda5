// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_files_selection_h
#define undine_output_files_selection_h

#include <hdf5.h>

#include <vector>

namespace undine
{
  /// This rank's box of an array, the last direction running fastest.
  struct Selection
  {
    std::vector<hsize_t> size;   ///< of the whole array
    std::vector<hsize_t> offset; ///< first entry of this rank
    std::vector<hsize_t> count;  ///< entries of this rank; 0: none
  };
} // namespace undine

#endif
