// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_convection_dual_transfer_h
#define undine_fluid_convection_dual_transfer_h

#include <undine/fluid/grid/face_place.h>
#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/grid/mac_grid.h>
#include <undine/fluid/visibility/body_vicinity.h>
#include <undine/fluid/visibility/cell_transfer.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace undine
{
  /// Brings what the halves of dual volumes hold from one topology of the fluid to another one,
  /// while surfaces have moved. A half belongs to a component of a cell and goes where that goes
  /// (CellTransfer), whatever axis its face is normal to, so that components get the same volume
  /// along every axis: to the same face and what its piece there has become, or, where there is
  /// none or it is to leave its place, to all places of the component, in proportion to their
  /// volumes. From a component that has no place along the axis it goes on to those that it is
  /// joined to. Nothing crosses a surface, however thin a body is, and nothing is lost but what has
  /// been covered with all that it was joined to.
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

    /// To what there is on faces normal to `axis`, `halves`, add what there is of components now,
    /// `excess`, in proportion to `weights`, which are sums_around() cells and components `around`.
    /// One ghost layer of both fields must be up to date. Not collective.
    void
    distribute(Halves            &halves,
               const unsigned int axis,
               const Field<dim>  &excess,
               const Halves      &weights,
               const Field<dim>  &around) const;

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

    /// Where a share of a half goes.
    struct Passage
    {
      FacePlace<dim>     from;
      unsigned int       end;   ///< the half below (0) or above (1)
      PressurePlace<dim> to;    ///< component now
      std::optional<int> part;  ///< of its face that it has become, if any; -1: the face is whole
      double             share; ///< [1]
    };

    void
    find_passages();
    void
    find_passages(const unsigned int                       axis,
                  const unsigned int                       end,
                  const typename CellTransfer<dim>::Route &route);
    std::vector<Opening<dim>>
    openings(const DualHalves<dim> &halves,
             const unsigned int     axis,
             const GridIndex<dim>  &face,
             const unsigned int     end,
             const int              component) const;
    bool
    stays(const unsigned int axis, const GridIndex<dim> &face, const unsigned int end) const;
    void
    stay(Halves &result, Field<dim> &excess, const unsigned int axis, const Amounts &amounts) const;
    Field<dim>
    excess_of_covered(const unsigned int axis, const Amounts &amounts) const;
    void
    follow_passages(Halves            &result,
                    Field<dim>        &excess,
                    const unsigned int axis,
                    const Amounts     &amounts) const;
    void
    find_relays();
    void
    relay(Field<dim> &excess, const unsigned int axis) const;

    /// From a component without a place along an axis to one that it is joined to, now.
    struct Relay
    {
      PressurePlace<dim> from, to;
      double             share; ///< [1]
    };

    const BodyVicinity<dim>              &vicinity;
    const CellTransfer<dim>               cells;
    std::array<std::vector<Passage>, dim> passages;     ///< of all halves that do not simply stay
    std::array<std::vector<Relay>, dim>   relays;       ///< to components of this rank
    std::array<bool, dim>                 has_relays{}; ///< on any rank
  };
} // namespace undine

#endif
