// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_neighbour_list_h
#define undine_particles_neighbour_list_h

#include <undine/particles/atomics.h>
#include <undine/particles/buffer.h>
#include <undine/particles/neighbours.h>
#include <undine/particles/step_control.h>

namespace undine::particles
{
  /// Find the particles within the reach of one. Dummies need none.
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
      const Place<dim, Real> place = places[i];
      Row                    row{indices + list_slot(i, 0, capacity), 0};
      if (place.tag.kind() != Kind::dummy && !place.tag.is_yielding())
        grid.for_each_run_around(
          place.x, [&](const int first_cell, const int end_cell, const Vector<dim, Real> &x) {
            collect(i, x, starts[first_cell], starts[end_cell], row);
          });
      if (row.count > capacity)
        atomic_or(&control->failures, static_cast<unsigned int>(Failure::neighbours));
      counts[i] = minimum(row.count, capacity);
    }

  private:
    /// Those that were found.
    struct Row
    {
      int *next; ///< where the next one goes
      int  count;
    };

    /// Among the particles begin ... end-1, seen from x.
    UNDINE_HOST_DEVICE
    void
    collect(const int i, const Vector<dim, Real> &x, const int begin, const int end, Row &row) const
    {
      constexpr int together = 4; // their places are on the way at the same time
      int           first    = begin;
      for (; first + together <= end; first += together)
        {
          Place<dim, Real> other[together];
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            other[k] = places[first + k];
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            look_at(i, x, first + k, other[k], row);
        }
      if (first == end)
        return;
      Place<dim, Real> other[together - 1];
      UNDINE_UNROLL
      for (int k = 0; k < together - 1; ++k)
        other[k] = places[minimum(first + k, end - 1)];
      UNDINE_UNROLL
      for (int k = 0; k < together - 1; ++k)
        if (first + k < end)
          look_at(i, x, first + k, other[k], row);
    }

    UNDINE_HOST_DEVICE
    void
    look_at(const int                i,
            const Vector<dim, Real> &x,
            const int                j,
            const Place<dim, Real>  &other,
            Row                     &row) const
    {
      if (norm_square(other.x - x) < reach * reach && j != i && !other.tag.is_yielding())
        {
          if (row.count < capacity)
            *row.next = j;
          row.next += 32; // as in list_slot()
          ++row.count;
        }
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
    static constexpr int capacity = dim * dim * dim * 4;

  private:
    Executor             &executor;
    CellGrid<dim, Real>   grid;
    Real                  reach;
    Buffer<Executor, int> counts, indices;
  };
} // namespace undine::particles

#endif
