// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_neighbours_neighbour_list_h
#define undine_particles_neighbours_neighbour_list_h

#include <undine/particles/execution/atomics.h>
#include <undine/particles/execution/buffer.h>
#include <undine/particles/model/step_control.h>
#include <undine/particles/neighbours/neighbours.h>

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

    /// So many of a row are written together with those of other rows, where there is room: the
    /// device's memory takes single numbers badly.
    static constexpr int together = 16 * dim;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      int count = 0;
      for_each_near(i, [&](const int j) {
        if (count < capacity)
          indices[list_slot(i, count, capacity)] = j;
        ++count;
      });
      finish(i, count);
    }

    /// `room` is for `together` numbers.
    template <class Room>
    UNDINE_HOST_DEVICE
    void
    operator()(const int i, Room &room) const
    {
      int count = 0;
      for_each_near(i, [&](const int j) {
        if (count < together)
          room[count] = j;
        else if (count < capacity)
          indices[list_slot(i, count, capacity)] = j;
        ++count;
      });
      for (int k = 0; k < minimum(count, together); ++k)
        indices[list_slot(i, k, capacity)] = room[k];
      finish(i, count);
    }

  private:
    UNDINE_HOST_DEVICE
    void
    finish(const int i, const int count) const
    {
      if (count > capacity)
        atomic_or(&control->failures, static_cast<unsigned int>(Failure::neighbours));
      counts[i] = minimum(count, capacity);
    }

    /// f(j) for the neighbours j of i.
    template <class Function>
    UNDINE_HOST_DEVICE
    void
    for_each_near(const int i, const Function &f) const
    {
      const Place<dim, Real> place = places[i];
      if (place.tag.kind() == Kind::dummy || place.tag.is_inactive())
        return;
      grid.for_each_run_around(
        place.x, [&](const int first_cell, const int end_cell, const Vector<dim, Real> &x) {
          for_each_among(i, x, starts[first_cell], starts[end_cell], f);
        });
    }

    /// Among the particles begin ... end-1, seen from x.
    template <class Function>
    UNDINE_HOST_DEVICE
    void
    for_each_among(const int                i,
                   const Vector<dim, Real> &x,
                   const int                begin,
                   const int                end,
                   const Function          &f) const
    {
      constexpr int at_once = 8; // their places are on the way at the same time
      int           first   = begin;
      for (; first + at_once <= end; first += at_once)
        {
          Place<dim, Real> other[at_once];
          UNDINE_UNROLL
          for (int k = 0; k < at_once; ++k)
            other[k] = places[first + k];
          UNDINE_UNROLL
          for (int k = 0; k < at_once; ++k)
            look_at(i, x, first + k, other[k], f);
        }
      if (first == end)
        return;
      Place<dim, Real> other[at_once - 1];
      UNDINE_UNROLL
      for (int k = 0; k < at_once - 1; ++k)
        other[k] = places[minimum(first + k, end - 1)];
      UNDINE_UNROLL
      for (int k = 0; k < at_once - 1; ++k)
        if (first + k < end)
          look_at(i, x, first + k, other[k], f);
    }

    template <class Function>
    UNDINE_HOST_DEVICE
    void
    look_at(const int                i,
            const Vector<dim, Real> &x,
            const int                j,
            const Place<dim, Real>  &other,
            const Function          &f) const
    {
      if (norm_square(other.x - x) < reach * reach && j != i && !other.tag.is_inactive())
        f(j);
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
      using Find = FindNeighbours<dim, Real>;
      const Find find{grid,
                      reach,
                      capacity,
                      particles.places,
                      cell_starts,
                      counts.data(),
                      indices.data(),
                      control};
      if (particles.n < Executor::room_pays_from)
        executor.for_each(particles.n, find);
      else
        executor.template for_each_with_room<Find::together, int>(particles.n, find);
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
