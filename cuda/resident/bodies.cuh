// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_resident_bodies_cuh
#define undine_cuda_resident_bodies_cuh

#include "device_error.cuh"
#include "resident/elasticity.cuh"

#include <algorithm>

namespace undine::particles
{
  /// Starts ResidentElasticity and has its memory.
  class ResidentBodies
  {
  public:
    ResidentBodies() = default;

    ResidentBodies(const cudaDeviceProp &properties, const cudaStream_t stream)
      : multiprocessors(properties.multiProcessorCount)
      , stream(stream)
    {
    }

    template <int dim>
    bool
    can_run(const ElasticStep<dim, float> &step) const
    {
      using Resident    = ResidentElasticity<dim>;
      const auto bodies = step.elasticity.bodies;
      return bodies.n <= most_blocks() * (Resident::most_workers / Resident::lanes) &&
             bodies.n <= LocalCopies<dim>::most_particles &&
             memory(Resident::most_workers / Resident::lanes, step) <= most_memory &&
             bodies.capacity <= Resident::most_bonds * Resident::lanes;
    }

    template <class Executor, int dim>
    void
    run(const Executor                &executor,
        const ElasticStep<dim, float> &step,
        DeviceTeam::Workspace          team_workspace)
    {
      using Resident    = ResidentElasticity<dim>;
      const int   lanes = Resident::lanes, n = step.elasticity.bodies.n;
      const int   blocks   = std::min(most_blocks(), (n * lanes + few_workers - 1) / few_workers);
      const int   each     = (n + blocks - 1) / blocks;
      auto        copy     = step;
      auto        exchange = room<dim>(executor, n);
      void       *arguments[] = {&copy, &exchange, &team_workspace};
      const auto *kernel      = reinterpret_cast<const void *>(kernels::move_bodies<dim>);
      check_device(cudaFuncSetAttribute(
                     kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, memory(each, step)),
                   "to plan the bodies' steps");
      check_device(cudaLaunchCooperativeKernel(kernel,
                                               dim3(blocks),
                                               dim3((each * lanes + 31) / 32 * 32 + 32),
                                               arguments,
                                               memory(each, step),
                                               stream),
                   "to start the bodies' steps");
    }

    template <class Executor>
    void
    release(const Executor &executor)
    {
      executor.release(words);
      executor.release(rates);
      executor.release(last_round);
    }

  private:
    /// Of a block with so many particles.
    template <int dim>
    static int
    memory(const int each, const ElasticStep<dim, float> &step)
    {
      return LocalCopies<dim>::bytes(each * (step.elasticity.bodies.capacity + 1));
    }

    static constexpr int few_workers = 128; ///< of a block: one warp for each scheduler

    static constexpr int most_memory = 90 * 1024; ///< dynamic shared memory of a block [bytes]

    int
    most_blocks() const
    {
      return std::min(multiprocessors, ElasticExchange<3>::most_blocks);
    }

    template <int dim, class Executor>
    ElasticExchange<dim>
    room(const Executor &executor, const int n)
    {
      static_assert(sizeof(FlaggedVector<dim>) == sizeof(FlaggedVector<3>), "one room for all");
      if (n > n_room)
        {
          release(executor);
          words      = executor.template allocate<FlaggedVector<3>>(2 * n * (2 + 3));
          rates      = executor.template allocate<FlaggedWord>(2 * ElasticExchange<3>::most_blocks);
          last_round = executor.template allocate<unsigned int>(1);
          n_room     = n;
        }
      auto *const first = reinterpret_cast<FlaggedVector<dim> *>(words);
      return {first, first + 4 * n_room, rates, last_round, n_room, n};
    }

    int          multiprocessors = 0;
    cudaStream_t stream          = nullptr;

    FlaggedVector<3> *words      = nullptr;
    FlaggedWord      *rates      = nullptr;
    unsigned int     *last_round = nullptr;
    int               n_room     = 0; ///< particles
  };
} // namespace undine::particles

#endif
