// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_convection_moved_dual_volumes_h
#define undine_fluid_convection_moved_dual_volumes_h

#include <undine/base/core/stage.h>
#include <undine/fluid/grid/face_place.h>
#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/grid/mac_grid.h>

#include <memory>
#include <vector>

namespace undine
{
  /// Volumes and momenta of the fluid from where the grid was cut at the begin of a stage to where
  /// it is cut at its end. The volume V of a place on a face changes as surfaces move, and what
  /// convection in flux form conserves is V v: in a stage (T10), which goes on with the rates kept,
  ///
  ///     V^0 = V^b + w V',   (V v)^0 = V^0 v^b + w V~ a                                    (F15)
  ///
  /// with the volume V~ in which the rate a of the velocity was found. Each half of a dual volume
  /// goes to the same face, and to the nearest piece of it, as long as there is one. What has been
  /// covered, or is negative because it will be, goes to the other places of its component, in
  /// proportion to their volumes, or to those beyond the face. So neither volume nor momentum is
  /// lost, whatever opens or closes; only what finds no place in the next cell either is.
  template <int dim>
  class MovedDualVolumes
  {
  public:
    /// `kept`: of the stage before, on the topology `before`. Collective.
    MovedDualVolumes(const MacGrid<dim>                              &grid,
                     const std::shared_ptr<const FluidTopology<dim>> &before,
                     const std::shared_ptr<const FluidTopology<dim>> &now,
                     const DualVolumeRates<dim>                      &kept,
                     const Stage                                     &stage);

    /// Give `moved`, on the present topology, the velocities that conserve the momentum of
    /// `velocity` = v^b: (V^b v^b) / V^b, on all faces that are or were cut and have had a volume.
    /// Collective.
    void
    move(Velocity<dim> &moved, const Velocity<dim> &velocity) const;

    /// The same of the stage's start: v^0 = (V v)^0 / V^0 from v^b and a; a counts only if stages
    /// keep rates. Collective.
    void
    move_to_start(Velocity<dim>       &moved,
                  const Velocity<dim> &velocity,
                  const Velocity<dim> &acceleration) const;

    /// Rates at the end of the stage, (V - V^0) / g [m^dim/s].
    DualHalves<dim>
    rates() const;

    /// Rates of cells and components at the end of the stage [m^dim/s].
    Field<dim>
    growth() const;

    /// The rates that the stage keeps.
    DualVolumeRates<dim>
    kept_rates() const;

  private:
    /// Of an axis, on the topology before: what stays in its half, and what leaves it.
    struct Amounts
    {
      std::array<Field<dim>, 2> staying, leaving;
    };
    using Halves = std::array<Field<dim>, 2>;

    template <class Amount>
    Amounts
    amounts(const unsigned int axis, const Amount &amount) const;
    Halves
    transfer(const unsigned int axis, const Amounts &amounts) const;
    void
    collect(Field<dim>                &pots,
            std::array<Field<dim>, 2> &handed,
            Halves                    &result,
            const unsigned int         axis,
            const Amounts             &amounts) const;
    void
    take_over(Field<dim>                      &pots,
              const std::array<Field<dim>, 2> &handed,
              const unsigned int               axis) const;
    void
    set_quotients(Field<dim> &moved, const Halves &momenta, const Halves &volumes) const;
    DualHalves<dim>
    rates_since(const DualHalves<dim> &then, const double time) const;
    FacePlace<dim>
    successor(const unsigned int axis, const FacePlace<dim> &place) const;
    int
    component_for(const unsigned int        axis,
                  const GridIndex<dim>     &cell,
                  const dealii::Point<dim> &near) const;
    dealii::Point<dim>
    centre_before(const unsigned int    axis,
                  const FacePlace<dim> &place,
                  const unsigned int    end) const;

    const MacGrid<dim>                             &grid;
    const std::shared_ptr<const FluidTopology<dim>> before, now;
    const DualVolumeRates<dim>                     &kept;
    const Stage                                     stage;
    DualHalves<dim>                                 old_volumes, volumes;
    std::array<Field<dim>, dim> open_volumes; ///< of all places around a cell or component, by axis
    DualHalves<dim>             begin, start; ///< V^b and V^0 on the present topology
  };
} // namespace undine

#endif
