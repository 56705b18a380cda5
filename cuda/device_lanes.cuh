// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_device_lanes_cuh
#define undine_cuda_device_lanes_cuh

#include <undine/particles/math/matrix.h>

#include <cooperative_groups.h>
#include <cooperative_groups/reduce.h>

namespace undine::particles
{
  /// Who takes part in a sum besides a particle's own lanes: nobody, or the rest of the warp. @{
  struct Nobody
  {
    __device__ static unsigned int
    mask(const unsigned int own)
    {
      return own;
    }

    template <int lanes, class Real>
    __device__ static Real
    sum(const Real value)
    {
      namespace cg = cooperative_groups;
      return cg::reduce(cg::tiled_partition<lanes>(cg::this_thread_block()),
                        value,
                        cg::plus<Real>());
    }
  };

  struct RestOfWarp
  {
    __device__ static unsigned int
    mask(const unsigned int)
    {
      return 0xffffffffu;
    }

    template <int lanes, class Real>
    __device__ static Real
    sum(Real value)
    {
      for (int distance = 1; distance < lanes; distance *= 2)
        value += __shfl_xor_sync(0xffffffffu, value, distance);
      return value;
    }
  };
  /// @}


  /// Neighbouring threads of a warp that share the work on one particle, see OneLane. They must all
  /// call sum() and ballot(), and so must all other threads that are `Present`.
  template <class Present>
  class LanesWith
  {
  public:
    static constexpr int number = 8;

    __device__ static constexpr int
    count()
    {
      return number;
    }

    __device__ static int
    rank()
    {
      return static_cast<int>(threadIdx.x) % count();
    }

    __device__ static float
    sum(float value)
    {
      return Present::template sum<number>(value);
    }

    __device__ static double
    sum(double value)
    {
      return Present::template sum<number>(value);
    }

    template <int dim, class Real>
    __device__ static Vector<dim, Real>
    sum(Vector<dim, Real> value)
    {
      for (int axis = 0; axis < dim; ++axis)
        value[axis] = Present::template sum<number>(value[axis]);
      return value;
    }

    template <int dim, class Real>
    __device__ static Matrix<dim, Real>
    sum(Matrix<dim, Real> value)
    {
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          value[i][j] = Present::template sum<number>(value[i][j]);
      return value;
    }

    __device__ static int
    votes(const unsigned int ballot)
    {
      return __popc(ballot);
    }

    __device__ static int
    votes_before(const unsigned int ballot)
    {
      return __popc(ballot & ((1u << rank()) - 1));
    }

    /// A bit for each lane.
    __device__ static unsigned int
    ballot(const bool yes)
    {
      return (__ballot_sync(mask(), yes) >> first()) & ((1u << count()) - 1);
    }

  private:
    /// Of the lanes in the warp.
    __device__ static int
    first()
    {
      return static_cast<int>(threadIdx.x) % 32 / count() * count();
    }

    __device__ static unsigned int
    mask()
    {
      return Present::mask(((1u << count()) - 1) << first());
    }
  };

  using DeviceLanes = LanesWith<Nobody>;

  /// They stay together: particles of a warp whose lanes went on by themselves would be worked on
  /// one after the other.
  using WarpLanes = LanesWith<RestOfWarp>;
} // namespace undine::particles

#endif
