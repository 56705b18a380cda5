// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_resident_elasticity_cuh
#define undine_cuda_resident_elasticity_cuh

#include "device_team.cuh"
#include "local_copies.cuh"
#include "warp_signal.cuh"

#include <undine/particles/elasticity/elastic_step.h>

namespace undine::particles
{
  /// Where the blocks of ResidentElasticity exchange numbers, in rounds, one for each explicit
  /// step. What one round wrote is overwritten in the next but one; as every block needs the rates
  /// of all in each round, everybody has read it then.
  template <int dim>
  struct ElasticExchange
  {
    FlaggedVector<dim> *points;     ///< 2 rounds, n particles: place, velocity
    FlaggedVector<dim> *tractions;  ///< 2 rounds, n particles: rows of T
    FlaggedWord        *rates;      ///< 2 rounds, most_blocks blocks
    unsigned int       *last_round; ///< of the launch before
    int                 n_room;     ///< particles that there is room for
    int                 n;          ///< particles

    static constexpr int most_blocks = 160;
  };


  /// The explicit steps of ElasticStep with every particle in the registers of some lanes: its
  /// state and its bonds' reference, which are read once. What others need of it they take as soon
  /// as it is there, without a barrier: the only thing that everybody waits for in a step is the
  /// largest rate, which one warp of each block collects while the others fetch tractions.
  template <int dim>
  class ResidentElasticity
  {
  public:
    using Step = ElasticStep<dim, float>;

    static constexpr int most_workers = 224; ///< threads of a block with particles
    static constexpr int most_warps   = most_workers / 32;
    static constexpr int threads      = most_workers + 32; ///< of a block, at most
    static constexpr int lanes        = DeviceLanes::number;

    /// A lane's bonds.
    static constexpr int most_bonds = (dim * dim * 4 + lanes - 1) / lanes;

    struct Shared
    {
      typename LocalCopies<dim>::Shared copies;
      WarpSignal::Shared                signal;

      unsigned int rates[most_warps]; ///< largest ones, bits of floats
      float        h;
      bool         goes_on;
    };

    __device__
    ResidentElasticity(const Step                 &step,
                       const ElasticExchange<dim> &exchange,
                       Shared                     &shared,
                       char                       *memory)
      : step(step)
      , exchange(exchange)
      , shared(shared)
      , copies(shared.copies, memory, exchange.n)
      , tractions_are_there(shared.signal, workers())
      , steps(step.control->dt, step.bounds)
      , time_left(static_cast<float>(step.control->dt))
      , round(*exchange.last_round)
    {
      const int each = (exchange.n + gridDim.x - 1) / gridDim.x;
      const int own  = static_cast<int>(threadIdx.x) / lanes;
      is_worker      = threadIdx.x < workers();
      i              = min(static_cast<int>(blockIdx.x) * each + own, exchange.n - 1);
      is_owner       = is_worker && own < each && i == static_cast<int>(blockIdx.x) * each + own;
    }

    __device__ __forceinline__ void
    operator()()
    {
      if (is_worker)
        begin();
      number_neighbours();
      do
        {
          ++round;
          if (is_worker)
            {
              hand_out_point();
              copies.template fetch<0, 2>(point_of(0), round, workers());
            }
          __syncthreads();
          if (is_worker)
            deform();
          __syncthreads();
          auto a = Vector<dim, float>::zero();
          if (is_worker)
            {
              copies.template fetch<2, dim>(traction_of(0), round, workers());
              tractions_are_there.give();
              tractions_are_there.take();
              __syncwarp();
              a = acceleration();
            }
          else
            choose_step();
          __syncthreads();
          if (is_worker)
            point = step.moved(point, held, shared.h, a);
          time_left -= shared.h;
        }
      while (shared.goes_on);
      if (is_owner && WarpLanes::rank() == 0)
        end();
      if (blockIdx.x == 0 && threadIdx.x == blockDim.x - 32)
        {
          *exchange.last_round = round;
          step.count(steps.taken);
          if (steps.failed)
            step.fail();
        }
    }

  private:
    using Elastic = Elasticity<dim, float>;

