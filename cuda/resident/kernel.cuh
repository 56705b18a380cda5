// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_resident_kernel_cuh
#define undine_cuda_resident_kernel_cuh

#include "device_team.cuh"
#include "resident/gradients.cuh"
#include "resident/setup.cuh"

namespace undine::particles
{
  namespace kernels
  {
    constexpr int resident_threads = BlockSums<1>::threads;

    /// Falls back to the general solver where the system does not fit.
    template <class Value, class Correction>
    __device__ __forceinline__ void
    solve_resident(const ConjugateGradients<float, PackedEntry, Value> &general,
                   BlockExchange                                       &exchange,
                   Correction                                          &correction,
                   const DeviceTeam::Workspace                         &team_workspace,
                   const ResidentRoom                                  &room)
    {
      using Solver = ResidentGradients<Value, Correction>;
      extern __shared__ __align__(16) char         memory[];
      __shared__ typename Solver::Shared           shared;
      ResidentSetup<Correction, Solver::most_held> setup(
        general.system.matrix, exchange, correction, memory, room);
      if (setup.fill(Solver::per_local, Solver::per_own))
        {
          if constexpr (Correction::exists)
            correction.invert(exchange, setup.reach, setup.vectors);
          Solver(general, setup.rows, correction, setup.vectors, exchange, shared)();
        }
      else
        {
          DeviceTeam team(team_workspace, reinterpret_cast<Sums<DeviceTeam::most_sums> *>(memory));
          general(team);
        }
    }

    template <class Value>
    __global__ void
    __launch_bounds__(resident_threads, 1)
      solve_plain(const __grid_constant__ ConjugateGradients<float, PackedEntry, Value> general,
                  const BlockExchange::Workspace                                        exchanged,
                  const DeviceTeam::Workspace team_workspace,
                  const ResidentRoom          room)
    {
      if (general.control->done())
        return;
      BlockExchange exchange(exchanged);
      NoCorrection  none;
      solve_resident(general, exchange, none, team_workspace, room);
    }

    /// With CoarseCorrection, whose aggregates are the rows of `each` blocks.
    template <class Value>
    __global__ void
    __launch_bounds__(resident_threads, 1)
      solve_corrected(const __grid_constant__ ConjugateGradients<float, PackedEntry, Value> general,
                      const BlockExchange::Workspace exchanged,
                      const DeviceTeam::Workspace    team_workspace,
                      const ResidentRoom             room,
                      const int                      each)
    {
      __shared__ CoarseCorrection::Shared shared;
      if (general.control->done())
        return;
      BlockExchange    exchange(exchanged);
      CoarseCorrection correction(shared, general.system, each);
      solve_resident(general, exchange, correction, team_workspace, room);
    }
  } // namespace kernels
} // namespace undine::particles

#endif
