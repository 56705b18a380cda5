// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_resident_gradients_cuh
#define undine_cuda_resident_gradients_cuh

#include "block_exchange.cuh"
#include "resident_rows.cuh"

#include <undine/particles/conjugate_gradients.h>

namespace undine::particles
{
  /// ConjugateGradients for systems that fit into the shared memory of all multiprocessors
  /// together. Each block keeps its rows and, besides its own unknowns, those that its rows refer
  /// to: it repeats what their owners do with them, so that only the product with the matrix has to
  /// be handed over. Together with the sums that is the only wait for other blocks in an iteration:
  /// the first warp exchanges sums while the others fetch products.
  ///
  /// With u = D^{-1} r and t = D^{-1} s in the names of ConjugateGradients.
  template <class Value>
  class ResidentGradients
  {
  public:
    using General = ConjugateGradients<float, PackedEntry, Value>;

    static constexpr int count     = Components<Value>::count;
    static constexpr int per_local = 3 * sizeof(Value) + 4;
    static constexpr int per_own   = 2 * sizeof(Value) + 4;

    /// What the warps of a block tell each other.
    struct Shared
    {
      float of_warps[2 * count][32];
      float alpha[count], beta[count];
      bool  goes_on;
    };

    __device__
    ResidentGradients(const General       &general,
                      const ResidentRows  &rows,
                      char                *memory,
                      const BlockExchange &exchange,
                      Shared              &shared)
      : general(general)
      , rows(rows)
      , exchange(exchange)
      , shared(shared)
    {
      inverse  = reinterpret_cast<float *>(memory);
      u        = reinterpret_cast<Value *>(inverse + rows.n_local);
      t        = u + rows.n_local;
      w        = t + rows.n_local;
      p        = w + rows.n_local;
      x        = p + rows.n_own;
      diagonal = reinterpret_cast<float *>(x + rows.n_own);
    }

    __device__ __forceinline__ void
    operator()()
    {
      solve_empty_rows();
      load();
      begin();
      for (int iteration = 0;; ++iteration)
        {
          exchange.begin_round();
          multiply();
          __syncthreads();
          if (is_first_warp())
            choose_step(iteration);
          else
            fetch();
          __syncthreads();
          if (!shared.goes_on)
            break;
          update();
          if (is_first_warp())
            prepare_step();
          __syncthreads();
        }
      for (int own = threadIdx.x; own < rows.n_own; own += blockDim.x)
        general.system.solution[row_of(rows.first_own + own)] = x[own];
    }

  private:
    using Products = Sums<2 * count>;
    using Part     = Components<Value>;

    __device__ __forceinline__ static bool
    is_first_warp()
    {
      return threadIdx.x < 32;
    }

    __device__ __forceinline__ static double
    total(const Products &products)
    {
      double sum = 0;
      for (int k = 0; k < count; ++k)
        sum += products.values[k];
      return sum;
    }

    /// Rows without neighbours belong to no block.
    __device__ __forceinline__ void
    solve_empty_rows() const
    {
      const auto &system = general.system;
      for (int row = blockIdx.x * blockDim.x + threadIdx.x; row < system.matrix.n;
           row += gridDim.x * blockDim.x)
        if (system.matrix.counts[row] == 0)
          system.solution[row] = (1 / system.diagonal[row]) * Value(system.right_hand_side[row]);
    }

    __device__ __forceinline__ int
    row_of(const int local) const
    {
      return rows.global[local];
    }

    __device__ __forceinline__ bool
    is_own(const int local) const
    {
      return local >= rows.first_own && local < rows.first_own + rows.n_own;
    }

    /// The guess as u.
    __device__ __forceinline__ void
    load()
    {
      const auto &system = general.system;
      for (int local = threadIdx.x; local < rows.n_local; local += blockDim.x)
        {
          const int   row = row_of(local);
          const float d   = system.diagonal[row];
          const Value v   = system.solution[row];
          u[local]        = v;
          inverse[local]  = 1 / d;
          t[local]        = Value();
          if (is_own(local))
            {
              const int own = local - rows.first_own;
              x[own]        = v;
              p[own]        = Value();
              w[local]      = system.right_hand_side[row];
              diagonal[own] = d;
            }
        }
      __syncthreads();
    }

