// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_device_kernels_cuh
#define undine_cuda_device_kernels_cuh

#include "device_team.cuh"

#include <nv/target>

namespace undine::particles
{
  namespace kernels
  {
    constexpr int for_each_threads = 128;
    constexpr int team_threads     = 512; ///< of a large team, at most
    constexpr int few_threads      = 64;  ///< of a small team, each with many registers

    /// Lets the next pass get ready while this one runs, and waits until the last one is done: the
    /// time that a launch takes is hidden. Not in kernels with shared memory: of a multiprocessor
    /// that starts the next pass while it has some of them, that pass gets only the small first
    /// cache that they leave, until it ends.
    __device__ __forceinline__ void
    line_up()
    {
      NV_IF_TARGET(NV_PROVIDES_SM_90,
                   (cudaTriggerProgrammaticLaunchCompletion(); cudaGridDependencySynchronize();))
    }

    __device__ __forceinline__ void
    wait_for_last_pass()
    {
      NV_IF_TARGET(NV_PROVIDES_SM_90, (cudaGridDependencySynchronize();))
    }

    template <class Function>
    __global__ void
    __launch_bounds__(for_each_threads) for_each(const int n, const Function f)
    {
      line_up();
      const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
      if (i < n)
        f(i);
    }

    /// Room in shared memory, in which the numbers of a thread's neighbours lie between its own.
    template <class Number>
    struct Room
    {
      Number *first;

      __device__ __forceinline__ Number &
      operator[](const int k) const
      {
        return first[k * for_each_threads];
      }
    };

    template <int size, class Number, class Function>
    __global__ void
    __launch_bounds__(for_each_threads) for_each_with_room(const int n, const Function f)
    {
      __shared__ Number rooms[size * for_each_threads];
      wait_for_last_pass();
      const int    i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
      Room<Number> room{rooms + threadIdx.x};
      if (i < n)
        f(i, room);
    }

    template <class Function, int threads, int blocks>
    __global__ void
    __launch_bounds__(threads, blocks)
      run(const __grid_constant__ Function f, const DeviceTeam::Workspace workspace)
    {
      __shared__ Sums<DeviceTeam::most_sums> of_warps[DeviceTeam::most_warps];
      DeviceTeam                             team(workspace, of_warps);
      f(team);
    }
  } // namespace kernels
} // namespace undine::particles

#endif
