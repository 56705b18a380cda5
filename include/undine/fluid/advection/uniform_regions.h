// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_advection_uniform_regions_h
#define undine_fluid_advection_uniform_regions_h

#include <undine/fluid/grid/field.h>

#include <algorithm>
#include <vector>

namespace undine
{
  /// Where fields that are advected are uniform: within reach of a point all values of each field
  /// are the same but for a share of its range, so that the flow changes nothing there. To be safe
  /// and fast, neighbours are compared: they must differ by less than would add up to that share
  /// along the longest path from neighbour to neighbour between two of these values.
  template <int dim>
  class UniformRegions
  {
  public:
    /// `sources`: with the same lattice, topology and stored box, `reach` ghost layers at least;
    /// `share` of a field's range that differences may have, from 0 to 1. Points next to which
    /// bodies divide others, in the sources or `now`, are never uniform; nullptr: nothing is cut.
    /// Collective.
    UniformRegions(const std::vector<Field<dim>> &sources,
                   const GridIndex<dim>          &reach,
                   const double                   share,
                   const SubLattice<dim>         *now = nullptr);

    /// Is an owned point in a uniform region?
    bool
    contains(const GridIndex<dim> &index) const
    {
      return is_uniform[owned.position(index)] != 0;
    }

    /// Call `action(index, n)` for every run along the first direction of owned points that are all
    /// in uniform regions, or of which none is: the first point and their number. @{
    template <class Action>
    void
    for_each_uniform_run(Action &&action) const
    {
      for_each_run(1, action);
    }

    template <class Action>
    void
    for_each_other_run(Action &&action) const
    {
      for_each_run(0, action);
    }
    /// @}

  private:
    /// Of points that all have this mark in `is_uniform`.
    template <class Action>
    void
    for_each_run(const char mark, Action &&action) const
    {
      auto      row_starts = owned;
      const int points     = owned.upper[0] - owned.lower[0];
      row_starts.upper[0]  = owned.lower[0] + (points > 0);
      for_each(row_starts, [&](GridIndex<dim> index) {
        const char *begin = is_uniform.data() + owned.position(index), *end = begin + points;
        for (const char *run = begin; run != end;)
          {
            const char *stop = std::find(run, end, char(*run == 0));
            index[0]         = owned.lower[0] + int(run - begin);
            if (*run == mark)
              action(index, int(stop - run));
            run = stop;
          }
      });
    }

    IndexBox<dim>     owned;
    std::vector<char> is_uniform; ///< 1: in a uniform region, 0: not
  };
} // namespace undine

#endif
