// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/convection/dual_halves.h>
#include <undine/fluid/convection/moved_dual_volumes.h>
#include <undine/fluid/grid/field_algebra.h>

#include <algorithm>
#include <limits>

namespace undine
{
  namespace
  {
    constexpr int no_component = -2; ///< -1 is a cell that is whole

    /// Of a dual volume before [m^dim].
    struct Half
    {
      double volume; ///< V^b
      double start;  ///< V^0
      double inert;  ///< V~, in which the rate of the velocity was found
    };


    template <int dim>
    bool
    is_whole(const SubLattice<dim> *divided, const GridIndex<dim> &index)
    {
      return !divided || divided->kind(index) == SubLattice<dim>::Kind::whole;
    }


    /// action(FacePlace) for what is open of a face.
    template <int dim, class Action>
    void
    for_each_place(const SubLattice<dim> *divided, const GridIndex<dim> &face, const Action &action)
    {
      if (is_whole(divided, face))
        action(FacePlace<dim>{face, -1});
      else
        for_each_part(*divided, face, [&](const int part) { action(FacePlace<dim>{face, part}); });
    }


    /// Value of a point, or of the part with that number if it is not negative.
    template <int dim>
    double &
    value_at(Field<dim> &field, const GridIndex<dim> &index, const int part)
    {
      return part < 0 ? field(index) : field.parts()[part];
    }


    template <int dim>
    double
    value_at(const Field<dim> &field, const GridIndex<dim> &index, const int part)
    {
      return part < 0 ? field(index) : field.parts()[part];
    }


    /// The component below or above a place; -1: a cell that is whole.
    template <int dim>
    int
    component_at(const FluidTopology<dim> *topology,
                 const unsigned int        axis,
                 const FacePlace<dim>     &place,
                 const unsigned int        end)
    {
      return place.part < 0 ? -1 : std::max(-1, topology->pieces[axis][place.part].components[end]);
    }
  } // namespace


