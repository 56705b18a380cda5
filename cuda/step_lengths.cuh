// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_step_lengths_cuh
#define undine_cuda_step_lengths_cuh

#include <undine/particles/execution/sums.h>

#include <cuda_runtime.h>

namespace undine::particles
{
  /// The numbers of conjugate gradients in the form of Chronopoulos and Gear, see
  /// ConjugateGradients, for `count` systems at a time; by one warp.
  template <int count>
  class StepLengths
  {
  public:
    struct Shared
    {
      float alpha[count], beta[count];
    };

    /// From the sums (r, u) of the systems, then (w, u). With 1 / alpha the curvature is (w, u) -
    /// beta^2 last curvature.
    template <int n>
    __device__ __forceinline__ void
    choose(const Sums<n> &now, Shared &shared)
    {
#pragma unroll
      for (int k = 0; k < count; ++k)
        {
          const double beta = now.values[k] * inverse_last[k];
          curvature[k]      = now.values[count + k] - beta * beta * curvature[k];
          last[k]           = now.values[k];
          if (threadIdx.x == 0)
            {
              shared.beta[k]  = static_cast<float>(beta);
              shared.alpha[k] = curvature[k] != 0 ? static_cast<float>(now.values[k]) /
                                                      static_cast<float>(curvature[k])
                                                  : 0.f;
            }
        }
    }

    /// For the next iteration, while there is time.
    __device__ __forceinline__ void
    prepare()
    {
#pragma unroll
      for (int k = 0; k < count; ++k)
        inverse_last[k] = last[k] != 0 ? 1 / last[k] : 0.;
    }

  private:
    double last[count] = {}, inverse_last[count] = {}, curvature[count] = {};
  };
} // namespace undine::particles

#endif
