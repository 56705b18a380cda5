// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_grid_edges_h
#define undine_cutting_grid_edges_h

#include <undine/cutting/grid_block.h>
#include <undine/cutting/node_windings.h>
#include <undine/cutting/split_surface.h>
#include <undine/surface/surface.h>

#include <array>
#include <tuple>
#include <vector>

namespace undine
{
  /// Which parts of the grid's edges lie in the fluid.
  ///
  /// The crossings of an edge are sorted by position; ties by where the crossings go when the
  /// planes move down their axes by e_0 << e_1 << ...: a crossing on a line of axis a moves by
  ///
  ///     e_d N_d / N_a,
  ///
  /// N being the facet's normal. Where rounding has broken the alternation of crossings into and
  /// out of the solid, it is restored from the signs: the topology follows the integers.
  template <int dim>
  class GridEdges
  {
  public:
    /// A part of a grid edge in the fluid. Ends: a vertex, or -1 - key of a node.
    struct Interval
    {
      int from, to;
      int edge; ///< edge number
    };

    /// The intervals begin..end of one grid edge, upwards.
    struct Edge
    {
      int          begin = -1, end = -1;
      unsigned int flags = 0;
    };

    void
    clear();

    /// The fluid intervals of the grid edge along `axis` that begins at `node`, found at the first
    /// call.
    Edge
    edge(const GridBlock<dim>                  &block,
         const Surface<dim>                    &surface,
         const std::vector<dealii::Point<dim>> &positions,
         const NodeWindings<dim>               &windings,
         SplitSurface<dim>                     &split,
         const GridIndex<dim>                  &node,
         const unsigned int                     axis);

    /// An interval by its number, see Edge.
    const Interval &
    interval(const int number) const
    {
      return intervals[number];
    }

    /// Grid edges where the alternation had to be restored: rounding ties, or walls as thin as
    /// rounding, which may leak.
    int
    n_reordered() const
    {
      return reordered;
    }

  private:
    /// A crossing with what it is sorted by, stored: recomputed keys could be inconsistent.
    struct Sorted
    {
      double                      position;
      std::array<double, dim - 1> shifts;
      int                         crossing;

      bool
      operator<(const Sorted &other) const
      {
        return std::tie(position, shifts, crossing) <
               std::tie(other.position, other.shifts, other.crossing);
      }
    };

    void
    sort_crossings(const Surface<dim>                    &surface,
                   const std::vector<dealii::Point<dim>> &positions,
                   const SplitSurface<dim>               &split,
                   const std::int64_t                     key,
                   const GridIndex<dim>                  &node,
                   const unsigned int                     axis);

    /// Make crossings into and out of the solid alternate from winding `start` on; an inversion by
    /// more than rounding is flagged instead.
    void
    restore_alternation(Edge                    &edge,
                        const SplitSurface<dim> &split,
                        const unsigned int       axis,
                        const int                start,
                        const double             width);

    IndexMap              slots;
    std::vector<Edge>     edges;
    std::vector<Interval> intervals;
    std::vector<Sorted>   keys;
    std::vector<int>      order, entering, leaving;
    int                   reordered = 0;
  };
} // namespace undine

#endif
