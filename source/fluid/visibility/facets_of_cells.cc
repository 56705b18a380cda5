// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/visibility/facets_of_cells.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace undine
{
  template <int dim>
  FacetsOfCells<dim>::FacetsOfCells(const MacGrid<dim>     &grid_,
                                    const Obstruction<dim> &surfaces_,
                                    const IndexBox<dim>    &box_)
    : grid(&grid_)
    , surfaces(&surfaces_)
    , box(box_)
    , list_of_cell(box.size(), 0)
    , lists(1)
  {
  }


  template <int dim>
  void
  FacetsOfCells<dim>::add(const GridIndex<dim> &cell)
  {
    IndexBox<dim> only{cell, cell};
    for (int &upper : only.upper.values)
      ++upper;
    const dealii::BoundingBox<dim> space(corners(only));
    const auto                     near = surfaces->facets_near(space);
    if (near.empty())
      return;
    const auto patch = surfaces->patch(near);
    List       list{{}, patch, surfaces->is_wall(near, patch.slab, space)};
    list.facets.reserve(near.size());
    for (const auto &image : near)
      list.facets.push_back(number_of(image));
    list_of_cell[box.position(cell)] = lists.size();
    lists.push_back(std::move(list));
  }


  template <int dim>
  unsigned int
  FacetsOfCells<dim>::number_of(const FacetImage &image)
  {
    const auto [begin, end] = images.equal_range(image.facet);
    for (auto known = begin; known != end; ++known)
      if (facets[known->second].image.to_facet == image.to_facet)
        return known->second;
    images.emplace(image.facet, facets.size());
    facets.push_back({image, surfaces->patch({image})});
    return facets.size() - 1;
  }


  template <int dim>
  std::pair<dealii::Point<dim>, dealii::Point<dim>>
  FacetsOfCells<dim>::corners(const IndexBox<dim> &cells) const
  {
    std::pair<dealii::Point<dim>, dealii::Point<dim>> result;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto &planes = grid->faces(d)->row(d);
        result.first[d]    = planes.position(cells.lower[d]);
        result.second[d]   = planes.position(cells.upper[d]);
      }
    return result;
  }


  template <int dim>
  std::vector<const typename FacetsOfCells<dim>::Facet *>
  FacetsOfCells<dim>::in(const IndexBox<dim> &cells) const
  {
    std::vector<const Facet *> result;
    for_each(cells, [&](const GridIndex<dim> &cell) {
      for (const unsigned int number : lists[list_of_cell[box.position(cell)]].facets)
        result.push_back(&facets[number]);
    });
    std::sort(result.begin(), result.end(), std::less<>());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }


  template <int dim>
  std::optional<typename Obstruction<dim>::Slab>
  FacetsOfCells<dim>::wall(const IndexBox<dim> &cells) const
  {
    constexpr double    alike = 0.92; // 23 degrees: with 45 for facets all are oriented alike
    std::optional<Slab> slab;
    bool                parted = true;
    for_each(cells, [&](const GridIndex<dim> &cell) {
      const auto &list = lists[list_of_cell[box.position(cell)]];
      if (list.facets.empty() || !parted)
        return;
      if (!slab)
        slab = list.patch.slab;
      parted = list.is_wall && std::abs(slab->normal * list.patch.slab.normal) > alike;
      if (parted)
        slab = list.patch.widened(*slab);
    });
    return parted ? slab : std::nullopt;
  }


  template <int dim>
  bool
  FacetsOfCells<dim>::is_passed(const GridIndex<dim>     &cell,
                                const dealii::Point<dim> &from,
                                const dealii::Point<dim> &to) const
  {
    constexpr double tolerance = 1e-6; // of a cell
    double           enter = 0, leave = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto  &row   = grid->faces(d)->row(d);
        const double lower = row.position(cell[d]), upper = row.position(cell[d] + 1);
        const double rim = tolerance * (upper - lower), path = to[d] - from[d];
        const double to_lower = lower - rim - from[d], to_upper = upper + rim - from[d];
        if (path == 0)
          {
            if (to_lower > 0 || to_upper < 0)
              return false;
            continue;
          }
        enter = std::max(enter, std::min(to_lower / path, to_upper / path));
        leave = std::min(leave, std::max(to_lower / path, to_upper / path));
      }
    return enter <= leave;
  }


  template class FacetsOfCells<2>;
  template class FacetsOfCells<3>;
} // namespace undine
