// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/visibility/body_vicinity.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace undine
{
  namespace
  {
    /// Mark `margin` more cells in every direction, one direction after the other.
    template <int dim>
    std::vector<std::uint8_t>
    dilated(std::vector<std::uint8_t> marks, const IndexBox<dim> &box, const int margin)
    {
      std::ptrdiff_t stride = 1;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto source = marks;
          for_each(box, [&](const GridIndex<dim> &cell) {
            const auto k = box.position(cell);
            if (!source[k])
              return;
            const int below = std::min(margin, cell[d] - box.lower[d]);
            const int above = std::min(margin, box.upper[d] - 1 - cell[d]);
            for (int m = -below; m <= above; ++m)
              marks[k + m * stride] = 1;
          });
          stride *= box.upper[d] - box.lower[d];
        }
      return marks;
    }


    /// The cells of the box with two corners in these cells.
    template <int dim>
    IndexBox<dim>
    cells_between(const GridIndex<dim> &begin, const GridIndex<dim> &end)
    {
      IndexBox<dim> cells;
      for (unsigned int d = 0; d < dim; ++d)
        {
          cells.lower[d] = std::min(begin[d], end[d]);
          cells.upper[d] = std::max(begin[d], end[d]) + 1;
        }
      return cells;
    }
  } // namespace


  template <int dim>
  BodyVicinity<dim>::BodyVicinity(const MacGrid<dim>                              &grid_,
                                  const std::shared_ptr<const FluidTopology<dim>> &before,
                                  const std::shared_ptr<const FluidTopology<dim>> &now,
                                  const Obstruction<dim>                          *obstruction,
                                  const GridIndex<dim>                            &width)
  {
    if (!before && !now)
      return;
    grid = &grid_;
    for (unsigned int d = 0; d < dim; ++d)
      planes[d] = &grid->faces(d)->row(d);
    surfaces        = obstruction;
    const auto kind = [](const auto &open, const GridIndex<dim> &cell) {
      return open ? open->cells.kind(cell) : SubLattice<dim>::Kind::whole;
    };
    Field<dim> marks(grid->cells());
    for_each(marks.owned(), [&](const GridIndex<dim> &cell) {
      marks(cell) = kind(before, cell) != SubLattice<dim>::Kind::whole ||
                    kind(now, cell) != SubLattice<dim>::Kind::whole;
    });
    auto wider = width;
    for (int &n_layers : wider.values)
      n_layers += margin;
    marks.exchange(wider);
    box = marks.stored();
    layers.resize(box.size());
    for_each(box, [&](const GridIndex<dim> &cell) {
      layers[box.position(cell)] = marks(cell) > 0 ? 0 : margin + 1;
    });
    if (surfaces != nullptr)
      mark_freshly_cleared_cells();
    measure_layers();
    touched = CellCounts<dim>(
      box, [&](const GridIndex<dim> &cell) { return layers[box.position(cell)] == 0; });
    if (surfaces == nullptr)
      return;
    facets = FacetsOfCells<dim>(grid_, *surfaces, box);
    for_each(box, [&](const GridIndex<dim> &cell) {
      if (layers[box.position(cell)] == 0)
        facets.add(cell);
    });
  }


  template <int dim>
  void
  BodyVicinity<dim>::mark_freshly_cleared_cells()
  {
    const auto mark = [&](GridIndex<dim> cell) {
      for (unsigned int d = 0; d < dim; ++d)
        if (!grid->periodic(d)) // boundary points belong to the cells there
          cell[d] = std::clamp(cell[d], 0, grid->cells_along()[d] - 1);
      if (box.contains(cell))
        layers[box.position(cell)] = 0;
    };
    surfaces->for_each_freshly_cleared(*grid->cells(), box, mark);
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        auto faces = box;
        if (!grid->periodic(axis)) // below the first one there is a boundary point of cells only
          faces.lower[axis] = std::max(faces.lower[axis], 0);
        surfaces->for_each_freshly_cleared(
          *grid->faces(axis), faces, [&](const GridIndex<dim> &face) {
            mark(face);
            mark(moved(face, axis, -1));
          });
      }
  }


  template <int dim>
  void
  BodyVicinity<dim>::measure_layers()
  {
    std::vector<std::uint8_t> touched(layers.size());
    for (std::size_t k = 0; k < layers.size(); ++k)
      touched[k] = layers[k] == 0;
    for (int n = margin; n > 0; --n)
      {
        const auto within = dilated(touched, box, n);
        for (std::size_t k = 0; k < layers.size(); ++k)
          if (within[k])
            layers[k] = touched[k] ? 0 : n;
      }
  }


  template <int dim>
  GridIndex<dim>
  BodyVicinity<dim>::cell_or_image_at(const dealii::Point<dim> &place) const
  {
    GridIndex<dim> cell;
    for (unsigned int d = 0; d < dim; ++d)
      cell[d] = planes[d]->locate(place[d]).lower;
    return cell;
  }


  template <int dim>
  bool
  BodyVicinity<dim>::passes_near(const Place &from, const Place &to) const
  {
    int longest = 0;
    for (unsigned int d = 0; d < dim; ++d)
      longest = std::max(longest, std::abs(to.cell[d] - from.cell[d]));
    const auto counts = [&](const GridIndex<dim> &cell) {
      return !box.contains(cell) || layers[box.position(cell)] <= margin;
    };
    if (counts(from.cell) || counts(to.cell))
      return true;
    // The margin bridges the cells between samples.
    const int n_steps = 1 + longest / margin;
    for (int s = 1; s < n_steps; ++s)
      if (counts(cell_or_image_at(from.point + double(s) / n_steps * (to.point - from.point))))
        return true;
    return false;
  }


  template <int dim>
  bool
  BodyVicinity<dim>::is_clear(const GridIndex<dim> &begin, const GridIndex<dim> &end) const
  {
    if (grid == nullptr)
      return true;
    const auto cells = cells_between(begin, end);
    if (!(cells.intersection(box) == cells))
      return false;
    int longest = 0;
    for (unsigned int d = 0; d < dim; ++d)
      longest = std::max(longest, std::abs(end[d] - begin[d]));
    return layers[box.position(begin)] > longest || touched.in(cells) == 0;
  }


  template <int dim>
  bool
  BodyVicinity<dim>::is_hidden(const Place &from, const Place &to) const
  {
    if (surfaces == nullptr)
      return false;
    const auto cells = cells_between(from.cell, to.cell);
    if (!facets.know(cells))
      return surfaces->first_hit(from.point, to.point) <= 1;
    bool hidden = false;
    facets.until_facet(cells, from.point, to.point, [&](const auto &facet) {
      hidden = surfaces->first_hit(facet, from.point, to.point) <= 1;
      return hidden;
    });
    return hidden;
  }


  template <int dim>
  bool
  BodyVicinity<dim>::is_swept(const Place &place) const
  {
    return surfaces != nullptr && surfaces->is_freshly_cleared(place.point);
  }


  template <int dim>
  bool
  BodyVicinity<dim>::leads_to(const Place &before, const Place &now) const
  {
    return surfaces == nullptr || !is_hidden(place(surfaces->carried(before.point)), now);
  }


  template <int dim>
  bool
  BodyVicinity<dim>::parts(const dealii::Point<dim> &before, const dealii::Point<dim> &now) const
  {
    return surfaces != nullptr && surfaces->is_freshly_cleared(before) &&
           surfaces->is_freshly_cleared(now) && !leads_to(place(before), place(now));
  }


  template <int dim>
  double
  BodyVicinity<dim>::hit_of_facets(const Place &from, const Place &to) const
  {
    constexpr std::size_t few_cells = 27; // cells; through more of them a tree is faster
    double                result    = std::numeric_limits<double>::infinity();
    const auto            cells     = cells_between(from.cell, to.cell);
    if (cells.size() > few_cells || !facets.know(cells))
      return surfaces->first_hit(from.point, to.point);
    facets.until_facet(cells, from.point, to.point, [&](const auto &facet) {
      result = std::min(result, surfaces->first_hit(facet, from.point, to.point));
      return false;
    });
    return result;
  }


  template class BodyVicinity<2>;
  template class BodyVicinity<3>;
} // namespace undine
