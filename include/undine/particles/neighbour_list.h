// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_neighbour_list_h
#define undine_particles_neighbour_list_h

#include <undine/particles/atomics.h>
#include <undine/particles/buffer.h>
#include <undine/particles/neighbours.h>
#include <undine/particles/step_control.h>

namespace undine::particles
{
  /// Find the particles within the reach of one.
  template <int dim, class Real>
  struct FindNeighbours
  {
    CellGrid<dim, Real>     grid;
    Real                    reach;
    int                     capacity;
    const Place<dim, Real> *places;
    const int              *starts; ///< of the cells
    int                    *counts;
    int                    *indices;
    StepControl            *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      counts[i] = 0;
      if (places[i].tag.is_parked())
        return;
      const Vector<dim, Real> x     = places[i].x;
      int                     count = 0;
      grid.for_each_run_around(x, [&](const int first_cell, const int end_cell) {
        const int end = starts[end_cell];
        for (int j = starts[first_cell]; j < end; ++j)
          if (norm_square(grid.difference(places[j].x, x)) < reach * reach && j != i)
            {
              if (count < capacity)
                indices[list_slot(i, count, capacity)] = j;
              ++count;
            }
      });
      if (count > capacity)
        atomic_or(&control->failures, static_cast<unsigned int>(Failure::neighbours));
      counts[i] = minimum(count, capacity);
    }
  };

  /// The memory of Neighbours.
  template <class Executor, int dim, class Real>
  class NeighbourList
  {
  public:
    NeighbourList(Executor                  &executor,
                  const CellGrid<dim, Real> &grid,
                  const Real                 reach,
                  const int                  n)
      : executor(executor)
      , grid(grid)
      , reach(reach)
      , counts(executor, n)
      , indices(executor, list_slot((n + 31) / 32 * 32, 0, capacity))
    {
    }

    void
    find(const Particles<dim, Real> &particles, const int *cell_starts, StepControl *control)
    {
      executor.for_each(particles.n,
                        FindNeighbours<dim, Real>{grid,
                                                  reach,
                                                  capacity,
                                                  particles.places,
                                                  cell_starts,
                                                  counts.data(),
                                                  indices.data(),
                                                  control});
    }

    Neighbours<dim, Real>
    view(const Particles<dim, Real> &particles) const
    {
      return {grid, reach, capacity, particles.places, counts.data(), indices.data()};
    }

    /// A full lattice has 12 neighbours in the plane and 32 in space.
    static constexpr int capacity = dim * dim * 8;

  private:
    Executor             &executor;
    CellGrid<dim, Real>   grid;
    Real                  reach;
    Buffer<Executor, int> counts, indices;
  };
} // namespace undine::particles

#endif
