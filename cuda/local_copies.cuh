// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_local_copies_cuh
#define undine_cuda_local_copies_cuh

#include "flagged_words.cuh"
#include "row_shares.cuh"

namespace undine::particles
{
  /// The particles that a block's bonds refer to, with numbers of its own, and copies of vectors
  /// that they hand out: each is fetched once, in the order of memory, however many bonds there
  /// are.
  template <int dim>
  class LocalCopies
  {
  public:
    static constexpr int most_particles = 4608; ///< of all bodies
    static constexpr int most_words     = most_particles / 32;
    static constexpr int n_vectors      = 2 + dim; ///< of a particle: place, velocity; rows of T

    struct Shared
    {
      unsigned int bitmap[most_words]; ///< of particles
      int          ranks[most_words + 1];
    };

    /// Dynamic shared memory of a block for up to `n` local particles.
    static int
    bytes(const int n)
    {
      return n * static_cast<int>(n_vectors * sizeof(FlaggedVector<dim>) + sizeof(int));
    }

    __device__
    LocalCopies(Shared &shared, char *memory, const int n_particles)
      : shared(shared)
      , n_words((n_particles + 31) / 32)
      , vectors(reinterpret_cast<FlaggedVector<dim> *>(memory))
    {
    }

    /// Before any mark(); by the whole block, as the other two that say so.
    __device__ __forceinline__ void
    clear()
    {
      for (int word = threadIdx.x; word < n_words; word += blockDim.x)
        shared.bitmap[word] = 0;
      __syncthreads();
    }

    __device__ __forceinline__ void
    mark(const int particle) const
    {
      atomicOr(shared.bitmap + particle / 32, 1u << (particle % 32));
    }

    /// After all mark(); by the whole block.
    __device__ __forceinline__ void
    number()
    {
      __syncthreads();
      for (int word = threadIdx.x; word < n_words; word += blockDim.x)
        shared.ranks[word + 1] = __popc(shared.bitmap[word]);
      __syncthreads();
      if (threadIdx.x < 32)
        sum_up(shared.ranks, n_words + 1);
      __syncthreads();
      n         = shared.ranks[n_words];
      particles = reinterpret_cast<int *>(vectors + n_vectors * n);
      for (int word = threadIdx.x; word < n_words; word += blockDim.x)
        {
          int          k    = shared.ranks[word];
          unsigned int bits = shared.bitmap[word];
          for (; bits != 0; bits &= bits - 1)
            particles[k++] = 32 * word + __ffs(bits) - 1;
        }
      __syncthreads();
    }

    __device__ __forceinline__ int
    number_of(const int particle) const
    {
      const unsigned int before = (1u << (particle % 32)) - 1;
      return shared.ranks[particle / 32] + __popc(shared.bitmap[particle / 32] & before);
    }

    /// Vectors first ... first + count - 1 of all local particles from where those of particle k
    /// begin at from + count k, as soon as they are of the round; by the first `workers` threads.
    /// Others may read them after __syncthreads().
    template <int first, int count>
    __device__ __forceinline__ void
    fetch(const FlaggedVector<dim> *from, const unsigned int round, const int workers) const
    {
      constexpr int             at_once = 4;
      FlaggedVector<dim> *const to      = vectors + first * n;
      for (int begin = threadIdx.x; begin < count * n; begin += at_once * workers)
        {
          FlaggedVector<dim> word[at_once];
          bool               complete;
          do
            {
              complete = true;
#pragma unroll
              for (int k = 0; k < at_once; ++k)
                {
                  const int place = min(begin + k * workers, count * n - 1);
                  word[k] = look_at(from + particles[place / count] * count + place % count);
                }
#pragma unroll
              for (int k = 0; k < at_once; ++k)
                complete = complete && word[k].round == round;
            }
          while (!complete);
#pragma unroll
          for (int k = 0; k < at_once; ++k)
            if (begin + k * workers < count * n)
              to[begin + k * workers] = word[k];
        }
    }

    /// Vector `which` of a local particle, of those that were fetched together from `first` on.
    template <int first, int count>
    __device__ __forceinline__ Vector<dim, float>
                               at(const int local, const int which) const
    {
      return vectors[first * n + local * count + which].vector;
    }

  private:
    Shared             &shared;
    int                 n_words; ///< of the bitmap
    FlaggedVector<dim> *vectors;
    int                *particles = nullptr; ///< by local number
    int                 n         = 0;       ///< local particles
  };
} // namespace undine::particles

#endif