    /// u of the residual of the guess, and the size of the right-hand side.
    __device__ __forceinline__ void
    begin()
    {
      exchange.begin_round();
      float sums[2 * count] = {};
      for_each_product([&](const int own, const Value &product) {
        const int local = rows.first_own + own;
        Value     b     = w[local];
        for (int k = 0; k < count; ++k)
          sums[0] += Part::of(b, k) * Part::of(b, k) * inverse[local];
        b -= diagonal[own] * x[own] - product;
        w[local] = b;
        put(row_of(local), b);
      });
      reduce_warp(sums);
      __syncthreads();
      if (is_first_warp())
        size = exchange_sums()[0];
      else
        fetch();
      __syncthreads();
      for (int local = threadIdx.x; local < rows.n_local; local += blockDim.x)
        u[local] = inverse[local] * w[local];
      __syncthreads();
    }

    /// f(own row, sum_j k_ij u_j), by one thread a row.
    template <class Function>
    __device__ __forceinline__ void
    for_each_product(const Function &f) const
    {
      const int warps = blockDim.x / 32, lane = threadIdx.x & 31;
      const int at_once = ResidentRows::rows_at_once(rows.lanes);
      for (int slice = threadIdx.x / 32; slice * at_once < rows.n_own; slice += warps)
        {
          const Value product = rows.times(slice, u);
          const int   own     = slice * at_once + lane / rows.lanes;
          if (own < rows.n_own && lane % rows.lanes == 0)
            f(own, product);
        }
    }

    /// w = A u, and its products.
    __device__ __forceinline__ void
    multiply()
    {
      float sums[2 * count] = {};
      for_each_product([&](const int own, const Value &product) {
        const int local = rows.first_own + own;
        Value     mine  = u[local];
        Value     r     = diagonal[own] * mine;
        Value     Au    = r - product;
        w[local]        = Au;
        put(row_of(local), Au);
        for (int k = 0; k < count; ++k)
          {
            sums[k] += Part::of(mine, k) * Part::of(r, k);
            sums[count + k] += Part::of(mine, k) * Part::of(Au, k);
          }
      });
      reduce_warp(sums);
    }

    __device__ __forceinline__ void
    put(const int row, Value value) const
    {
      for (int k = 0; k < count; ++k)
        exchange.put_value(row * count + k, Part::of(value, k));
    }

    __device__ __forceinline__ void
    reduce_warp(float (&sums)[2 * count]) const
    {
#pragma unroll
      for (int distance = 16; distance > 0; distance /= 2)
#pragma unroll
        for (int k = 0; k < 2 * count; ++k)
          sums[k] += __shfl_xor_sync(0xffffffffu, sums[k], distance);
      if ((threadIdx.x & 31) == 0)
#pragma unroll
        for (int k = 0; k < 2 * count; ++k)
          shared.of_warps[k][threadIdx.x / 32] = sums[k];
    }

    /// Of all blocks; by the first warp, after all warps of the block have given theirs.
    __device__ __forceinline__ Products
    exchange_sums() const
    {
      const int lane = threadIdx.x;
      Products  all;
#pragma unroll
      for (int k = 0; k < 2 * count; ++k)
        {
          all.values[k] = lane < static_cast<int>(blockDim.x) / 32 ? shared.of_warps[k][lane] : 0.f;
#pragma unroll
          for (int distance = 16; distance > 0; distance /= 2)
            all.values[k] += __shfl_xor_sync(0xffffffffu, all.values[k], distance);
        }
      exchange.put_sums(all);
      return exchange.template get_sums<2 * count>();
    }

