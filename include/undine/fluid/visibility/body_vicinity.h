// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_visibility_body_vicinity_h
#define undine_fluid_visibility_body_vicinity_h

#include <undine/fluid/grid/cell_counts.h>
#include <undine/fluid/grid/field.h>
#include <undine/fluid/grid/mac_grid.h>
#include <undine/fluid/visibility/facets_of_cells.h>
#include <undine/fluid/visibility/obstruction.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace undine
{
  /// Which cells have to do with bodies, now or at the time of the last velocity: a cheap answer
  /// for the many places that have not.
  template <int dim>
  class BodyVicinity
  {
  public:
    /// So many cells around a place take part in interpolation there.
    static constexpr int margin = 3;

    /// A place and the cell that it is in, or that cell's image beyond a periodic side.
    struct Place
    {
      dealii::Point<dim> point;
      GridIndex<dim>     cell;
    };

    /// No bodies.
    BodyVicinity() = default;

    /// `before` and `now`: the topology of the fluid at the time of the last velocity and now,
    /// nullptr: nothing is cut; `obstruction`: the surfaces, which must outlive this, nullptr:
    /// none. Answers for cells of this rank and `width` layers around them. Collective.
    BodyVicinity(const MacGrid<dim>                              &grid,
                 const std::shared_ptr<const FluidTopology<dim>> &before,
                 const std::shared_ptr<const FluidTopology<dim>> &now,
                 const Obstruction<dim>                          *obstruction,
                 const GridIndex<dim>                            &width);

    /// In no cell if there are no bodies.
    Place
    place(const dealii::Point<dim> &point) const
    {
      return {point, grid == nullptr ? GridIndex<dim>{} : cell_or_image_at(point)};
    }

    /// True unless all cells on the segment between two places and `margin` cells around them are
    /// fluid, before, now and in between.
    bool
    is_near(const Place &from, const Place &to) const
    {
      return grid != nullptr && passes_near(from, to);
    }

    /// True unless the cell at a place and those around it are fluid: then all samples of
    /// multilinear interpolation are visible from there. (All around: a face between a whole cell
    /// and a body that ends in its plane has no sample, wherever in the cell the place is.)
    bool
    is_next_to_body(const Place &place) const
    {
      return grid != nullptr &&
             (!box.contains(place.cell) || layers[box.position(place.cell)] <= 1);
    }

    /// True if all cells of the box with two corners in these cells are fluid all over: no surface
    /// can lie between two places in it.
    bool
    is_clear(const GridIndex<dim> &begin, const GridIndex<dim> &end) const;

    /// The facets in the cells that bodies touch.
    const FacetsOfCells<dim> &
    facets_of_cells() const
    {
      return facets;
    }

    /// Does a surface lie between two places?
    bool
    is_hidden(const Place &from, const Place &to) const;

    /// The share of the segment at which a surface is met first [1]; infinity if none is, see
    /// Obstruction::first_hit().
    double
    first_hit(const Place &from, const Place &to) const
    {
      return surfaces == nullptr || is_clear(from.cell, to.cell)
               ? std::numeric_limits<double>::infinity()
               : hit_of_facets(from, to);
    }

    /// Has a surface passed over the place in its last motion?
    bool
    is_swept(const Place &place) const;

    /// Is what was at `before` on the same side of the surfaces as `now`? See
    /// Obstruction::carried().
    bool
    leads_to(const Place &before, const Place &now) const;

    /// Has a surface passed over both places in its last motion, and left what was at `before` on
    /// another side than `now`?
    bool
    parts(const dealii::Point<dim> &before, const dealii::Point<dim> &now) const;

  private:
    void
    mark_freshly_cleared_cells();

    void
    measure_layers();

    bool
    passes_near(const Place &from, const Place &to) const;

    double
    hit_of_facets(const Place &from, const Place &to) const;

    /// The cell at a place; beyond a periodic side the image there, which this rank may know though
    /// it does not know the cell.
    GridIndex<dim>
    cell_or_image_at(const dealii::Point<dim> &place) const;

    const MacGrid<dim>          *grid     = nullptr; ///< nullptr: no bodies
    const Obstruction<dim>      *surfaces = nullptr;
    std::array<const Row *, dim> planes{};
    IndexBox<dim>                box;
    std::vector<std::uint8_t> layers;  ///< 0: a body is in the cell, 1: beside that, ... margin + 1
    CellCounts<dim>           touched; ///< those with a body
    FacetsOfCells<dim>        facets;
  };
} // namespace undine

#endif
