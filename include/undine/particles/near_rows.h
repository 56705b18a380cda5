// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_near_rows_h
#define undine_particles_near_rows_h

#include <undine/particles/constants.h>
#include <undine/particles/share.h>

namespace undine::particles
{
  /// Runs of particles, one after the other in memory.
  template <int count>
  struct Runs
  {
    Share run[count];

    UNDINE_HOST_DEVICE
    int
    size() const
    {
      int sum = 0;
      for (int k = 0; k < count; ++k)
        sum += run[k].end - run[k].begin;
      return sum;
    }
  };

  /// Knows which particles the neighbours of particles that follow each other in sorted order are
  /// among: those of the same lines of cells and of the lines around them, which are few runs.
  template <int dim, class Real>
  struct NearRows
  {
    CellGrid<dim, Real>     grid;
    const Place<dim, Real> *places;
    const int              *starts; ///< of the cells, that of the parked ones after all others
    int                     line;   ///< particles that a line of cells has in a full lattice

    static NearRows
    of(const Constants<dim, Real> &constants, const Place<dim, Real> *places, const int *starts)
    {
      const auto &grid      = constants.grid;
      Real        particles = grid.cells[grid.along] / constants.volume;
      for (int axis = 0; axis < dim; ++axis)
        particles /= grid.inverse_cell[axis];
      return {grid, places, starts, static_cast<int>(particles) + 1};
    }

    /// False where lines beside each other may be far apart in memory, across periodic boundaries.
    UNDINE_HOST_DEVICE
    bool
    are_known() const
    {
      bool result = true;
      for (int axis = 0; axis < dim; ++axis)
        result = result && (axis == grid.along || !grid.periodic[axis]);
      return result;
    }

    /// So many rows that the runs near them probably have at most `room` particles; may be none.
    UNDINE_HOST_DEVICE
    int
    rows_for(const int room) const
    {
      return maximum(0, (room / 3 - (2 * beside + 1) * line) / 32 * 32);
    }

    /// The runs near some rows, of which there must be one.
    UNDINE_HOST_DEVICE
    Runs<3>
    around(const Share &rows) const
    {
      const int length = grid.cells[grid.along], n_lines = grid.n_cells() / length;
      const int last  = maximum(minimum(rows.end, starts[grid.n_cells()]) - 1, 0);
      const int first = grid.cell_of(places[minimum(rows.begin, last)].x) / length;
      const int end   = grid.cell_of(places[last].x) / length + 1;
      int       step  = 1; // between lines that are neighbours along the slowest axis
      for (int axis = 0; axis < dim; ++axis)
        step = maximum(step, grid.strides[axis] / length);
      Runs<3> result;
      int     before = 0;
      for (int k = 0; k < 3; ++k)
        {
          const int shift     = (k - 1) * step;
          const int from      = maximum(before, minimum(n_lines, first + shift - beside));
          before              = maximum(from, minimum(n_lines, end + shift + beside));
          result.run[k].begin = starts[from * length];
          result.run[k].end   = starts[before * length];
        }
      return result;
    }

  private:
    static constexpr int beside = dim - 2; ///< lines on each side that are neighbours, too
  };
} // namespace undine::particles

#endif