    /// With 1 / alpha the curvature is (w, u) - beta^2 last curvature.
    __device__ __forceinline__ void
    choose_step(const int iteration)
    {
      const Products now     = exchange_sums();
      const double   square  = total(now);
      const double   goal    = general.bounds.tolerance * general.bounds.tolerance * size;
      const bool     goes_on = square > goal && iteration < general.bounds.max_iterations;
#pragma unroll
      for (int k = 0; k < count; ++k)
        {
          const double beta = now.values[k] * inverse_last[k];
          curvature[k]      = now.values[count + k] - beta * beta * curvature[k];
          if (threadIdx.x == 0)
            {
              shared.beta[k]  = static_cast<float>(beta);
              shared.alpha[k] = curvature[k] != 0 ? static_cast<float>(now.values[k]) /
                                                      static_cast<float>(curvature[k])
                                                  : 0.f;
            }
        }
      if (threadIdx.x == 0)
        shared.goes_on = goes_on;
      if (!goes_on && blockIdx.x == 0 && threadIdx.x == 0)
        general.report(iteration, size > 0 ? sqrt(square / size) : 0.);
      last = now;
    }

    /// For the next iteration, while there is time; by the first warp.
    __device__ __forceinline__ void
    prepare_step()
    {
#pragma unroll
      for (int k = 0; k < count; ++k)
        inverse_last[k] = last.values[k] != 0 ? 1 / last.values[k] : 0.;
    }

    /// The products of other blocks' rows, by all but the first warp; some on the way together.
    __device__ __forceinline__ void
    fetch() const
    {
      constexpr int at_once = 4;
      const int     others  = (rows.n_local - rows.n_own) * count;
      const int     threads = blockDim.x - 32;
      for (int first = threadIdx.x - 32; first < others; first += at_once * threads)
        {
          int    from[at_once];
          float *to[at_once];
#pragma unroll
          for (int k = 0; k < at_once; ++k)
            {
              const int place = min(first + k * threads, others - 1);
              const int other = place / count, c = place % count;
              const int local = other < rows.first_own ? other : other + rows.n_own;
              from[k]         = row_of(local) * count + c;
              to[k]           = first + k * threads < others ? &Part::of(w[local], c) : nullptr;
            }
          exchange.template get_values<at_once>(to, from);
        }
      __syncwarp();
    }

    __device__ __forceinline__ void
    update()
    {
      float alpha[count], beta[count];
      for (int c = 0; c < count; ++c)
        {
          alpha[c] = shared.alpha[c];
          beta[c]  = shared.beta[c];
        }
      for (int own = threadIdx.x; own < rows.n_own; own += blockDim.x)
        {
          Value p_l = p[own], x_l = x[own], u_l = u[rows.first_own + own];
          for (int c = 0; c < count; ++c)
            {
              Part::of(p_l, c) = Part::of(u_l, c) + beta[c] * Part::of(p_l, c);
              Part::of(x_l, c) += alpha[c] * Part::of(p_l, c);
            }
          p[own] = p_l;
          x[own] = x_l;
        }
      __syncthreads();
      for (int local = threadIdx.x; local < rows.n_local; local += blockDim.x)
        {
          Value w_l = w[local], u_l = u[local], t_l = t[local];
          for (int c = 0; c < count; ++c)
            {
              Part::of(t_l, c) = inverse[local] * Part::of(w_l, c) + beta[c] * Part::of(t_l, c);
              Part::of(u_l, c) -= alpha[c] * Part::of(t_l, c);
            }
          t[local] = t_l;
          u[local] = u_l;
        }
    }

    const General &general;
    ResidentRows   rows;
    BlockExchange  exchange;
    Shared        &shared;

    // Of the first warp.
    double   size = 0;                 ///< of the right-hand side
    Products last;                     ///< sums of the last iteration
    double   inverse_last[count] = {}; ///< of the first of them
    double   curvature[count]    = {};

    // In shared memory: of local unknowns; of own ones.
    float *inverse;
    Value *u, *t, *w;
    Value *p, *x;
    float *diagonal;
  };
} // namespace undine::particles

#endif
