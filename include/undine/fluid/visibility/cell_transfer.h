// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_visibility_cell_transfer_h
#define undine_fluid_visibility_cell_transfer_h

#include <undine/fluid/grid/mac_grid.h>
#include <undine/fluid/grid/pressure_numbers.h>
#include <undine/fluid/visibility/openings.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace undine
{
  /// Brings what cells and components hold, such as their volume or the amount of a scalar, from
  /// one topology of the fluid to another one, while surfaces have moved. What is in a component
  /// stays in its cell, in the components on the same side of the surfaces, as long as there are
  /// any. What finds none has been covered: it goes to the components with which its own was joined
  /// before, by the areas of the pieces between them, and from there on. So nothing crosses a
  /// surface, however thin a body is, and nothing is lost but what was joined to nothing that is
  /// left.
  template <int dim>
  class CellTransfer
  {
  public:
    /// `vicinity` knows how surfaces have moved, and must outlive this. Collective.
    CellTransfer(const MacGrid<dim>                              &grid,
                 const std::shared_ptr<const FluidTopology<dim>> &before,
                 const std::shared_ptr<const FluidTopology<dim>> &now,
                 const BodyVicinity<dim>                         &vicinity);

    /// `amounts` on the topology before, in units of which the parts add up. Collective.
    Field<dim>
    transfer(const Field<dim> &amounts) const;

    /// Where a share of what was in a component goes within its cell.
    struct Route
    {
      PressurePlace<dim> from;
      int                to;    ///< component; -1: the cell is whole now
      double             share; ///< [1]
    };

    /// Those of the cells of this rank and of the layer around them, but for cells that are kept.
    const std::vector<Route> &
    routes() const
    {
      return all_routes;
    }

    /// Is a cell open all over, before and now, and has no surface passed over it in between? Of
    /// the same cells.
    bool
    is_kept(const GridIndex<dim> &cell) const
    {
      return kept[known.position(cell)] != 0;
    }

    /// Has any component been covered, on any rank?
    bool
    any_is_covered() const
    {
      return levels.has_lattice();
    }

    /// Has what was in a component of this rank no place left in its cell?
    bool
    is_covered(const PressurePlace<dim> &place) const
    {
      return any_is_covered() && value_at(levels, place) > 0;
    }

  private:
    bool
    remains(const GridIndex<dim> &cell) const;
    std::vector<Opening<dim>>
    openings(const SubLattice<dim> *divided, const GridIndex<dim> &cell) const;
    void
    find_routes(const GridIndex<dim> &cell);
    void
    find_levels();

    const MacGrid<dim>                       &grid;
    std::shared_ptr<const FluidTopology<dim>> before, now;
    const BodyVicinity<dim>                  &vicinity;
    IndexBox<dim>                             known; ///< cells of this rank and a layer more
    std::vector<std::uint8_t>                 kept;  ///< of these
    std::vector<Route>                        all_routes;

    /// Of what has been covered: through how many others it goes to what is left, 0 if it is; and
    /// the area of the pieces towards the next [m^(dim-1)]. Empty if nothing has been covered.
    Field<dim>   levels, ways;
    unsigned int n_levels = 0;
  };
} // namespace undine

#endif
