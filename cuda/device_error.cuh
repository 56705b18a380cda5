// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_device_error_cuh
#define undine_cuda_device_error_cuh

#include <undine/base/core/errors.h>

#include <cuda_runtime.h>

#include <string>

namespace undine::particles
{
  /// Throws what an error of the device means for the user: InputError for what a different scene
  /// or machine would help with, SolveError for the rest.
  inline void
  check_device(const cudaError_t status, const std::string &doing)
  {
    if (status == cudaSuccess)
      return;
    const std::string reason = cudaGetErrorString(status);
    switch (status)
      {
        case cudaErrorNoKernelImageForDevice:
        case cudaErrorInvalidDeviceFunction:
        case cudaErrorUnsupportedPtxVersion:
          throw InputError("this program was not built for the graphics processor of this machine "
                           "(" +
                           reason +
                           "). Configure it with CMAKE_CUDA_ARCHITECTURES set to the processor's, "
                           "or choose the executor 'host'.");
        case cudaErrorCooperativeLaunchTooLarge:
          throw InputError("the graphics processor cannot hold all workers of a pass at once (" +
                           reason +
                           "): is another program using it? Or choose the executor 'host'.");
        default:
          throw SolveError("the device failed " + doing + ": " + reason +
                           ". The executor 'host' does the same without it.");
      }
  }
} // namespace undine::particles

#endif
