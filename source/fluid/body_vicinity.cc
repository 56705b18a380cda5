// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/body_vicinity.h>

#include <algorithm>
#include <cmath>
#include <limits>

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


    /// The cell at a place; beyond a periodic side the image there, which this rank may know though
    /// it does not know the cell.
    template <int dim>
    GridIndex<dim>
    cell_or_image_at(const MacGrid<dim> &grid, const dealii::Point<dim> &place)
    {
      GridIndex<dim> cell;
      for (unsigned int d = 0; d < dim; ++d)
        cell[d] = grid.faces(d)->row(d).locate(place[d]).lower;
      return cell;
    }
  } // namespace


  template <int dim>
  BodyVicinity<dim>::BodyVicinity(const MacGrid<dim>                          &grid_,
                                  const std::shared_ptr<const OpenParts<dim>> &before,
                                  const std::shared_ptr<const OpenParts<dim>> &now,
                                  const GridIndex<dim>                        &width)
  {
    if (!before && !now)
      return;
    grid            = &grid_;
    const auto kind = [](const auto &open, const GridIndex<dim> &cell) {
      return open ? open->cells.kind(cell) : LatticeParts<dim>::Kind::whole;
    };
    Field<dim> marks(grid->cells());
    for_each(marks.owned(), [&](const GridIndex<dim> &cell) {
      marks(cell) = kind(before, cell) != LatticeParts<dim>::Kind::whole ||
                    kind(now, cell) != LatticeParts<dim>::Kind::whole;
    });
    auto wider = width;
    for (int &layers : wider.values)
      layers += margin;
    marks.exchange(wider);
    box = marks.stored();
    touched.resize(box.size());
    for_each(box,
             [&](const GridIndex<dim> &cell) { touched[box.position(cell)] = marks(cell) > 0; });
    vicinity = dilated(touched, box, margin);
    find_extent();
  }


  template <int dim>
  void
  BodyVicinity<dim>::find_extent()
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    lowest.fill(infinity);
    highest.fill(-infinity);
    for_each(box, [&](const GridIndex<dim> &cell) {
      if (!vicinity[box.position(cell)])
        return;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const int  last     = grid->cells_along()[d] - 1;
          const bool periodic = grid->periodic(d);
          // Places beyond a boundary belong to the cell there.
          const double low  = periodic || cell[d] <= 0 ? -infinity : grid->planes(d)[cell[d]];
          const double high = periodic || cell[d] >= last ? infinity : grid->planes(d)[cell[d] + 1];
          lowest[d]         = std::min(lowest[d], low);
          highest[d]        = std::max(highest[d], high);
        }
    });
  }


  template <int dim>
  bool
  BodyVicinity<dim>::is_near(const dealii::Point<dim> &from, const dealii::Point<dim> &to) const
  {
    if (grid == nullptr)
      return false;
    for (unsigned int d = 0; d < dim; ++d)
      if (std::max(from[d], to[d]) < lowest[d] || std::min(from[d], to[d]) > highest[d])
        return false;
    const auto begin = cell_or_image_at(*grid, from), end = cell_or_image_at(*grid, to);
    int        longest = 0;
    for (unsigned int d = 0; d < dim; ++d)
      longest = std::max(longest, std::abs(end[d] - begin[d]));
    // The margin bridges the cells between samples.
    const int n_samples = 2 + longest / margin;
    for (int s = 0; s < n_samples; ++s)
      {
        const auto cell = cell_or_image_at(*grid, from + double(s) / (n_samples - 1) * (to - from));
        if (!box.contains(cell) || vicinity[box.position(cell)])
          return true;
      }
    return false;
  }


  template <int dim>
  bool
  BodyVicinity<dim>::is_clear(const dealii::Point<dim> &from, const dealii::Point<dim> &to) const
  {
    if (grid == nullptr)
      return true;
    const auto    begin = cell_or_image_at(*grid, from), end = cell_or_image_at(*grid, to);
    IndexBox<dim> cells;
    for (unsigned int d = 0; d < dim; ++d)
      {
        cells.lower[d] = std::min(begin[d], end[d]);
        cells.upper[d] = std::max(begin[d], end[d]) + 1;
      }
    if (!(cells.intersection(box) == cells))
      return false;
    bool clear = true;
    for_each(cells, [&](const GridIndex<dim> &cell) {
      clear = clear && touched[box.position(cell)] == 0;
    });
    return clear;
  }


  template class BodyVicinity<2>;
  template class BodyVicinity<3>;
} // namespace undine
