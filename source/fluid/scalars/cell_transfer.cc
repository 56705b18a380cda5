// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/cell_links.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/scalars/cell_transfer.h>

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
    , levels(grid.cells(), before)
  {
    for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      if (!is_kept(cell))
        find_routes(cell);
    });
    find_levels();
  }


  /// Is a cell open all over, before and now, and has no surface passed over it in between?
  template <int dim>
  bool
  CellTransfer<dim>::is_kept(const GridIndex<dim> &cell) const
  {
    if (!is_whole(before ? &before->cells : nullptr, cell) ||
        !is_whole(now ? &now->cells : nullptr, cell))
      return false;
    const auto centre = vicinity.place(grid.cells()->point(cell));
    return !vicinity.is_next_to_body(centre) || !vicinity.is_swept(centre);
  }


  template <int dim>
  typename CellTransfer<dim>::Openings
  CellTransfer<dim>::openings(const SubLattice<dim> *divided, const GridIndex<dim> &cell) const
  {
    if (is_whole(divided, cell))
      return {{-1, vicinity.place(grid.cells()->point(cell)), grid.cell_volume(cell)}};
    Openings result;
    for_each_part(*divided, cell, [&](const int part) {
      const auto &one = divided->all()[part];
      result.push_back({part, vicinity.place(one.place), one.measure});
    });
    return result;
  }


  /// The only ones of a cell are the same if they overlap and no surface has passed between: their
  /// centroids may lie in a body.
  template <int dim>
  bool
  CellTransfer<dim>::leads_to(const Openings &old_ones,
                              const Openings &new_ones,
                              const Opening  &from,
                              const Opening  &to) const
  {
    const auto volume = grid.cell_volume(grid.cell_at(from.centre.point));
    if (old_ones.size() == 1 && new_ones.size() == 1 && from.measure + to.measure > volume &&
        !vicinity.parts(from.centre.point, to.centre.point))
      return true;
    return vicinity.leads_to(from.centre, to.centre);
  }


  /// Each component now takes from the nearest one on its side; of several that take from the same
  /// each does so in proportion to its volume. One from which none takes goes to the nearest.
  template <int dim>
  void
  CellTransfer<dim>::find_routes(const GridIndex<dim> &cell)
  {
    const auto old_ones = openings(levels.divided(), cell),
               new_ones = openings(now ? &now->cells : nullptr, cell);
    const auto nearest  = [&](const Openings &among, const Opening &to, const auto &leads) {
      int    result   = -1;
      double distance = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < among.size(); ++k)
        if (const double d = among[k].centre.point.distance(to.centre.point);
            d < distance && leads(among[k]))
          {
            distance = d;
            result   = k;
          }
      return result;
    };
    std::vector<double> taken(old_ones.size(), 0.);
    std::vector<int>    sources;
    for (const auto &to : new_ones)
      {
        sources.push_back(nearest(
          old_ones, to, [&](const auto &from) { return leads_to(old_ones, new_ones, from, to); }));
        if (sources.back() >= 0)
          taken[sources.back()] += to.measure;
      }
    for (std::size_t j = 0; j < new_ones.size(); ++j)
      if (const int k = sources[j]; k >= 0)
        routes.push_back(
          {{cell, old_ones[k].part}, new_ones[j].part, new_ones[j].measure / taken[k]});
    for (std::size_t k = 0; k < old_ones.size(); ++k)
      if (!(taken[k] > 0))
        {
          const PressurePlace<dim> from{cell, old_ones[k].part};
          const int                j = nearest(new_ones, old_ones[k], [&](const auto &to) {
            return leads_to(old_ones, new_ones, old_ones[k], to);
          });
          if (j >= 0)
            routes.push_back({from, new_ones[j].part, 1.});
          else
            value_at(levels, from) = nowhere;
        }
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
    for (const auto &route : routes) // of all other cells
      value_at(result, route.from.cell, route.to) += route.share * value_at(collected, route.from);
    return result;
  }


  template class CellTransfer<2>;
  template class CellTransfer<3>;
} // namespace undine
