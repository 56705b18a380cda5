// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/cell_links.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/visibility/cell_transfer.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    constexpr double nowhere = std::numeric_limits<double>::infinity(); ///< a level
  }                                                                     // namespace


  template <int dim>
  CellTransfer<dim>::CellTransfer(const MacGrid<dim>                              &grid,
                                  const std::shared_ptr<const FluidTopology<dim>> &before,
                                  const std::shared_ptr<const FluidTopology<dim>> &now,
                                  const BodyVicinity<dim>                         &vicinity)
    : grid(grid)
    , before(before)
    , now(now)
    , vicinity(vicinity)
    , known(known_points(*grid.cells()))
    , levels(grid.cells(), before)
  {
    kept.reserve(known.size());
    levels.exchange(1);
    for_each(known, [&](const GridIndex<dim> &cell) {
      kept.push_back(remains(cell));
      if (!kept.back())
        find_routes(cell);
    });
    find_levels();
  }


  template <int dim>
  bool
  CellTransfer<dim>::remains(const GridIndex<dim> &cell) const
  {
    if (!is_whole(before ? &before->cells : nullptr, cell) ||
        !is_whole(now ? &now->cells : nullptr, cell))
      return false;
    const auto centre = vicinity.place(grid.cells()->point(cell));
    return !vicinity.is_next_to_body(centre) || !vicinity.is_swept(centre);
  }


  template <int dim>
  std::vector<Opening<dim>>
  CellTransfer<dim>::openings(const SubLattice<dim> *divided, const GridIndex<dim> &cell) const
  {
    if (is_whole(divided, cell))
      return {{-1, vicinity.place(grid.cells()->point(cell)), grid.cell_volume(cell)}};
    std::vector<Opening<dim>> result;
    for_each_part(*divided, cell, [&](const int part) {
      const auto &one = divided->all()[part];
      result.push_back({part, vicinity.place(one.place), one.measure});
    });
    return result;
  }


  template <int dim>
  void
  CellTransfer<dim>::find_routes(const GridIndex<dim> &cell)
  {
    const auto old_ones = openings(levels.divided(), cell),
               new_ones = openings(now ? &now->cells : nullptr, cell);
    std::vector<bool> is_left(old_ones.size(), false);
    for (const auto &one : successions(old_ones, new_ones, grid.cell_volume(cell), vicinity))
      {
        is_left[one.before] = true;
        all_routes.push_back(
          {{cell, old_ones[one.before].part}, new_ones[one.now].part, one.share});
      }
    for (std::size_t k = 0; k < old_ones.size(); ++k)
      if (!is_left[k])
        value_at(levels, cell, old_ones[k].part) = nowhere;
  }


  template <int dim>
  void
  CellTransfer<dim>::find_levels()
  {
    const auto   communicator = grid.communicator();
    unsigned int n_covered    = 0;
    for_each_value(levels, [&](const double level, const auto &, const auto &) {
      n_covered += level == nowhere;
    });
    if (dealii::Utilities::MPI::sum(n_covered, communicator) == 0)
      {
        levels = Field<dim>();
        return;
      }
    ways = Field<dim>(grid.cells(), before);
    for (unsigned int n_found = 1; n_found > 0;)
      {
        levels.exchange(1);
        n_found = 0;
        ++n_levels;
        std::vector<PressurePlace<dim>> found;
        for_each_cell_link(grid, before.get(), [&](const CellLink<dim> &link) {
          if (value_at(levels, link.from) == nowhere && value_at(levels, link.to) == n_levels - 1 &&
              link.area(grid, before.get()) > 0)
            {
              value_at(ways, link.from) += link.area(grid, before.get());
              found.push_back(link.from);
            }
        });
        for (const auto &place : found)
          value_at(levels, place) = n_levels;
        n_found =
          dealii::Utilities::MPI::sum(static_cast<unsigned int>(found.size()), communicator);
      }
    ways.exchange(1);
  }


  template <int dim>
  Field<dim>
  CellTransfer<dim>::transfer(const Field<dim> &amounts) const
  {
    auto collected = amounts;
    for (unsigned int level = n_levels; level-- > 1;)
      {
        collected.exchange(1);
        for_each_cell_link(grid, before.get(), [&](const CellLink<dim> &link) {
          if (value_at(levels, link.from) == level - 1 && value_at(levels, link.to) == level &&
              link.area(grid, before.get()) > 0)
            value_at(collected, link.from) += link.area(grid, before.get()) /
                                              value_at(ways, link.to) *
                                              value_at(collected, link.to);
        });
      }
    Field<dim> result(grid.cells(), now);
    for_each(result.owned(), [&](const GridIndex<dim> &cell) {
      if (is_kept(cell))
        result(cell) = collected(cell);
    });
    for (const auto &route : all_routes) // of all other cells
      if (result.owned().contains(route.from.cell))
        value_at(result, route.from.cell, route.to) +=
          route.share * value_at(collected, route.from);
    return result;
  }


  template class CellTransfer<2>;
  template class CellTransfer<3>;
} // namespace undine
