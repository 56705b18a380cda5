// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/convection/moved_dual_volumes.h>
#include <undine/fluid/grid/field_algebra.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace undine
{
  /// Of a dual volume before [m^dim].
  template <int dim>
  struct MovedDualVolumes<dim>::Half
  {
    double volume; ///< V^b
    double start;  ///< V^0
    double inert;  ///< V~, in which the rate of the velocity was found
  };


  namespace
  {
    /// Halves.
    template <int dim>
    double
    of_both(const DualHalves<dim> &halves, const unsigned int axis, const FacePlace<dim> &place)
    {
      return value_at(halves[0][axis], place) + value_at(halves[1][axis], place);
    }
  } // namespace


  template <int dim>
  typename MovedDualVolumes<dim>::Half
  MovedDualVolumes<dim>::half(const unsigned int    axis,
                              const FacePlace<dim> &place,
                              const unsigned int    end) const
  {
    const double volume = value_at(transfer.before[end][axis], place);
    const double rate   = kept.time > 0 ? value_at(kept.halves[end][axis], place) : 0.;
    return {volume, volume + stage.going_on() * rate, volume - kept.time * rate};
  }


  template <int dim>
  MovedDualVolumes<dim>::MovedDualVolumes(const MacGrid<dim>                              &grid,
                                          const std::shared_ptr<const FluidTopology<dim>> &before,
                                          const std::shared_ptr<const FluidTopology<dim>> &now,
                                          const BodyVicinity<dim>                         &vicinity,
                                          const DualVolumeRates<dim>                      &kept,
                                          const Stage                                     &stage)
    : transfer(grid, before, now, vicinity)
    , kept(kept)
    , stage(stage)
  {
    using Amount = typename DualTransfer<dim>::Amount;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const auto at_begin =
          transfer.transfer(axis, [&](const FacePlace<dim> &place, const unsigned int end) {
            return Amount{half(axis, place, end).volume, 0.};
          });
        const auto at_start =
          transfer.transfer(axis, [&](const FacePlace<dim> &place, const unsigned int end) {
            const double volume = half(axis, place, end).start;
            return Amount{std::max(0., volume), std::min(0., volume)};
          });
        for (const unsigned int end : {0, 1})
          {
            begin[end][axis] = at_begin[end];
            start[end][axis] = at_start[end];
          }
      }
  }


  /// Was the volume of a place more than a negligible share of the present one?
  template <int dim>
  bool
  MovedDualVolumes<dim>::had_volume(const unsigned int     axis,
                                    const FacePlace<dim>  &place,
                                    const DualHalves<dim> &volumes) const
  {
    constexpr double negligible = 1e-2;
    return of_both(volumes, axis, place) > negligible * of_both(transfer.now, axis, place);
  }


  /// What places that had no volume have of momentum besides that with `velocity` is given to the
  /// others of their components, in proportion to the volumes of these.
  template <int dim>
  typename MovedDualVolumes<dim>::Halves
  MovedDualVolumes<dim>::given_away(const Field<dim>      &velocity,
                                    const Halves          &momenta,
                                    const DualHalves<dim> &volumes) const
  {
    const unsigned int axis   = velocity.lattice().normal_axis();
    Halves             excess = momenta, weights = momenta, result;
    unsigned int       n = 0;
    for (const unsigned int end : {0, 1})
      {
        result[end] = Field<dim>(velocity.shared_lattice(), velocity.topology());
        for_each(velocity.owned(), [&](const GridIndex<dim> &face) {
          for_each_place(velocity.divided(), face, [&](const FacePlace<dim> &place) {
            const double volume = value_at(volumes[end][axis], place);
            const bool   holds  = had_volume(axis, place, volumes);
            auto        &rest   = value_at(excess[end], face, place.part);
            rest                = holds ? 0. : rest - volume * value_at(velocity, place);
            n += rest != 0;
            value_at(weights[end], face, place.part) = holds ? std::max(0., volume) : 0.;
          });
        });
      }
    if (dealii::Utilities::MPI::max(n, transfer.grid.communicator()) == 0)
      return result;
    for (const unsigned int end : {0, 1})
      {
        excess[end].exchange(1);
        weights[end].exchange(1);
      }
    auto in_cells = transfer.sums_around(axis, excess),
         around   = transfer.sums_around(axis, weights);
    in_cells.exchange(1);
    around.exchange(1);
    transfer.distribute(result, axis, in_cells, weights, around);
    return result;
  }


  /// momenta / volumes on all faces that are or were cut or have just ceased to be, where there has
  /// been a volume.
  template <int dim>
  void
  MovedDualVolumes<dim>::set_quotients(Field<dim>            &moved,
                                       const Halves          &momenta,
                                       const DualHalves<dim> &volumes) const
  {
    const unsigned int axis  = moved.lattice().normal_axis();
    const auto         given = given_away(moved, momenta, volumes);
    for_each(moved.owned(), [&](const GridIndex<dim> &face) {
      for_each_place(moved.divided(), face, [&](const FacePlace<dim> &place) {
        if (!had_volume(axis, place, volumes))
          return;
        const double then = of_both(volumes, axis, place);
        auto        &v    = value_at(moved, face, place.part);
        if (!transfer.is_uncut(axis, face) || then != of_both(transfer.now, axis, place))
          v = (value_at(momenta[0], place) + value_at(momenta[1], place)) / then;
        v += (value_at(given[0], place) + value_at(given[1], place)) / then;
      });
    });
    set_means(moved, transfer.grid);
  }


  template <int dim>
  void
  MovedDualVolumes<dim>::move(Velocity<dim> &moved, const Velocity<dim> &velocity) const
  {
    using Amount = typename DualTransfer<dim>::Amount;
    for (unsigned int axis = 0; axis < dim; ++axis)
      set_quotients(
        moved[axis],
        transfer.transfer(
          axis,
          [&](const FacePlace<dim> &place, const unsigned int end) {
            return Amount{half(axis, place, end).volume * value_at(velocity[axis], place), 0.};
          }),
        begin);
  }


  template <int dim>
  void
  MovedDualVolumes<dim>::move_to_start(Velocity<dim>       &moved,
                                       const Velocity<dim> &velocity,
                                       const Velocity<dim> &acceleration) const
  {
    using Amount   = typename DualTransfer<dim>::Amount;
    const double w = stage.going_on();
    const auto   amount =
      [&](const unsigned int axis, const FacePlace<dim> &place, const unsigned int end) {
        const auto   volumes = half(axis, place, end);
        const double v       = value_at(velocity[axis], place);
        const double gain    = w != 0 ? w * value_at(acceleration[axis], place) : 0.;
        const double start   = std::max(0., volumes.start);
        // A volume that vanishes must not be left with the gain of a larger one.
        const double still = std::min(volumes.inert, start);
        return Amount{start * v + still * gain,
                      std::min(0., volumes.start) * v + (volumes.inert - still) * gain};
      };
    for (unsigned int axis = 0; axis < dim; ++axis)
      set_quotients(moved[axis],
                    transfer.transfer(axis,
                                      [&](const FacePlace<dim> &place, const unsigned int end) {
                                        return amount(axis, place, end);
                                      }),
                    start);
  }


  /// (volumes now - then) / time.
  template <int dim>
  DualHalves<dim>
  MovedDualVolumes<dim>::rates_since(const DualHalves<dim> &then, const double time) const
  {
    auto result = transfer.now;
    for (const unsigned int end : {0, 1})
      {
        add(result[end], -1., then[end]);
        const auto change = result[end];
        add(result[end], 1 / time - 1, change);
        exchange(result[end]);
      }
    return result;
  }


  template <int dim>
  DualHalves<dim>
  MovedDualVolumes<dim>::rates() const
  {
    return rates_since(start, stage.length);
  }


  template <int dim>
  Field<dim>
  MovedDualVolumes<dim>::growth() const
  {
    const auto of_halves = rates();
    Field<dim> result(transfer.grid.cells(), of_halves[0][0].topology());
    for (unsigned int axis = 0; axis < dim; ++axis)
      add(result, 1., transfer.sums_around(axis, {{of_halves[0][axis], of_halves[1][axis]}}));
    for_each(result.owned(), [&](const GridIndex<dim> &cell) {
      for_each_place(result.divided(), cell, [&](const FacePlace<dim> &place) {
        int n = 0;
        for (const auto &volumes : transfer.around)
          n += value_at(volumes, cell, place.part) > 0;
        value_at(result, cell, place.part) /= std::max(1, n);
      });
    });
    return result;
  }


  template <int dim>
  DualVolumeRates<dim>
  MovedDualVolumes<dim>::kept_rates() const
  {
    if (stage.kept == KeptRate::mean)
      return {rates_since(begin, stage.duration()), stage.duration()};
    return {rates(), stage.length};
  }


  template class MovedDualVolumes<2>;
  template class MovedDualVolumes<3>;
} // namespace undine
