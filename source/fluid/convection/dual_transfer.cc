// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/convection/dual_halves.h>
#include <undine/fluid/convection/dual_transfer.h>
#include <undine/fluid/grid/field_algebra.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace undine
{
  namespace
  {
    constexpr int none = -2; ///< no place or component; -1 is a face or a cell that is whole


    /// The component below or above a place; -1: a cell that is whole.
    template <int dim>
    int
    component_at(const Field<dim> &field, const FacePlace<dim> &place, const unsigned int end)
    {
      const unsigned int axis = field.lattice().normal_axis();
      return place.part < 0
               ? -1
               : std::max(-1, field.topology()->pieces[axis][place.part].components[end]);
    }
  } // namespace


  template <int dim>
  DualTransfer<dim>::DualTransfer(const MacGrid<dim>                              &grid,
                                  const std::shared_ptr<const FluidTopology<dim>> &topology_before,
                                  const std::shared_ptr<const FluidTopology<dim>> &topology_now)
    : grid(grid)
    , before(dual_halves(grid, topology_before))
    , now(dual_halves(grid, topology_now))
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        around[axis] = sums_around(axis, {{now[0][axis], now[1][axis]}});
        around[axis].exchange(1);
      }
  }


  template <int dim>
  bool
  DualTransfer<dim>::is_uncut(const unsigned int axis, const GridIndex<dim> &face) const
  {
    return is_whole(before[0][axis].divided(), face) && is_whole(now[0][axis].divided(), face);
  }


  template <int dim>
  Field<dim>
  DualTransfer<dim>::sums_around(const unsigned int axis, const Halves &halves) const
  {
    Field<dim> result(grid.cells(), now[0][axis].topology());
    for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      for (const unsigned int end : {0, 1})
        for_each_place(
          halves[end].divided(), moved<dim>(cell, axis, 1 - end), [&](const FacePlace<dim> &place) {
            value_at(result, cell, component_at(halves[end], place, end)) +=
              value_at(halves[end], place);
          });
    });
    return result;
  }


  /// The place on the same face that a place has become; part `none`: there is no such. Places and
  /// successors are one to one, the nearest ones first.
  template <int dim>
  FacePlace<dim>
  DualTransfer<dim>::successor(const unsigned int axis, const FacePlace<dim> &place) const
  {
    const auto places = [&](const SubLattice<dim> *divided) {
      std::vector<std::pair<FacePlace<dim>, dealii::Point<dim>>> result;
      for_each_place(divided, place.face, [&](const FacePlace<dim> &one) {
        result.emplace_back(
          one, one.part < 0 ? grid.faces(axis)->point(one.face) : divided->all()[one.part].place);
      });
      return result;
    };
    auto old_places = places(before[0][axis].divided()),
         new_places = places(now[0][axis].divided());
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
    return {place.face, none};
  }


  /// The nearest one of a cell now that has places along the axis; -1 if the cell is whole.
  template <int dim>
  int
  DualTransfer<dim>::component_for(const unsigned int        axis,
                                   const GridIndex<dim>     &cell,
                                   const dealii::Point<dim> &near) const
  {
    const auto *divided = around[axis].divided();
    if (is_whole(divided, cell))
      return -1;
    int    result  = none;
    double nearest = std::numeric_limits<double>::infinity();
    for_each_part(*divided, cell, [&](const int component) {
      const double distance = divided->all()[component].place.distance(near);
      if (around[axis].parts()[component] > 0 && distance < nearest)
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
  DualTransfer<dim>::centre_before(const unsigned int    axis,
                                   const FacePlace<dim> &place,
                                   const unsigned int    end) const
  {
    const int component = component_at(before[end][axis], place, end);
    if (component >= 0)
      return before[end][axis].topology()->cells.all()[component].place;
    auto      result = grid.faces(axis)->point(place.face);
    const int cell   = place.face[axis] + static_cast<int>(end) - 1;
    result[axis] += (end == 0 ? -0.5 : 0.5) * grid.cell_width(axis, cell);
    return result;
  }


  /// What stays goes to `result`, the rest is the `excess` of cells and their components, and what
  /// finds none is `passed_on` to the cells below and above.
  template <int dim>
  void
  DualTransfer<dim>::collect(Field<dim>        &excess,
                             Halves            &passed_on,
                             Halves            &result,
                             const unsigned int axis,
                             const Amounts     &amounts) const
  {
    const auto *then = before[0][axis].divided();
    for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      for (const unsigned int end : {0, 1})
        {
          const auto face = moved<dim>(cell, axis, 1 - end);
          for_each_place(then, face, [&](const FacePlace<dim> &place) {
            double leaving = value_at(amounts.leaving[end], place);
            if (!is_uncut(axis, face) && successor(axis, place).part == none)
              leaving += value_at(amounts.staying[end], place);
            if (leaving == 0)
              return;
            const int component = component_for(axis, cell, centre_before(axis, place, end));
            // The cell beyond the face.
            (component != none ? value_at(excess, cell, component) : passed_on[1 - end](cell)) +=
              leaving;
          });
        }
    });
    for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
      for_each_place(then, face, [&](const FacePlace<dim> &place) {
        const auto to = is_uncut(axis, face) ? place : successor(axis, place);
        for (const unsigned int end : {0, 1})
          if (to.part != none)
            value_at(result[end], to.face, to.part) += value_at(amounts.staying[end], place);
      });
    });
  }


  /// By the cells to which it was passed on.
  template <int dim>
  void
  DualTransfer<dim>::take_over(Field<dim>        &excess,
                               const Halves      &passed_on,
                               const unsigned int axis) const
  {
    for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      for (const unsigned int to : {0, 1})
        {
          const auto from = moved<dim>(cell, axis, to == 0 ? 1 : -1);
          if (!passed_on[to].stored().contains(from) || passed_on[to](from) == 0)
            continue;
          const int component = component_for(axis, cell, grid.cells()->point(from));
          if (component != none)
            value_at(excess, cell, component) += passed_on[to](from);
        }
    });
  }


  /// In proportion to volumes.
  template <int dim>
  void
  DualTransfer<dim>::distribute(Halves            &result,
                                const Field<dim>  &excess,
                                const unsigned int axis) const
  {
    for (const unsigned int end : {0, 1})
      for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
        const auto cell = moved<dim>(face, axis, static_cast<int>(end) - 1);
        if (!excess.stored().contains(cell))
          return;
        for_each_place(result[end].divided(), face, [&](const FacePlace<dim> &place) {
          const int    component = component_at(result[end], place, end);
          const double surplus   = value_at(excess, cell, component);
          if (surplus != 0)
            value_at(result[end], face, place.part) +=
              surplus * value_at(now[end][axis], place) / value_at(around[axis], cell, component);
        });
      });
  }


  template <int dim>
  typename DualTransfer<dim>::Halves
  DualTransfer<dim>::transfer(
    const unsigned int                                                       axis,
    const std::function<Amount(const FacePlace<dim> &, const unsigned int)> &amount) const
  {
    Amounts amounts;
    Halves  result, passed_on;
    for (const unsigned int end : {0, 1})
      {
        auto &staying = amounts.staying[end] =
          Field<dim>(grid.faces(axis), before[end][axis].topology());
        auto &leaving = amounts.leaving[end] = staying;
        for_each(staying.owned(), [&](const GridIndex<dim> &face) {
          for_each_place(staying.divided(), face, [&](const FacePlace<dim> &place) {
            const auto both                           = amount(place, end);
            value_at(staying, place.face, place.part) = both.staying;
            value_at(leaving, place.face, place.part) = both.leaving;
          });
        });
        staying.exchange(1);
        leaving.exchange(1);
        result[end]    = Field<dim>(grid.faces(axis), now[end][axis].topology());
        passed_on[end] = Field<dim>(grid.cells());
      }
    Field<dim> excess(grid.cells(), now[0][axis].topology());
    collect(excess, passed_on, result, axis, amounts);
    for (auto &field : passed_on)
      field.exchange(1);
    take_over(excess, passed_on, axis);
    excess.exchange(1);
    distribute(result, excess, axis);
    for (auto &half : result)
      half.exchange(1);
    return result;
  }


  template class DualTransfer<2>;
  template class DualTransfer<3>;
} // namespace undine
