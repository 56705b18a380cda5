// SPDX-License-Identifier: LGPL-2.1-or-later
#include "find_device.h"

#include <cuda_runtime_api.h>

namespace undine::particles
{
  std::string
  reason_without_device(const unsigned int device)
  {
    int  n      = 0;
    auto status = cudaGetDeviceCount(&n);
    if (status == cudaSuccess && n == 0)
      status = cudaErrorNoDevice;
    if (status == cudaSuccess)
      return device < static_cast<unsigned int>(n) ?
               "" :
               "there is no graphics processor number " + std::to_string(device) + " here; there " +
                 (n == 1 ? "is 1" : "are " + std::to_string(n)) + ", numbered from 0.";
    return std::string("the executor 'device' needs an NVIDIA graphics processor with its driver, "
                       "and there is none here (") +
           cudaGetErrorString(status) + "). Choose the executor 'host'.";
  }
} // namespace undine::particles
