// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_map.h>

#include <algorithm>
#include <limits>
#include <set>

namespace undine
{
  namespace
  {
    /// The cells that touch a side, as a layer with index 0 along the side's axis.
    template <int dim>
    IndexBox<dim>
    layer(const MacGrid<dim> &grid, const unsigned int axis)
    {
      IndexBox<dim> box{{}, grid.cells_along()};
      box.upper[axis] = 1;
      return box;
    }


    template <int dim>
    dealii::Point<dim>
    face_centre(const MacGrid<dim> &grid, const Side side, GridIndex<dim> cell)
    {
      cell[side.axis] = side.end == 0 ? 0 : grid.cells_along()[side.axis];
      return grid.faces(side.axis)->point(cell);
    }


    /// Overwrite the numbers of the faces that `boundary` claims on `side`.
    template <int dim>
    void
    claim(std::vector<std::uint8_t> &numbers,
          const Boundary<dim>       &boundary,
          const std::uint8_t         number,
          const Side                 side,
          const MacGrid<dim>        &grid)
    {
      std::size_t k = 0;
      for_each(layer(grid, side.axis), [&](const GridIndex<dim> &cell) {
        if (!boundary.has_region || boundary.region.value(face_centre(grid, side, cell), 0) > 0)
          numbers[k] = number;
        ++k;
      });
    }
  } // namespace


  template <int dim>
  BoundaryMap<dim>::BoundaryMap(const Options                    &options,
                                const std::vector<Boundary<dim>> &given,
                                const MacGrid<dim>               &grid_)
    : mac_grid(&grid_)
    , boundaries(given)
    , numbers(2 * dim)
  {
    Boundary<dim> others;
    others.name = "other sides";
    boundaries.push_back(others);
    if (boundaries.size() > std::numeric_limits<std::uint8_t>::max())
      throw options.error("", "there are more than 254 boundaries", "Join some of them.");

    std::set<std::uint8_t> present;
    for (unsigned int s = 0; s < 2 * dim; ++s)
      {
        const Side side{s / 2, s % 2};
        if (mac_grid->periodic(side.axis))
          continue;
        numbers[s].assign(layer(*mac_grid, side.axis).size(), boundaries.size() - 1);
        for (unsigned int b = 0; b + 1 < boundaries.size(); ++b)
          for (const auto &claimed : boundaries[b].sides)
            if (claimed.number() == s)
              claim(numbers[s], boundaries[b], b, side, *mac_grid);
        const std::set<std::uint8_t> found(numbers[s].begin(), numbers[s].end());
        present.insert(found.begin(), found.end());
        if (found.size() == 1)
          numbers[s].resize(1);
      }
    for (unsigned int b = 0; b + 1 < boundaries.size(); ++b)
      if (boundaries[b].kind != BoundaryKind::periodic && present.count(b) == 0)
        throw options.section(boundaries[b].name)
          .error(boundaries[b].has_region ? "Region" : "Sides",
                 "no face of the grid belongs to this boundary",
                 "Later sections override earlier ones; a region must contain centres of faces.");
    if (present.count(boundaries.size() - 1) == 0)
      boundaries.pop_back();
  }


  template <int dim>
  const std::vector<Boundary<dim>> &
  BoundaryMap<dim>::all() const
  {
    return boundaries;
  }


  template <int dim>
  unsigned int
  BoundaryMap<dim>::number(const Side side, const GridIndex<dim> &cell) const
  {
    const auto &of_side = numbers[side.number()];
    if (of_side.size() == 1)
      return of_side[0];
    auto face       = mac_grid->cells()->wrapped(cell);
    face[side.axis] = 0;
    return of_side[layer(*mac_grid, side.axis).position(face)];
  }


  template <int dim>
  const Boundary<dim> &
  BoundaryMap<dim>::at(const Side side, const dealii::Point<dim> &place) const
  {
    return at(side, mac_grid->cell_at(place));
  }


  template <int dim>
  bool
  BoundaryMap<dim>::has_opening() const
  {
    return std::any_of(boundaries.begin(), boundaries.end(), [](const auto &boundary) {
      return boundary.is_open();
    });
  }


  template <int dim>
  bool
  BoundaryMap<dim>::lets_fluid_pass() const
  {
    return std::any_of(boundaries.begin(), boundaries.end(), [](const auto &boundary) {
      return boundary.lets_fluid_pass();
    });
  }


  template <int dim>
  std::string
  BoundaryMap<dim>::wall_that_needs_viscosity() const
  {
    for (const auto &boundary : boundaries)
      if (boundary.has_friction())
        return boundary.name;
    return "";
  }


  template class BoundaryMap<2>;
  template class BoundaryMap<3>;
} // namespace undine
