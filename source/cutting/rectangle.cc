// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/cut_workspace.h>

namespace undine
{
  namespace
  {
    /// Where the end of an edge lies relative to the corner of its rectangle.
    template <int dim>
    class Local
    {
    public:
      Local(const GridBlock<dim>              &block,
            const SplitSurface<dim>           &split,
            const GridIndex<dim>              &corner,
            const std::array<unsigned int, 2> &axes)
        : block(block)
        , split(split)
        , corner(corner)
        , axes(axes)
      {
      }

      std::array<double, 2>
      operator()(const int end) const
      {
        std::array<double, 2> result;
        if (end >= 0)
          for (unsigned int d = 0; d < 2; ++d)
            result[d] =
              block.local(axes[d], corner[axes[d]], split.vertices[end].position[axes[d]]);
        else
          {
            const auto node = block.node(-1 - static_cast<std::int64_t>(end));
            for (unsigned int d = 0; d < 2; ++d)
              result[d] = node[axes[d]] == corner[axes[d]]
                            ? 0.
                            : block.planes().width(axes[d], corner[axes[d]]);
          }
        return result;
      }

    private:
      const GridBlock<dim>       &block;
      const SplitSurface<dim>    &split;
      GridIndex<dim>              corner;
      std::array<unsigned int, 2> axes;
    };
  } // namespace


  template <int dim>
  unsigned int
  collect_rectangle(std::vector<PlanarEdge>  &edges,
                    CutWorkspace<dim>        &work,
                    const CutCells<dim>      &cut,
                    const PlacedSurface<dim> &placed,
                    const unsigned int        normal,
                    const GridIndex<dim>     &corner)
  {
    const std::array<unsigned int, 2> axes{{(normal + 1) % 3, (normal + 2) % 3}};
    const Local<dim>                  local(cut.block, work.split, corner, axes);

    const auto &chords_on = work.split.chords_on;
    for (int c = chords_on.first(cut.block.key(corner, normal % dim)); c != KeyedLists::none;
         c     = chords_on.next(c))
      {
            const auto &chord = work.split.chords[c];
            edges.push_back(
          {chord.from, chord.to, chord.edge, false, local(chord.from), local(chord.to)});
      }

    unsigned int flags = 0;
    for (unsigned int side = 0; side < 4; ++side) // lower, right, upper, left
      {
        const unsigned int along = axes[side % 2];
        auto               node  = corner;
        if (side == 1 || side == 2)
          ++node[axes[side - 1]];
        const auto edge = work.grid_edges.edge(
          cut.block, placed.surface, placed.positions, cut.windings, work.split, node, along);
        flags |= edge.flags;
        for (int i = edge.begin; i < edge.end; ++i)
          {
            const auto &interval = work.grid_edges.interval(i);
            const int   from     = side < 2 ? interval.from : interval.to;
            const int   to       = side < 2 ? interval.to : interval.from;
            edges.push_back({from, to, interval.edge, true, local(from), local(to)});
          }
      }
    return flags;
  }


  template unsigned int
  collect_rectangle(std::vector<PlanarEdge> &,
                    CutWorkspace<2> &,
                    const CutCells<2> &,
                    const PlacedSurface<2> &,
                    const unsigned int,
                    const GridIndex<2> &);
  template unsigned int
  collect_rectangle(std::vector<PlanarEdge> &,
                    CutWorkspace<3> &,
                    const CutCells<3> &,
                    const PlacedSurface<3> &,
                    const unsigned int,
                    const GridIndex<3> &);
} // namespace undine