    static constexpr unsigned int everybody = 0xffffffffu; ///< of a warp

    __device__ __forceinline__ FlaggedVector<dim>                            *
    point_of(const int particle) const
    {
      return exchange.points + ((round & 1) * exchange.n_room + particle) * 2;
    }

    __device__ __forceinline__ FlaggedVector<dim>                            *
    traction_of(const int particle) const
    {
      return exchange.tractions + ((round & 1) * exchange.n_room + particle) * dim;
    }

    /// Everything between here and end() is done by whole warps.
    __device__ __forceinline__ void
    begin()
    {
      const auto &bodies = step.elasticity.bodies;

      own      = step.elasticity.particle(i);
      held     = bodies.clamped[i];
      pressure = step.pressure_acceleration(i);
      now.R    = bodies.rotations[i];
      point    = step.start_of(i);
      n_bonds  = __reduce_max_sync(everybody, (bodies.counts[i] + lanes - 1) / lanes);
#pragma unroll
      for (int k = 0; k < most_bonds; ++k)
        bonds[k] = step.elasticity.reference_bond(i, k * lanes + WarpLanes::rank());
      if (is_owner && WarpLanes::rank() == 0 && step.purpose != ElasticRun::final)
        step.x_start[i] = point.x;
      n_partners = step.contact.list_partners(i, DeviceLanes());
      __syncwarp(); // partners
    }

    /// By the whole block: from here on bonds know local numbers.
    __device__ __forceinline__ void
    number_neighbours()
    {
      copies.clear();
      if (is_worker)
        for_each_bond([&](const auto &bond) { copies.mark(bond.j); });
      copies.number();
      if (is_worker)
        for_each_bond([&](auto &bond) { bond.j = copies.number_of(bond.j); });
    }

    /// Of this lane.
    template <class Function>
    __device__ __forceinline__ void
    for_each_bond(const Function &f)
    {
#pragma unroll
      for (int k = 0; k < most_bonds; ++k)
        if (k < n_bonds)
          f(bonds[k]);
    }

    __device__ __forceinline__ static int
    workers()
    {
      return static_cast<int>(blockDim.x) - 32;
    }

    __device__ __forceinline__ void
    hand_out_point() const
    {
      if (is_owner && WarpLanes::rank() == 0)
        put(point_of(i), point.x, round);
      else if (is_owner && WarpLanes::rank() == 1)
        put(point_of(i) + 1, point.v, round);
      __syncwarp();
    }

    /// From points to tractions, and what others need for the step's length.
    __device__ __forceinline__ void
    deform()
    {
      now = step.elasticity.deformation(own, now.R, WarpLanes(), [&](const auto &f) {
        for_each_bond([&](auto &bond) {
          bond = step.elasticity.at_present(
            bond, point, copies.template at<0, 2>(bond.j, 0), copies.template at<0, 2>(bond.j, 1));
          f(bond);
        });
      });
      __syncwarp();
#pragma unroll
      for (int row = 0; row < dim; ++row)
        if (is_owner && WarpLanes::rank() == row)
          {
            Vector<dim, float> entries;
            for (int column = 0; column < dim; ++column)
              entries[column] = now.T[row][column];
            put(traction_of(i) + row, entries, round);
          }
      touch = step.contact.response(
        i, point, n_partners, time_left, DeviceLanes(), [&](const int partner) {
          FlaggedVector<dim> x, v;
          do
            {
              x = look_at(point_of(partner));
              v = look_at(point_of(partner) + 1);
            }
          while (x.round != round || v.round != round);
          return ElasticPoint<dim, float>{x.vector, v.vector};
        });
      __syncwarp();
      const float        rate    = step.rate_of(own.material, now.F, touch);
      const unsigned int largest = __reduce_max_sync(everybody, __float_as_uint(rate));
      if ((threadIdx.x & 31) == 0)
        shared.rates[threadIdx.x / 32] = largest;
    }

