// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_convection_moved_dual_volumes_h
#define undine_fluid_convection_moved_dual_volumes_h

#include <undine/base/core/stage.h>
#include <undine/fluid/convection/dual_transfer.h>

#include <memory>

namespace undine
{
  /// Dual volumes V as surfaces move, and velocities that conserve what convection in flux form
  /// conserves, V v: in a stage (T10), which goes on with the rates kept,
  ///
  ///     V^0 = V^b + w V',   (V v)^0 = V^0 v^b + w V~ a                                    (F15)
  ///
  /// with the volume V~ in which the rate a of the velocity was found. Where V^0 is negative, the
  /// place is about to be covered, and that goes to the other places of its component.
  template <int dim>
  class MovedDualVolumes
  {
  public:
    /// `vicinity` knows how surfaces have moved; `kept`: of the stage before, on the topology
    /// `before`. Both must outlive this. Collective.
    MovedDualVolumes(const MacGrid<dim>                              &grid,
                     const std::shared_ptr<const FluidTopology<dim>> &before,
                     const std::shared_ptr<const FluidTopology<dim>> &now,
                     const BodyVicinity<dim>                         &vicinity,
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

    /// Rates at the end of the stage, (V - V^0) / g [m^dim/s]. Collective.
    DualHalves<dim>
    rates() const;

    /// The same of cells and components [m^dim/s]: the mean of the sums along those axes along
    /// which they have places. Collective.
    Field<dim>
    growth() const;

    /// The rates that the stage keeps. Collective.
    DualVolumeRates<dim>
    kept_rates() const;

  private:
    using Halves = typename DualTransfer<dim>::Halves;
    struct Half;

    Half
    half(const unsigned int axis, const FacePlace<dim> &place, const unsigned int end) const;
    DualHalves<dim>
    rates_since(const DualHalves<dim> &then, const double time) const;
    bool
    had_volume(const unsigned int     axis,
               const FacePlace<dim>  &place,
               const DualHalves<dim> &volumes) const;
    void
    set_quotients(Field<dim> &moved, const Halves &momenta, const DualHalves<dim> &volumes) const;
    Halves
    given_away(const Field<dim>      &velocity,
               const Halves          &momenta,
               const DualHalves<dim> &volumes) const;

    const DualTransfer<dim>     transfer;
    const DualVolumeRates<dim> &kept;
    const Stage                 stage;
    DualHalves<dim>             begin, start; ///< V^b and V^0 on the present topology
  };
} // namespace undine

#endif
