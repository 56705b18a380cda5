// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_multigrid_multigrid_build_h
#define undine_particles_multigrid_multigrid_build_h

#include <undine/particles/model/particle.h>
#include <undine/particles/multigrid/cell_interpolation.h>
#include <undine/particles/multigrid/multigrid.h>
#include <undine/particles/pressure/pressure_matrix.h>

namespace undine::particles
{
  /// Which cells have unknowns: 1, else 0, for the cells of all levels.
  template <int dim, class Real>
  struct MarkActiveCells
  {
    MultigridLevels<dim, Real> levels;
    const int                 *starts; ///< of the cells' particles
    const int                 *is_unknown;
    int                       *marks;

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      team.for_each_spread(levels.level[0].grid.n, [&](const int cell) {
        int mark = 0;
        for (int i = starts[cell]; i < starts[cell + 1] && mark == 0; ++i)
          mark = is_unknown[i] != 0 ? 1 : 0;
        marks[cell] = mark;
      });
      for (int k = 1; k < levels.n; ++k)
        {
          team.sync();
          const auto &grid = levels.level[k].grid;
          team.for_each_spread(grid.n, [&](const int index) {
            marks[levels.begins[k] + index] =
              active_children(levels, marks, k, grid.cell(index)) != 0 ? 1 : 0;
          });
        }
    }