    /// By one warp, while the others wait for tractions.
    __device__ __forceinline__ void
    choose_step()
    {
      constexpr int      at_once = ElasticExchange<dim>::most_blocks / 32;
      FlaggedWord *const rates   = exchange.rates + (round & 1) * ElasticExchange<dim>::most_blocks;
      const int          lane = threadIdx.x & 31, blocks = gridDim.x;
      unsigned int       largest = lane < (blockDim.x - 32) / 32 ? shared.rates[lane] : 0u;
      largest                    = __reduce_max_sync(0xffffffffu, largest);
      if (lane == 0)
        put(rates + blockIdx.x, flagged(__uint_as_float(largest), round));
      FlaggedWord word[at_once];
      bool        complete;
      do
        {
          complete = true;
#pragma unroll
          for (int k = 0; k < at_once; ++k)
            if (32 * k < blocks)
              word[k] = look_at(rates + min(32 * k + lane, blocks - 1));
#pragma unroll
          for (int k = 0; k < at_once; ++k)
            if (32 * k < blocks)
              complete = complete && is_of(word[k], round);
        }
      while (!complete);
#pragma unroll
      for (int k = 0; k < at_once; ++k)
        if (32 * k < blocks)
          largest = max(largest, __float_as_uint(number_in(word[k])));
      __syncwarp();
      largest        = __reduce_max_sync(0xffffffffu, largest);
      const double h = steps.next(__uint_as_float(largest));
      if (lane == 0)
        {
          shared.h       = static_cast<float>(h);
          shared.goes_on = steps.goes_on;
        }
    }

    __device__ __forceinline__ Vector<dim, float>
                               acceleration()
    {
      auto result = step.body_force(own.material, point.x) + pressure;
      result += step.drag(own.material, point.v);
      result += touch.acceleration;
      return result += step.elasticity.acceleration(own, now.T, WarpLanes(), [&](const auto &f) {
        for_each_bond([&](const auto &bond) {
          Matrix<dim, float> T;
#pragma unroll
          for (int row = 0; row < dim; ++row)
            {
              const auto entries = copies.template at<2, dim>(bond.j, row);
              for (int column = 0; column < dim; ++column)
                T[row][column] = entries[column];
            }
          f(bond, T);
        });
      });
    }

    __device__ __forceinline__ void
    end() const
    {
      step.elasticity.bodies.deformations[i] = now.F;
      step.elasticity.bodies.rotations[i]    = now.R;
      step.end(i, point);
    }

    const Step                 &step;
    const ElasticExchange<dim> &exchange;
    Shared                     &shared;
    LocalCopies<dim>            copies;
    WarpSignal                  tractions_are_there; ///< for the workers
    ExplicitSteps               steps;               ///< in the last warp
    float                       time_left;           ///< of the sub-step [s]
    unsigned int                round;
    int                         i;                   ///< the particle
    bool                        is_worker, is_owner; ///< others repeat what another one does

    // Of the particle, in all its lanes but for the bonds.
    typename Elastic::Particle             own;
    typename Elastic::Bond                 bonds[most_bonds];
    typename Elastic::Deformation          now;
    typename Contact<dim, float>::Response touch;
    ElasticPoint<dim, float>               point;
    Vector<dim, float>                     pressure; ///< acceleration by it
    unsigned char                          held; ///< directions
    int                                    n_bonds, n_partners;
  };


  namespace kernels
  {
    template <int dim>
    __global__ void
    __launch_bounds__(ResidentElasticity<dim>::threads, 1)
      move_bodies(const __grid_constant__ ElasticStep<dim, float> step,
                  const ElasticExchange<dim>                      exchange,
                  const DeviceTeam::Workspace                     workspace)
    {
      extern __shared__ __align__(16) char memory[];
      __shared__ Sums<DeviceTeam::most_sums>              of_warps[DeviceTeam::most_warps];
      __shared__ typename ResidentElasticity<dim>::Shared shared;
      if (step.control->done())
        return;
      DeviceTeam team(workspace, of_warps);
      if (step.is_stiff())
        step(team);
      else
        {
          ResidentElasticity<dim>(step, exchange, shared, memory)();
          step.carry_pressure(team);
        }
    }
  } // namespace kernels
} // namespace undine::particles

#endif