  template <int dim>
  MovedDualVolumes<dim>::MovedDualVolumes(const MacGrid<dim>                              &grid,
                                          const std::shared_ptr<const FluidTopology<dim>> &before,
                                          const std::shared_ptr<const FluidTopology<dim>> &now,
                                          const DualVolumeRates<dim>                      &kept,
                                          const Stage                                     &stage)
    : grid(grid)
    , before(before)
    , now(now)
    , kept(kept)
    , stage(stage)
    , old_volumes(dual_halves(grid, before))
    , volumes(dual_halves(grid, now))
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        auto &sum = open_volumes[axis] = Field<dim>(grid.cells(), now);
        for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
          for (const unsigned int end : {0, 1})
            for_each_place(volumes[0][axis].divided(),
                           moved<dim>(cell, axis, 1 - end),
                           [&](const FacePlace<dim> &place) {
                             const int component = component_at(now.get(), axis, place, end);
                             value_at(sum, cell, component) +=
                               undine::value_at(volumes[end][axis], place);
                           });
        });
        sum.exchange(1);
        const auto at_begin = transfer(axis, amounts(axis, [&](const auto &, const auto &half) {
                                         return std::array<double, 2>{{half.volume, 0.}};
                                       }));
        const auto at_start = transfer(
          axis, amounts(axis, [&](const auto &, const auto &half) {
            return std::array<double, 2>{{std::max(0., half.start), std::min(0., half.start)}};
          }));
        for (const unsigned int end : {0, 1})
          {
            begin[end][axis] = at_begin[end];
            start[end][axis] = at_start[end];
          }
      }
  }


  /// amount(place, Half) is what stays and what leaves.
  template <int dim>
  template <class Amount>
  typename MovedDualVolumes<dim>::Amounts
  MovedDualVolumes<dim>::amounts(const unsigned int axis, const Amount &amount) const
  {
    Amounts result;
    for (const unsigned int end : {0, 1})
      {
        auto       &staying = result.staying[end] = Field<dim>(grid.faces(axis), before);
        auto       &leaving = result.leaving[end] = staying;
        const auto *divided                       = staying.divided();
        for_each(staying.owned(), [&](const GridIndex<dim> &face) {
          for_each_place(divided, face, [&](const FacePlace<dim> &place) {
            const double volume = undine::value_at(old_volumes[end][axis], place);
            const double rate =
              kept.time > 0 ? undine::value_at(kept.halves[end][axis], place) : 0.;
            const auto both = amount(
              place, Half{volume, volume + stage.going_on() * rate, volume - kept.time * rate});
            value_at(staying, place.face, place.part) = both[0];
            value_at(leaving, place.face, place.part) = both[1];
          });
        });
        staying.exchange(1);
        leaving.exchange(1);
      }
    return result;
  }


  /// The place on the same face that a place has become; part no_component: none. Places and
  /// successors are one to one, the nearest ones first.
  template <int dim>
  FacePlace<dim>
  MovedDualVolumes<dim>::successor(const unsigned int axis, const FacePlace<dim> &place) const
  {
    const auto *then = old_volumes[0][axis].divided(), *today = volumes[0][axis].divided();
    const auto  places = [&](const SubLattice<dim> *divided) {
      std::vector<std::pair<FacePlace<dim>, dealii::Point<dim>>> result;
      for_each_place(divided, place.face, [&](const FacePlace<dim> &one) {
        result.emplace_back(
          one, one.part < 0 ? grid.faces(axis)->point(one.face) : divided->all()[one.part].place);
      });
      return result;
    };
    auto old_places = places(then), new_places = places(today);
    while (!old_places.empty() && !new_places.empty())
      {
        std::size_t i = 0, j = 0;
        double      nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < old_places.size(); ++k)
          for (std::size_t l = 0; l < new_places.size(); ++l)
            if (const double distance = old_places[k].second.distance(new_places[l].second);
                distance < nearest)
              {
                nearest = distance;
                i       = k;
                j       = l;
              }
        if (old_places[i].first.part == place.part)
          return new_places[j].first;
        old_places.erase(old_places.begin() + i);
        new_places.erase(new_places.begin() + j);
      }
    return {place.face, no_component};
  }


  /// That of a cell which has places along the axis, the nearest one; -1 if the cell is whole,
  /// no_component if there is none.
  template <int dim>
  int
  MovedDualVolumes<dim>::component_for(const unsigned int        axis,
                                       const GridIndex<dim>     &cell,
                                       const dealii::Point<dim> &near) const
  {
    const auto &sum = open_volumes[axis];
    if (is_whole(sum.divided(), cell))
      return -1;
    int    result  = no_component;
    double nearest = std::numeric_limits<double>::infinity();
    for_each_part(*sum.divided(), cell, [&](const int component) {
      const double distance = sum.divided()->all()[component].place.distance(near);
      if (sum.parts()[component] > 0 && distance < nearest)
        {
          nearest = distance;
          result  = component;
        }
    });
    return result;
  }


  /// Of what was in the cell below or above a place.
  template <int dim>
  dealii::Point<dim>
  MovedDualVolumes<dim>::centre_before(const unsigned int    axis,
                                       const FacePlace<dim> &place,
                                       const unsigned int    end) const
  {
    const int component = component_at(before.get(), axis, place, end);
    if (component >= 0)
      return before->cells.all()[component].place;
    auto      result = grid.faces(axis)->point(place.face);
    const int cell   = place.face[axis] + static_cast<int>(end) - 1;
    result[axis] += (end == 0 ? -0.5 : 0.5) * grid.cell_width(axis, cell);
    return result;
  }


  /// What stays goes to `result`, the rest to `pots` of cells and their components, and what finds
  /// none to `handed`, for the cells below [0] and above [1].
  template <int dim>
  void
  MovedDualVolumes<dim>::collect(Field<dim>                &pots,
                                 std::array<Field<dim>, 2> &handed,
                                 Halves                    &result,
                                 const unsigned int         axis,
                                 const Amounts             &amounts) const
  {
    const auto *then = old_volumes[0][axis].divided(), *today = volumes[0][axis].divided();
    const auto  is_uncut = [&](const GridIndex<dim> &face) {
      return is_whole(then, face) && is_whole(today, face);
    };
    for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      for (const unsigned int end : {0, 1})
        if (const auto face = moved<dim>(cell, axis, 1 - end); !is_uncut(face))
          for_each_place(then, face, [&](const FacePlace<dim> &place) {
            double leaving = undine::value_at(amounts.leaving[end], place);
            if (successor(axis, place).part == no_component)
              leaving += undine::value_at(amounts.staying[end], place);
            if (leaving == 0)
              return;
            const int component = component_for(axis, cell, centre_before(axis, place, end));
            // The cell beyond the face.
            (component != no_component ? value_at(pots, cell, component) : handed[1 - end](cell)) +=
              leaving;
          });
    });
    for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
      for_each_place(then, face, [&](const FacePlace<dim> &place) {
        const auto to = is_uncut(face) ? place : successor(axis, place);
        for (const unsigned int end : {0, 1})
          if (to.part != no_component)
            value_at(result[end], to.face, to.part) +=
              undine::value_at(amounts.staying[end], place);
      });
    });
  }


  /// By the cells to which it was handed.
  template <int dim>
  void
  MovedDualVolumes<dim>::take_over(Field<dim>                      &pots,
                                   const std::array<Field<dim>, 2> &handed,
                                   const unsigned int               axis) const
  {
    for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      for (const unsigned int to : {0, 1})
        {
          const auto from = moved<dim>(cell, axis, to == 0 ? 1 : -1);
          if (!handed[to].stored().contains(from) || handed[to](from) == 0)
            continue;
          const int component = component_for(axis, cell, grid.cells()->point(from));
          if (component != no_component)
            value_at(pots, cell, component) += handed[to](from);
        }
    });
  }


  /// To the halves of the present dual volumes.
  template <int dim>
  typename MovedDualVolumes<dim>::Halves
  MovedDualVolumes<dim>::transfer(const unsigned int axis, const Amounts &amounts) const
  {
    Halves result;
    for (auto &half : result)
      half = Field<dim>(grid.faces(axis), now);
    Field<dim>                pots(grid.cells(), now);
    std::array<Field<dim>, 2> handed{{Field<dim>(grid.cells()), Field<dim>(grid.cells())}};
    collect(pots, handed, result, axis, amounts);
    for (auto &field : handed)
      field.exchange(1);
    take_over(pots, handed, axis);
    pots.exchange(1);
    for (const unsigned int end : {0, 1})
      {
        for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
          const auto cell = moved<dim>(face, axis, static_cast<int>(end) - 1);
          if (!pots.stored().contains(cell))
            return;
          for_each_place(result[end].divided(), face, [&](const FacePlace<dim> &place) {
            const int    component = component_at(now.get(), axis, place, end);
            const double pot       = value_at(pots, cell, component);
            if (pot != 0)
              value_at(result[end], face, place.part) +=
                pot * undine::value_at(volumes[end][axis], place) /
                undine::value_at(open_volumes[axis], FacePlace<dim>{cell, component});
          });
        });
        result[end].exchange(1);
      }
    return result;
  }


  /// momenta / volumes on all faces that are or were cut, where there has been a volume.
  template <int dim>
  void
  MovedDualVolumes<dim>::set_quotients(Field<dim>   &moved,
                                       const Halves &momenta,
                                       const Halves &halves) const
  {
    constexpr double   negligible = 1e-6; // of the present volume
    const unsigned int axis       = moved.lattice().normal_axis();
    const auto        *then       = old_volumes[0][axis].divided();
    const auto         sum        = [](const Halves &both, const FacePlace<dim> &place) {
      return undine::value_at(both[0], place) + undine::value_at(both[1], place);
    };
    const Halves present{{volumes[0][axis], volumes[1][axis]}};
    for_each(moved.owned(), [&](const GridIndex<dim> &face) {
      if (is_whole(then, face) && is_whole(moved.divided(), face))
        return;
      for_each_place(moved.divided(), face, [&](const FacePlace<dim> &place) {
        if (const double volume = sum(halves, place); volume > negligible * sum(present, place))
          value_at(moved, face, place.part) = sum(momenta, place) / volume;
      });
    });
    set_means(moved, grid);
  }


  template <int dim>
  void
  MovedDualVolumes<dim>::move(Velocity<dim> &moved, const Velocity<dim> &velocity) const
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const auto momenta =
          transfer(axis, amounts(axis, [&](const FacePlace<dim> &place, const auto &half) {
                     return std::array<double, 2>{
                       {half.volume * undine::value_at(velocity[axis], place), 0.}};
                   }));
        set_quotients(moved[axis], momenta, {{begin[0][axis], begin[1][axis]}});
      }
  }


  template <int dim>
  void
  MovedDualVolumes<dim>::move_to_start(Velocity<dim>       &moved,
                                       const Velocity<dim> &velocity,
                                       const Velocity<dim> &acceleration) const
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const auto momenta =
          transfer(axis, amounts(axis, [&](const FacePlace<dim> &place, const auto &half) {
                     const double v = undine::value_at(velocity[axis], place);
                     const double gain =
                       stage.going_on() != 0
                         ? stage.going_on() * undine::value_at(acceleration[axis], place)
                         : 0.;
                     // A volume that vanishes must not be left with the gain of a larger one.
                     const double still = std::min(half.inert, std::max(0., half.start));
                     return std::array<double, 2>{
                       {std::max(0., half.start) * v + still * gain,
                        std::min(0., half.start) * v + (half.inert - still) * gain}};
                   }));
        set_quotients(moved[axis], momenta, {{start[0][axis], start[1][axis]}});
      }
  }


  /// (volumes now - then) / time.
  template <int dim>
  DualHalves<dim>
  MovedDualVolumes<dim>::rates_since(const DualHalves<dim> &then, const double time) const
  {
    auto result = volumes;
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


  /// The mean over the axes along which there are places.
  template <int dim>
  Field<dim>
  MovedDualVolumes<dim>::growth() const
  {
    const auto of_halves = rates();
    Field<dim> result(grid.cells(), now);
    for (unsigned int axis = 0; axis < dim; ++axis)
      for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
        for (const unsigned int end : {0, 1})
          for_each_place(volumes[0][axis].divided(),
                         moved<dim>(cell, axis, 1 - end),
                         [&](const FacePlace<dim> &place) {
                           value_at(result, cell, component_at(now.get(), axis, place, end)) +=
                             undine::value_at(of_halves[end][axis], place);
                         });
      });
    const auto divide = [&](const GridIndex<dim> &cell, const int part) {
      int n = 0;
      for (unsigned int axis = 0; axis < dim; ++axis)
        n += value_at(open_volumes[axis], cell, part) > 0;
      value_at(result, cell, part) /= std::max(1, n);
    };
    for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      for_each_place(
        result.divided(), cell, [&](const FacePlace<dim> &place) { divide(cell, place.part); });
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
