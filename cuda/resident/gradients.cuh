// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_resident_gradients_cuh
#define undine_cuda_resident_gradients_cuh

#include "block_sums.cuh"
#include "coarse_correction.cuh"
#include "step_lengths.cuh"

#include <undine/particles/pressure/conjugate_gradients.h>

namespace undine::particles
{
  /// ConjugateGradients for systems that fit into the shared memory of all multiprocessors
  /// together, with a correction of the preconditioner. Each block keeps its rows and, besides its
  /// own unknowns, those that its rows refer to: it repeats what their owners do with them, so that
  /// only the product with the matrix has to be handed over. Together with the sums that is the
  /// only wait for other blocks in an iteration: the first warp exchanges sums while the others
  /// fetch products.
  template <class Value, class Correction>
  class ResidentGradients
  {
  public:
    using General = ConjugateGradients<float, PackedEntry, Value>;

    static constexpr int count     = Components<Value>::count;
    static constexpr int per_local = 4 * sizeof(Value) + 4;
    static constexpr int per_own   = 2 * sizeof(Value) + 4;

    /// (r, u), (w, u) of the components; with a correction also the block's sum of w, and |r|^2 or,
    /// in one of `period` iterations, the block's sum of r, which the correction then follows.
    static constexpr int n_sums = 2 * count + (Correction::exists ? 2 : 0);

    static constexpr int period = 16;

    static constexpr int most_held = count == 1 ? 24 : 0; ///< of ResidentRows

    using Rows = ResidentRows<most_held>;

    using Summation = BlockSums<n_sums>;

    /// What the warps of a block tell each other.
    struct Shared
    {
      typename Summation::Shared summation;

      typename StepLengths<count>::Shared lengths;

      double size;   ///< of the right-hand side
      double square; ///< of the residual, as it was last measured
      bool   goes_on;
    };

    __device__
    ResidentGradients(const General       &general,
                      const Rows          &rows,
                      const Correction    &correction,
                      char                *memory,
                      const BlockExchange &exchange,
                      Shared              &shared)
      : general(general)
      , rows(rows)
      , correction(correction)
      , exchange(exchange)
      , shared(shared)
      , summation(shared.summation)
    {
      inverse  = reinterpret_cast<float *>(memory);
      u        = reinterpret_cast<Value *>(inverse + rows.n_local);
      r        = u + rows.n_local;
      s        = r + rows.n_local;
      w        = s + rows.n_local;
      p        = w + rows.n_local;
      x        = p + rows.n_own;
      diagonal = reinterpret_cast<float *>(x + rows.n_own);
    }

    __device__ __forceinline__ void
    operator()()
    {
      solve_empty_rows<Value>(general.system);
      load();
      begin();
      for (;; ++iteration)
        {
          exchange.begin_round();
          multiply();
          __syncthreads();
          gather();
          __syncthreads();
          if (is_first_warp())
            take_step();
          else
            correct();
          __syncthreads();
          if (!shared.goes_on)
            break;
          if constexpr (Correction::exists)
            {
              if (follows_residual())
                correction.follow_residual();
              correction.advance(shared.lengths.alpha[0], shared.lengths.beta[0]);
              __syncthreads();
            }
          update();
          if (is_first_warp())
            lengths.prepare();
          __syncthreads();
        }
      for (int own = threadIdx.x; own < rows.n_own; own += blockDim.x)
        general.system.solution[rows.row_of(rows.first_own + own)] = x[own];
    }

  private:
    using Products = Sums<n_sums>;
    using Part     = Components<Value>;

    __device__ __forceinline__ static bool
    is_first_warp()
    {
      return threadIdx.x < 32;
    }

    __device__ __forceinline__ bool
    follows_residual() const
    {
      return Correction::exists && iteration % period == period - 1;
    }

    /// |r|^2
    __device__ __forceinline__ static double
    square_of(const Products &products)
    {
      if constexpr (Correction::exists)
        return products.values[2 * count];
      double sum = 0;
      for (int k = 0; k < count; ++k)
        sum += products.values[k];
      return sum;
    }

