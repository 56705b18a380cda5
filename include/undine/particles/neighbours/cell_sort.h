// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_neighbours_cell_sort_h
#define undine_particles_neighbours_cell_sort_h

#include <undine/particles/execution/atomics.h>
#include <undine/particles/execution/buffer.h>
#include <undine/particles/model/constants.h>

namespace undine::particles
{
  /// Count the particles of each cell; those that are parked have one of their own after all
  /// others.
  template <int dim, class Real>
  struct CountCells
  {
    CellGrid<dim, Real>     grid;
    const Place<dim, Real> *places;
    int                    *cells;
    int                    *counts;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      cells[i] = places[i].tag.is_parked() ? grid.n_cells() : grid.cell_of(places[i].x);
      atomic_add(counts + cells[i], 1);
    }
  };

  /// Put every particle somewhere into the room of its cell; counts down what CountCells counted.
  struct FillCells
  {
    const int *cells;
    const int *starts;
    int       *counts;
    int       *order;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      order[starts[cells[i]] + atomic_add(counts + cells[i], -1) - 1] = i;
    }
  };

  /// Move each particle to its final place, by cell and within a cell by identity. Those that are
  /// parked, after all cells, stay where they are if they are there already; others take the places
  /// that have become free there, in their order. Many may be parked, and few come and go.
  template <int dim, class Real>
  struct MoveSorted
  {
    const int           *cells;
    const int           *starts;
    const int           *order;
    Particles<dim, Real> from, to;
    int                 *where; ///< of the identities below n_solid; nullptr if there are none
    int                  n_solid;
    int                  parked; ///< number of the cell of those that are parked

    UNDINE_HOST_DEVICE
    void
    operator()(const int slot) const
    {
      const int i        = order[slot];
      const int identity = from.identities[i];
      const int target  = cells[i] == parked ? parking_place(i) : place_in_cell(cells[i], identity);
      to.places[target] = from.places[i];
      to.motions[target]    = from.motions[i];
      to.potentials[target] = from.potentials[i];
      to.identities[target] = identity;
      if (identity < n_solid)
        where[identity] = target;
    }

  private:
    UNDINE_HOST_DEVICE
    int
    place_in_cell(const int cell, const int identity) const
    {
      int target = starts[cell];
      for (int other = starts[cell]; other < starts[cell + 1]; ++other)
        target += from.identities[order[other]] < identity ? 1 : 0;
      return target;
    }

    UNDINE_HOST_DEVICE
    int
    parking_place(const int i) const
    {
      const int begin = starts[parked], end = starts[parked + 1];
      if (i >= begin)
        return i;
      int before = 0; // so many others come to park and are before it
      for (int other = begin; other < end; ++other)
        before += order[other] < i ? 1 : 0;
      int target = begin;
      while (cells[target] == parked || before-- > 0)
        ++target;
      return target;
    }
  };

  /// Sorts particles by cells, so that neighbours in space are neighbours in memory. The order
  /// depends on places and identities only.
  template <class Executor, int dim, class Real>
  class CellSort
  {
  public:
    CellSort(Executor &executor, const CellGrid<dim, Real> &grid, const int n)
      : executor(executor)
      , grid(grid)
      , cells(executor, n)
      , order(executor, n)
      , counts(executor, grid.n_cells() + 2)
      , starts(executor, grid.n_cells() + 2)
    {
    }

    /// `where` receives the sorted places of the identities 0 ... n_solid - 1.
    void
    sort(const Particles<dim, Real> &from,
         const Particles<dim, Real> &to,
         int                        *where,
         const int                   n_solid)
    {
      counts.clear();
      executor.for_each(from.n,
                        CountCells<dim, Real>{grid, from.places, cells.data(), counts.data()});
      executor.exclusive_scan(grid.n_cells() + 2, counts.data(), starts.data());
      executor.for_each(from.n,
                        FillCells{cells.data(), starts.data(), counts.data(), order.data()});
      executor.for_each(
        from.n,
        MoveSorted<dim, Real>{
          cells.data(), starts.data(), order.data(), from, to, where, n_solid, grid.n_cells()});
    }

    /// Where the sorted place of the first parked particle is.
    const int *
    first_parked() const
    {
      return starts.data() + grid.n_cells();
    }

    /// First particle of each cell, first parked one, number of all.
    const int *
    cell_starts() const
    {
      return starts.data();
    }

  private:
    Executor             &executor;
    CellGrid<dim, Real>   grid;
    Buffer<Executor, int> cells, order, counts, starts;
  };
} // namespace undine::particles

#endif