    /// As bits.
    UNDINE_HOST_DEVICE
    static unsigned int
    active_children(const MultigridLevels<dim, Real> &levels,
                    const int                        *marks,
                    const int                         k,
                    const StencilCell<dim>           &cell)
    {
      const auto  &finer  = levels.level[k - 1].grid;
      unsigned int result = 0;
      for (int child = 0; child < (1 << dim); ++child)
        {
          const auto other  = cell.child(child);
          bool       exists = true;
          for (int axis = 0; axis < dim; ++axis)
            exists = exists && other.coordinates[axis] < finer.cells[axis];
          if (exists && marks[levels.begins[k - 1] + other.index(finer)] != 0)
            result |= 1u << child;
        }
      return result;
    }
  };


  /// Lists the marked cells, level by level.
  template <int dim, class Real>
  struct ListActiveCells
  {
    MultigridLevels<dim, Real> levels;
    const int                 *marks;
    const int                 *marks_before;

    UNDINE_HOST_DEVICE
    void
    operator()(const int place) const
    {
      int k = 0;
      while (place >= levels.begins[k + 1])
        ++k;
      const auto &level  = levels.level[k];
      const int   before = marks_before[levels.begins[k]];
      if (place == levels.begins[k])
        *level.n_active = marks_before[levels.begins[k + 1]] - before;
      if (marks[place] == 0)
        return;
      auto cell     = level.grid.cell(place - levels.begins[k]);
      cell.children = k > 0 ? MarkActiveCells<dim, Real>::active_children(levels, marks, k, cell)
                            : active_next(cell);
      level.active[marks_before[place] - before] = cell;
    }

  private:
    /// As bits.
    UNDINE_HOST_DEVICE
    unsigned int
    active_next(const StencilCell<dim> &cell) const
    {
      const auto  &grid   = levels.level[0].grid;
      unsigned int result = 0;
      for (int axis = 0; axis < dim; ++axis)
        for (const int step : {-1, 1})
          {
            auto      other         = cell;
            const int c             = cell.coordinates[axis];
            other.coordinates[axis] = grid.next_to(c, step, axis);
            if (other.coordinates[axis] != c && marks[other.index(grid)] != 0)
              result |= StencilCell<dim>::bit_of_next(axis, step);
          }
      return result;
    }
  };


  /// A particle's row of the matrix, summed over the particles of each cell around it.
  template <int dim, class Real, class Entry>
  struct SumRowByCells
  {
    CellGrid<dim, Real>         cells;
    StencilGrid<dim>            grid;
    const Place<dim, Real>     *places;
    const int                  *is_unknown;
    PressureMatrix<Real, Entry> matrix;
    const Real                 *diagonal;
    int                        *cell_of; ///< of the particle; -1: has no unknown
    PlaceInCell<dim, Real>     *places_in_cells;
    Real                       *sums; ///< entry k of particle i at k n + i

    /// `row` has room for a stencil.
    template <class Row>
    UNDINE_HOST_DEVICE
    void
    operator()(const int i, Row &row) const
    {
      constexpr int size = StencilGrid<dim>::size;
      cell_of[i]         = -1;
      if (!is_unknown[i])
        return;
      StencilCell<dim> here = {};
      for (int axis = 0; axis < dim; ++axis)
        here.coordinates[axis] = cells.coordinate(places[i].x, axis);
      cell_of[i]         = here.index(grid);
      places_in_cells[i] = PlaceInCell<dim, Real>::of(cells, places[i].x);
      for (int k = 0; k < size; ++k)
        row[k] = k == size / 2 ? diagonal[i] : Real(0);
      matrix.template for_each_in_row<Place<dim, Real>>(
        i, places, [&](const Entry entry, const Place<dim, Real> &other) {
          int where = 0;
          for (int axis = dim - 1; axis >= 0; --axis)
            where = 3 * where + 1 +
                    grid.difference(cells.coordinate(other.x, axis), here.coordinates[axis], axis);
          row[where] -= entry.coefficient(matrix.scale);
        });
      for (int k = 0; k < size; ++k)
        sums[static_cast<std::size_t>(k) * matrix.n + i] = row[k];
    }
  };


  /// The matrices of all levels: that of the finest one from the sums of SumRowByCells, those of
  /// coarser ones as sums of the finer one's.
  template <int dim, class Real>
  struct BuildLevels
  {
    static constexpr int size = StencilGrid<dim>::size;

    MultigridLevels<dim, Real> levels;
    const int                 *starts; ///< of the cells' particles
    const int                 *is_unknown;
    const Real                *sums;
    int                        n; ///< particles

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      const auto counts   = levels.counts();
      const int  n_active = counts.of[0];
      team.for_each_spread(size * n_active,
                           [&](const int place) { sum_rows(place / n_active, place % n_active); });
      for (int k = 1; k < levels.n; ++k)
        {
          team.sync();
          const auto &fine = levels.level[k - 1], &coarse = levels.level[k];
          team.for_each_by_lanes(counts.of[k], [&](const int c, const auto &lanes) {
            coarsen(fine, coarse, coarse.active[c], lanes);
          });
        }
    }

  private:
    UNDINE_HOST_DEVICE
    void
    sum_rows(const int entry, const int c) const
    {
      const auto &level = levels.level[0];
      const int   cell  = level.active[c].index(level.grid);
      Real        sum   = 0;
      for (int i = starts[cell]; i < starts[cell + 1]; ++i)
        if (is_unknown[i])
          sum += sums[static_cast<std::size_t>(entry) * n + i];
      set(level, entry, cell, sum);
    }

    UNDINE_HOST_DEVICE
    static void
    set(const MultigridLevel<dim, Real> &level, const int entry, const int index, const Real value)
    {
      level.matrix[static_cast<std::size_t>(entry) * level.grid.n + index] = value;
      if (entry == size / 2)
        level.inverse_diagonal[index] = value > Real(1e-6) ? 1 / value : Real(0);
    }

    /// A lane for each child.
    template <class Lanes>
    UNDINE_HOST_DEVICE
    static void
    coarsen(const MultigridLevel<dim, Real> &fine,
            const MultigridLevel<dim, Real> &coarse,
            const StencilCell<dim>          &cell,
            const Lanes                     &lanes)
    {
      Real row[size] = {};
      UNDINE_UNROLL
      for (int first = 0; first < (1 << dim); first += Lanes::count())
        {
          const int child = first + lanes.rank();
          if (cell.children >> child & 1)
            add_child(fine, coarse, cell, child, row);
        }
      UNDINE_UNROLL_ALL
      for (int entry = 0; entry < size; ++entry)
        {
          const Real sum = lanes.sum(row[entry]);
          if (lanes.rank() == entry % Lanes::count())
            set(coarse, entry, cell.index(coarse.grid), sum);
        }
    }

    UNDINE_HOST_DEVICE
    static void
    add_child(const MultigridLevel<dim, Real> &fine,
              const MultigridLevel<dim, Real> &coarse,
              const StencilCell<dim>          &cell,
              const int                        child,
              Real (&row)[size])
    {
      const auto finer = cell.child(child);
      const int  index = finer.index(fine.grid);
      Real       its[size];
      UNDINE_UNROLL_ALL
      for (int entry = 0; entry < size; ++entry)
        its[entry] = fine.entry(entry, index);
      UNDINE_UNROLL
      for (int axis = 0, stride = 1; axis < dim; ++axis, stride *= 3)
        {
          const int  c    = finer.coordinates[axis];
          const bool only = coarse.grid.cells[axis] == 1;
          // Beyond a last child without a sibling, the next one is in the next parent already.
          const bool low = c % 2 == 0, high = !low || c + 1 == fine.grid.cells[axis];
          UNDINE_UNROLL_ALL
          for (int line = 0; line < size / 3; ++line)
            {
              Real *const first = its + line / stride * 3 * stride + line % stride;
              Real       &a = first[0], &b = first[stride], &d = first[2 * stride];
              b += (only || !low ? a : Real(0)) + (only || !high ? d : Real(0));
              a = only || !low ? Real(0) : a;
              d = only || !high ? Real(0) : d;
            }
        }
      UNDINE_UNROLL_ALL
      for (int entry = 0; entry < size; ++entry)
        row[entry] += its[entry];
    }
  };
} // namespace undine::particles

#endif
