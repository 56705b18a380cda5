// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_find_device_h
#define undine_cuda_find_device_h

#include <string>

namespace undine::particles
{
  /// Why there is no device of this number (from 0 on) to compute on, and what to do; empty if there
  /// is one.
  std::string
  reason_without_device(unsigned int device);
} // namespace undine::particles

#endif
