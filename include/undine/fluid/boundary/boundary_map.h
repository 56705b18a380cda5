// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_boundary_boundary_map_h
#define undine_fluid_boundary_boundary_map_h

#include <undine/fluid/boundary/boundary.h>
#include <undine/fluid/grid/mac_grid.h>

#include <cstdint>
#include <vector>

namespace undine
{
  /// Which boundary each face on the domain's sides belongs to. Faces that no boundary of the scene
  /// claims are slip walls by the name of "other sides". Known for all faces on every rank.
  template <int dim>
  class BoundaryMap
  {
  public:
    /// Throws InputError if a boundary is left without any face.
    BoundaryMap(const Options                    &boundary_options,
                const std::vector<Boundary<dim>> &boundaries,
                const MacGrid<dim>               &grid);

    const MacGrid<dim> &
    grid() const
    {
      return *mac_grid;
    }

    /// All boundaries that have faces, periodic ones included.
    const std::vector<Boundary<dim>> &
    all() const;

    /// Position in all() of the boundary of the face of `side` that touches `cell`; the component
    /// of `cell` along the side's axis is not used, the others may be images.
    unsigned int
    number(const Side side, const GridIndex<dim> &cell) const;

    /// The boundary of that face.
    const Boundary<dim> &
    at(const Side side, const GridIndex<dim> &cell) const
    {
      return boundaries[number(side, cell)];
    }

    /// The boundary at a place on a side.
    const Boundary<dim> &
    at(const Side side, const dealii::Point<dim> &place) const;

    /// True if the pressure is given somewhere; else it is known up to a constant.
    bool
    has_opening() const;

    /// Is there an opening or an inflow?
    bool
    lets_fluid_pass() const;

    /// Name of a wall whose friction takes effect only with viscosity, or "" if there is none.
    std::string
    wall_that_needs_viscosity() const;

  private:
    const MacGrid<dim>                    *mac_grid;
    std::vector<Boundary<dim>>             boundaries;
    std::vector<std::vector<std::uint8_t>> numbers; ///< by side and face; one entry: for all
  };
} // namespace undine

#endif