    /// The guess as u.
    __device__ __forceinline__ void
    load()
    {
      const auto &system = general.system;
      for (int local = threadIdx.x; local < rows.n_local; local += blockDim.x)
        {
          const int   row = rows.row_of(local);
          const float d   = system.diagonal[row];
          const Value v   = system.solution[row];
          u[local]        = v;
          inverse[local]  = 1 / d;
          s[local]        = Value();
          if (rows.is_own(local))
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

    /// The residual of the guess, its u, and the size of the right-hand side.
    __device__ __forceinline__ void
    begin()
    {
      exchange.begin_round();
      float sums[n_sums] = {};
      for_each_product([&](const int own, const Value &product) {
        const int local = rows.first_own + own;
        Value     b     = w[local];
        for (int k = 0; k < count; ++k)
          sums[0] += Part::of(b, k) * Part::of(b, k) * inverse[local];
        b -= diagonal[own] * x[own] - product;
        w[local] = b;
        put(rows.row_of(local), b);
        if constexpr (Correction::exists)
          sums[n_sums - 1] += correction.share_of(local) * b;
      });
      summation.add(sums);
      __syncthreads();
      gather();
      __syncthreads();
      if (!is_first_warp())
        correct();
      else if (threadIdx.x == 0)
        shared.size = summation.total()[0];
      __syncthreads();
      if constexpr (Correction::exists)
        correction.start();
      __syncthreads();
      for (int local = threadIdx.x; local < rows.n_local; local += blockDim.x)
        {
          r[local] = w[local];
          u[local] = preconditioned(local, w[local]);
        }
      __syncthreads();
    }

    __device__ __forceinline__ Value
    preconditioned(const int local, const Value &residual) const
    {
      if constexpr (Correction::exists)
        return inverse[local] * residual + correction.at(local);
      else
        return inverse[local] * residual;
    }

    /// The first warps collect sums, the others fetch products meanwhile.
    __device__ __forceinline__ void
    gather()
    {
      if (threadIdx.x >= 32 * Summation::collectors)
        fetch();
      else
        summation.collect(exchange, [&](const int block, const Sums<n_sums> &share) {
          if constexpr (Correction::exists)
            {
              correction.take(block, share[n_sums - 1]);
              if (follows_residual())
                correction.take_residual(block, share[2 * count]);
            }
        });
    }

    __device__ __forceinline__ void
    correct() const
    {
      if constexpr (Correction::exists)
        {
          correction.solve();
          if (follows_residual())
            correction.solve_for_residuals();
        }
    }

    /// f(own row, sum_j k_ij u_j), by one thread a row.
    template <class Function>
    __device__ __forceinline__ void
    for_each_product(const Function &f) const
    {
      const int warps = blockDim.x / 32, lane = threadIdx.x & 31;
      const int at_once = Rows::rows_at_once(rows.lanes);
      const int first   = Rows::first_slice();
      for (int slice = first; slice * at_once < rows.n_own; slice += warps)
        {
          const Value product = slice == first ? rows.times_first(u) : rows.times(slice, u);
          const int   own     = slice * at_once + lane / rows.lanes;
          if (own < rows.n_own && lane % rows.lanes == 0)
            f(own, product);
        }
    }

    /// w = A u, and its products.
    __device__ __forceinline__ void
    multiply()
    {
      float sums[n_sums] = {};
      for_each_product([&](const int own, const Value &product) {
        const int local = rows.first_own + own;
        Value     mine = u[local], residual = r[local];
        Value     Au = diagonal[own] * mine - product;
        w[local]     = Au;
        put(rows.row_of(local), Au);
        for (int k = 0; k < count; ++k)
          {
            sums[k] += Part::of(mine, k) * Part::of(residual, k);
            sums[count + k] += Part::of(mine, k) * Part::of(Au, k);
          }
        if constexpr (Correction::exists)
          {
            const float share = correction.share_of(local);
            sums[2 * count] += residual * (follows_residual() ? share : residual * inverse[local]);
            sums[n_sums - 1] += share * Au;
          }
      });
      summation.add(sums);
    }

    __device__ __forceinline__ void
    put(const int row, Value value) const
    {
      for (int k = 0; k < count; ++k)
        exchange.put_value(row * count + k, Part::of(value, k));
    }

    __device__ __forceinline__ void
    take_step()
    {
      const Products now = summation.total();
      lengths.choose(now, shared.lengths);
      if (threadIdx.x == 0)
        look_at_residual(now);
    }

    /// Is it small enough?
    __device__ __forceinline__ void
    look_at_residual(const Products &now) const
    {
      const double goal = general.bounds.tolerance * general.bounds.tolerance * shared.size;
      if (!follows_residual())
        shared.square = square_of(now);
      shared.goes_on = shared.square > goal && iteration < general.bounds.max_iterations;
      if (!shared.goes_on && blockIdx.x == 0)
        general.report(iteration, shared.size > 0 ? sqrt(shared.square / shared.size) : 0.);
    }

    /// The products of other blocks' rows, by all warps but those that collect sums; some on the
    /// way together.
    __device__ __forceinline__ void
    fetch() const
    {
      constexpr int at_once = 4;
      const int     others  = (rows.n_local - rows.n_own) * count;
      const int     threads = blockDim.x - 32 * Summation::collectors;
      for (int first = threadIdx.x - 32 * Summation::collectors; first < others;
           first += at_once * threads)
        {
          int    from[at_once];
          float *to[at_once];
#pragma unroll
          for (int k = 0; k < at_once; ++k)
            {
              const int place = min(first + k * threads, others - 1);
              const int other = place / count, c = place % count;
              const int local = other < rows.first_own ? other : other + rows.n_own;
              from[k]         = rows.row_of(local) * count + c;
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
          alpha[c] = shared.lengths.alpha[c];
          beta[c]  = shared.lengths.beta[c];
        }
      for (int local = threadIdx.x; local < rows.n_local; local += blockDim.x)
        {
          Value w_l = w[local], s_l = s[local], r_l = r[local];
          if (rows.is_own(local))
            {
              const int own = local - rows.first_own;
              Value     p_l = p[own], x_l = x[own], u_l = u[local];
              for (int c = 0; c < count; ++c)
                {
                  Part::of(p_l, c) = Part::of(u_l, c) + beta[c] * Part::of(p_l, c);
                  Part::of(x_l, c) += alpha[c] * Part::of(p_l, c);
                }
              p[own] = p_l;
              x[own] = x_l;
            }
          for (int c = 0; c < count; ++c)
            {
              Part::of(s_l, c) = Part::of(w_l, c) + beta[c] * Part::of(s_l, c);
              Part::of(r_l, c) -= alpha[c] * Part::of(s_l, c);
            }
          s[local] = s_l;
          r[local] = r_l;
          u[local] = preconditioned(local, r_l);
        }
    }

    const General &general;
    Rows           rows;
    Correction     correction;
    BlockExchange  exchange;
    Shared        &shared;
    Summation      summation;
    int            iteration = 0;

    StepLengths<count> lengths; ///< of the first warp

    // In shared memory: of local unknowns; of own ones.
    float *inverse;
    Value *u, *r, *s, *w;
    Value *p, *x;
    float *diagonal;
  };
} // namespace undine::particles

#endif
