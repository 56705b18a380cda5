// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_body_vicinity_h
#define undine_fluid_body_vicinity_h

#include <undine/fluid/field.h>
#include <undine/fluid/mac_grid.h>

#include <array>
#include <cstdint>
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

    /// No bodies.
    BodyVicinity() = default;

    /// `before` and `now`: what bodies leave of the grid, nullptr: everything. Answers for cells of
    /// this rank and `width` layers around them. Collective.
    BodyVicinity(const MacGrid<dim>                          &grid,
                 const std::shared_ptr<const OpenParts<dim>> &before,
                 const std::shared_ptr<const OpenParts<dim>> &now,
                 const GridIndex<dim>                        &width);

    /// True unless all cells on the straight way and `margin` cells around them are fluid, before
    /// and now.
    bool
    is_near(const dealii::Point<dim> &from, const dealii::Point<dim> &to) const;

    /// True if the box with these corners has no part in a cell that is not fluid all over: nothing
    /// can hide one corner from the other.
    bool
    is_clear(const dealii::Point<dim> &from, const dealii::Point<dim> &to) const;

  private:
    void
    find_extent();

    const MacGrid<dim>       *grid = nullptr; ///< nullptr: no bodies
    IndexBox<dim>             box;
    std::vector<std::uint8_t> touched;  ///< cells with a body in them
    std::vector<std::uint8_t> vicinity; ///< and `margin` layers around

    /// Around all of `vicinity` [m]; infinite where it reaches a boundary or along periodic axes.
    std::array<double, dim> lowest, highest;
  };
} // namespace undine

#endif
