// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_convection_dual_transfer_h
#define undine_fluid_convection_dual_transfer_h

#include <undine/fluid/grid/face_place.h>
#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/grid/mac_grid.h>
#include <undine/fluid/visibility/body_vicinity.h>

#include <functional>
#include <memory>
#include <vector>

namespace undine
{
  /// Brings what the halves of dual volumes hold from one topology of the fluid to another one,
  /// while surfaces have moved. Each half goes to the same face, and to the nearest piece of it on
  /// the same side of the surfaces, as long as there is one. What finds none, or is to leave its
  /// place, goes to all places of its component, in proportion to their volumes, or to those beyond
  /// the face. Nothing crosses a surface, however thin a body is, but where one passes over a whole
  /// face and both cells beside it; nothing is lost but what finds no place in the next cell
  /// either.
  template <int dim>
  class DualTransfer
  {
  public:
    /// Of the faces normal to one axis: below and above them.
    using Halves = std::array<Field<dim>, 2>;

    /// `vicinity` knows how surfaces have moved, and must outlive this. Collective.
    DualTransfer(const MacGrid<dim>                              &grid,
                 const std::shared_ptr<const FluidTopology<dim>> &before,
                 const std::shared_ptr<const FluidTopology<dim>> &now,
                 const BodyVicinity<dim>                         &vicinity);

    /// What a half holds.
    struct Amount
    {
      double staying;
      double leaving; ///< what goes to its component, even if its place remains
    };

    /// `amount` of a place before and of its half below (0) or above (1). Collective.
    Halves
    transfer(const unsigned int                                                       axis,
             const std::function<Amount(const FacePlace<dim> &, const unsigned int)> &amount) const;

    /// Sums over the places around each cell and component now. Not collective.
    Field<dim>
    sums_around(const unsigned int axis, const Halves &halves) const;

    /// Whether a face was and is open all over, and so are the cells beside it.
    bool
    is_uncut(const unsigned int axis, const GridIndex<dim> &face) const;

    const MacGrid<dim>   &grid;
    const DualHalves<dim> before; ///< volumes before [m^dim]
    const DualHalves<dim> now;    ///< volumes now [m^dim]

    /// Volumes around each cell and component now, by axis [m^dim].
    std::array<Field<dim>, dim> around;

  private:
    struct Amounts
    {
      Halves staying, leaving;
    };

    void
    stay(Halves &result, const unsigned int axis, const Amounts &amounts) const;
    void
    collect(Field<dim> &excess, const unsigned int axis, const Amounts &amounts) const;
    void
    distribute(Halves &result, const Field<dim> &excess, const unsigned int axis) const;
    FacePlace<dim>
    successor(const unsigned int axis, const FacePlace<dim> &place) const;

    /// A place of a face.
    struct Opening
    {
      int                               part;
      typename BodyVicinity<dim>::Place centre;
      double                            area; ///< [m^(dim-1)]
    };

    std::vector<Opening>
    openings(const SubLattice<dim> *divided,
             const unsigned int     axis,
             const GridIndex<dim>  &face) const;

    struct Destination
    {
      GridIndex<dim> cell;
      int            component; ///< -1: the cell is whole
    };

    Destination
    destination(const unsigned int axis, const FacePlace<dim> &place, const unsigned int end) const;
    int
    component_for(const unsigned int                       axis,
                  const GridIndex<dim>                    &cell,
                  const typename BodyVicinity<dim>::Place &from,
                  const bool                               on_side) const;
    dealii::Point<dim>
    centre_before(const unsigned int    axis,
                  const FacePlace<dim> &place,
                  const unsigned int    end) const;

    const BodyVicinity<dim> &vicinity;
  };
} // namespace undine

#endif
