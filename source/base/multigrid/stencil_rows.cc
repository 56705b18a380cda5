// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/multigrid/stencil_rows.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// So many points of a row are relaxed at a time, from values that stay in the nearest cache.
    constexpr int chunk = 256;
  } // namespace


  template <int n, typename Number>
  [[gnu::target_clones("avx2", "default")]] void
  subtract_neighbours(Number *__restrict result,
                      const Number                    *b,
                      const Number                    *x,
                      const StencilEntries<n, Number> &entries,
                      const BoxInArray<n>             &box,
                      const std::ptrdiff_t             position)
  {
    const auto [above, below] = entries;
    const auto strides        = box.strides;
    const int  length         = box.lengths[0];
    for (int i = 0; i < length; ++i)
      {
        const auto at  = position + i;
        Number     sum = b[at];
        for (int d = 0; d < n; ++d)
          sum -= above[d][at] * x[at + strides[d]] + below[d][at] * x[at - strides[d]];
        result[i] = sum;
      }
  }


  namespace
  {
    /// The new values of a row before relaxation is weighted; the points of the other parity do not
    /// change, so that a row can be computed at once.
    [[gnu::target_clones("avx2", "default")]] void
    move_towards(float *__restrict x,
                 const float *rest,
                 const float *inverse_diagonal,
                 const float *omega,
                 const int    length)
    {
      for (int i = 0; i < length; ++i)
        x[i] += omega[i] * (inverse_diagonal[i] * rest[i] - x[i]);
    }
  } // namespace


  template <int n>
  void
  relax(float                          *x,
        const float                    *b,
        const float                    *inverse_diagonal,
        const StencilEntries<n, float> &entries,
        const BoxInArray<n>            &box,
        const int                       parity,
        const float                     omega)
  {
    std::array<float, chunk + 1> weights; // of every other point
    for (int i = 0; i <= chunk; ++i)
      weights[i] = i % 2 == 0 ? omega : 0.f;
    std::array<float, chunk> rest;
    auto                     part = box;
    box.for_each_row([&](const std::ptrdiff_t row, const int first_parity) {
      const float *weight = weights.data() + (first_parity + parity) % 2;
      for (int begin = 0; begin < box.lengths[0]; begin += chunk)
        {
          const auto at   = row + begin;
          part.lengths[0] = std::min(chunk, box.lengths[0] - begin);
          subtract_neighbours<n, float>(rest.data(), b, x, entries, part, at);
          move_towards(x + at, rest.data(), inverse_diagonal + at, weight, part.lengths[0]);
        }
    });
  }


#define INSTANTIATE(n)                                                            \
  template void subtract_neighbours<n, double>(double *,                          \
                                               const double *,                    \
                                               const double *,                    \
                                               const StencilEntries<n, double> &, \
                                               const BoxInArray<n> &,             \
                                               std::ptrdiff_t);                   \
  template void subtract_neighbours<n, float>(float *,                            \
                                              const float *,                      \
                                              const float *,                      \
                                              const StencilEntries<n, float> &,   \
                                              const BoxInArray<n> &,              \
                                              std::ptrdiff_t);                    \
  template void relax<n>(float *,                                                 \
                         const float *,                                           \
                         const float *,                                           \
                         const StencilEntries<n, float> &,                        \
                         const BoxInArray<n> &,                                   \
                         int,                                                     \
                         float);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
