// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_visibility_facets_of_cells_h
#define undine_fluid_visibility_facets_of_cells_h

#include <undine/fluid/grid/mac_grid.h>
#include <undine/fluid/visibility/obstruction.h>

#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace undine
{
  /// The facets in each cell, so that queries need not visit others.
  template <int dim>
  class FacetsOfCells
  {
  public:
    using FacetImage = typename Obstruction<dim>::FacetImage;
    using Slab       = typename Obstruction<dim>::Slab;

    /// A facet, or one of its images, and the slab and box around it.
    struct Facet
    {
      FacetImage                       image;
      typename Obstruction<dim>::Patch patch; ///< of it alone
    };

    /// No facets, no cells.
    FacetsOfCells() = default;

    /// For cells of `box`, images beyond periodic sides included; add() has to be called for each
    /// cell with facets. Keeps references.
    FacetsOfCells(const MacGrid<dim>     &grid,
                  const Obstruction<dim> &surfaces,
                  const IndexBox<dim>    &box);

    /// Find the facets in a cell.
    void
    add(const GridIndex<dim> &cell);

    /// Are these cells within `box`?
    bool
    know(const IndexBox<dim> &cells) const
    {
      return cells.intersection(box) == cells;
    }

    /// Lower and upper corner of a box of cells [m].
    std::pair<dealii::Point<dim>, dealii::Point<dim>>
    corners(const IndexBox<dim> &cells) const;

    /// The facets in a box of cells, each once.
    std::vector<const Facet *>
    in(const IndexBox<dim> &cells) const;

    /// A slab around all facets in a box of cells if it is parted by a wall, see Obstruction: what
    /// is on one side of it is hidden from the other. This is exact if the wall is plane; otherwise
    /// it may hide some of what is visible past a rim just outside the cells. Nothing if there is
    /// no such wall.
    std::optional<Slab>
    wall(const IndexBox<dim> &cells) const;

    /// Call action(image) for the facets in those of the cells that the segment from `from` to `to`
    /// passes, unless both its ends are on the same side of the facet, until it returns true; for
    /// some facets more than once.
    template <class Action>
    void
    until_facet(const IndexBox<dim>      &cells,
                const dealii::Point<dim> &from,
                const dealii::Point<dim> &to,
                const Action             &action) const
    {
      bool stop = false;
      for_each(cells, [&](const GridIndex<dim> &cell) {
        const auto &in_cell = lists[list_of_cell[box.position(cell)]];
        if (stop || in_cell.facets.empty() || in_cell.patch.slab.leaves_open(from, to) ||
            !is_passed(cell, from, to))
          return;
        for (std::size_t k = 0; !stop && k < in_cell.facets.size(); ++k)
          {
            const auto &facet = facets[in_cell.facets[k]];
            stop              = !facet.patch.slab.leaves_open(from, to) && action(facet.image);
          }
      });
    }

  private:
    /// Does a segment pass through a cell, or past it within rounding?
    bool
    is_passed(const GridIndex<dim>     &cell,
              const dealii::Point<dim> &from,
              const dealii::Point<dim> &to) const;

    struct List
    {
      std::vector<unsigned int>        facets; ///< their numbers
      typename Obstruction<dim>::Patch patch;
      bool                             is_wall;
    };

    /// The number in `facets`, to which it is added if it is new.
    unsigned int
    number_of(const FacetImage &image);

    const MacGrid<dim>       *grid     = nullptr;
    const Obstruction<dim>   *surfaces = nullptr;
    IndexBox<dim>             box;
    std::vector<unsigned int> list_of_cell; ///< in `lists`
    std::vector<List>         lists;        ///< the first is empty
    std::vector<Facet>        facets;       ///< each once, and each of its images

    std::unordered_multimap<unsigned int, unsigned int> images; ///< numbers of those of a facet
  };
} // namespace undine

#endif
