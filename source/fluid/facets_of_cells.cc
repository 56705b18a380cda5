// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/facets_of_cells.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// Widen a slab so that it holds what a patch holds.
    template <int dim>
    void
    widen(typename Obstruction<dim>::Slab &slab, const typename Obstruction<dim>::Patch &patch)
    {
      // n x = n m + o (x - m) + (n - o) (x - m) with the other normal o and the middle m
      auto other = patch.slab;
      if (slab.normal * other.normal < 0)
        {
          other.normal = -other.normal;
          std::swap(other.lower, other.upper);
          other.lower = -other.lower, other.upper = -other.upper;
        }
      const double turned = (slab.normal - other.normal).norm() * patch.radius;
      const double shift  = (slab.normal - other.normal) * patch.middle;
      slab.lower          = std::min(slab.lower, other.lower + shift - turned);
      slab.upper          = std::max(slab.upper, other.upper + shift + turned);
    }
  } // namespace


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
    const auto                     images = surfaces->facets_near(space);
    if (images.empty())
      return;
    const auto patch = surfaces->patch(images);
    List       list{{}, patch, surfaces->is_wall(images, patch.slab, space)};
    for (const auto &image : images)
      {
        const auto facet = surfaces->patch({image});
        list.facets.push_back({image, facet.slab, facet.lower, facet.upper});
      }
    list_of_cell[box.position(cell)] = lists.size();
    lists.push_back(std::move(list));
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
      for (const auto &facet : lists[list_of_cell[box.position(cell)]].facets)
        result.push_back(&facet);
    });
    std::sort(result.begin(), result.end(), [](const Facet *a, const Facet *b) {
      return a->image.facet < b->image.facet;
    });
    const auto last = std::unique(result.begin(), result.end(), [](const Facet *a, const Facet *b) {
      return a->image.facet == b->image.facet && a->image.to_facet == b->image.to_facet;
    });
    result.erase(last, result.end());
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
        widen<dim>(*slab, list.patch);
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
        const double rim = tolerance * (upper - lower), way = to[d] - from[d];
        const double to_lower = lower - rim - from[d], to_upper = upper + rim - from[d];
        if (way == 0)
          {
            if (to_lower > 0 || to_upper < 0)
              return false;
            continue;
          }
        enter = std::max(enter, std::min(to_lower / way, to_upper / way));
        leave = std::min(leave, std::max(to_lower / way, to_upper / way));
      }
    return enter <= leave;
  }


  template class FacetsOfCells<2>;
  template class FacetsOfCells<3>;
} // namespace undine
