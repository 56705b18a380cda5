// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_resident_kernel_cuh
#define undine_cuda_resident_kernel_cuh

#include "device_team.cuh"
#include "resident_gradients.cuh"
#include "resident_setup.cuh"

namespace undine::particles
{
  namespace kernels
  {
    constexpr int resident_threads = 512;

    /// Falls back to the general solver where the system does not fit.
    template <class Value>
    __global__ void
    __launch_bounds__(resident_threads, 1)
      solve_resident(const __grid_constant__ ConjugateGradients<float, PackedEntry, Value> general,
                     const BlockExchange::Workspace exchanged,
                     const DeviceTeam::Workspace    team_workspace,
                     const int                      room,
                     unsigned int                  *outside,
                     const int                      room_outside)
    {
      using Solver = ResidentGradients<Value>;
      extern __shared__ __align__(16) char memory[];
      __shared__ typename Solver::Shared   shared;
      if (general.control->done())
        return;
      BlockExchange exchange(exchanged);
      ResidentSetup setup(general.system.matrix, exchange, memory, room, outside, room_outside);
      if (setup.fill(Solver::per_local, Solver::per_own))
        Solver(general, setup.rows, setup.vectors, exchange, shared)();
      else
        {
          DeviceTeam team(team_workspace, reinterpret_cast<Sums<DeviceTeam::most_sums> *>(memory));
          general(team);
        }
    }
  } // namespace kernels
} // namespace undine::particles

#endif
