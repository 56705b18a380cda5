// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/convection/dual_halves.h>
#include <undine/fluid/convection/dual_transfer.h>
#include <undine/fluid/grid/cell_links.h>
#include <undine/fluid/grid/field_algebra.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <vector>

namespace undine
{
  namespace
  {
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
                                  const std::shared_ptr<const FluidTopology<dim>> &topology_now,
                                  const BodyVicinity<dim>                         &vicinity)
    : grid(grid)
    , before(dual_halves(grid, topology_before))
    , now(dual_halves(grid, topology_now))
    , vicinity(vicinity)
    , cells(grid, topology_before, topology_now, vicinity)
  {
    find_passages();
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        around[axis] = sums_around(axis, {{now[0][axis], now[1][axis]}});
        around[axis].exchange(1);
      }
    find_relays();
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


  /// The places of a face that belong to a component below it (end 0) or above.
  template <int dim>
  std::vector<Opening<dim>>
  DualTransfer<dim>::openings(const DualHalves<dim> &halves,
                              const unsigned int     axis,
                              const GridIndex<dim>  &face,
                              const unsigned int     end,
                              const int              component) const
  {
    const auto               &half    = halves[end][axis];
    const auto               *divided = half.divided();
    std::vector<Opening<dim>> result;
    for_each_place(divided, face, [&](const FacePlace<dim> &one) {
      if (component_at(half, one, end) != component)
        return;
      if (one.part < 0)
        result.push_back(
          {-1, vicinity.place(grid.faces(axis)->point(face)), grid.face_area(axis, face)});
      else
        result.push_back({one.part,
                          vicinity.place(divided->all()[one.part].place),
                          divided->all()[one.part].measure});
    });
    return result;
  }


  template <int dim>
  void
  DualTransfer<dim>::find_passages()
  {
    for (const auto &route : cells.routes())
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (const unsigned int end : {0, 1})
          find_passages(axis, end, route);
    // Bodies may touch, or have touched, the faces of cells that are kept from the other side.
    for_each(known_points(*grid.cells()), [&](const GridIndex<dim> &cell) {
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (const unsigned int end : {0, 1})
          if (!is_uncut(axis, moved<dim>(cell, axis, 1 - end)) && cells.is_kept(cell))
            find_passages(axis, end, {{cell, -1}, -1, 1.});
    });
  }


  /// The half below (end 0) or above faces normal to `axis`, if this rank owns the face or the
  /// cell.
  template <int dim>
  void
  DualTransfer<dim>::find_passages(const unsigned int                       axis,
                                   const unsigned int                       end,
                                   const typename CellTransfer<dim>::Route &route)
  {
    const auto &cell = route.from.cell;
    const auto  face = moved<dim>(cell, axis, 1 - static_cast<int>(end));
    if (!grid.cells()->owned().contains(cell) && !grid.faces(axis)->owned().contains(face))
      return;
    const auto old_ones = openings(before, axis, face, end, route.from.component),
               new_ones = openings(now, axis, face, end, route.to);
    std::vector<bool> is_left(old_ones.size(), false);
    const auto add = [&](const std::size_t k, const std::optional<int> &part, const double share) {
      passages[axis].push_back(
        {{face, old_ones[k].part}, end, {cell, route.to}, part, share * route.share});
    };
    for (const auto &one : successions(old_ones, new_ones, grid.face_area(axis, face), vicinity))
      {
        is_left[one.before] = true;
        add(one.before, new_ones[one.now].part, one.share);
      }
    for (std::size_t k = 0; k < old_ones.size(); ++k)
      if (!is_left[k])
        add(k, {}, 1.);
  }


  /// Does a half go from a whole face to the same one, and nowhere else?
  template <int dim>
  bool
  DualTransfer<dim>::stays(const unsigned int    axis,
                           const GridIndex<dim> &face,
                           const unsigned int    end) const
  {
    return is_uncut(axis, face) && cells.is_kept(moved<dim>(face, axis, static_cast<int>(end) - 1));
  }


  template <int dim>
  void
  DualTransfer<dim>::stay(Halves            &result,
                          Field<dim>        &excess,
                          const unsigned int axis,
                          const Amounts     &amounts) const
  {
    const auto &my_faces = grid.faces(axis)->owned();
    const auto &my_cells = grid.cells()->owned();
    for_each(known_points(*grid.cells()), [&](const GridIndex<dim> &cell) {
      for (const unsigned int end : {0, 1})
        {
          const auto face = moved<dim>(cell, axis, 1 - static_cast<int>(end));
          if (!stays(axis, face, end))
            continue;
          if (my_faces.contains(face))
            result[end](face) = amounts.staying[end](face);
          if (my_cells.contains(cell))
            excess(cell) += amounts.leaving[end](face);
        }
    });
  }


  /// What is in components that have been covered, taken to those that it was joined to.
  template <int dim>
  Field<dim>
  DualTransfer<dim>::excess_of_covered(const unsigned int axis, const Amounts &amounts) const
  {
    if (!cells.any_is_covered())
      return Field<dim>(grid.cells(), now[0][axis].topology());
    Field<dim> result(grid.cells(), before[0][axis].topology());
    for_each_cell_place(result, [&](const PressurePlace<dim> &place) {
      if (!cells.is_covered(place))
        return;
      for (const unsigned int end : {0, 1})
        for (const auto &one : openings(before,
                                        axis,
                                        moved<dim>(place.cell, axis, 1 - static_cast<int>(end)),
                                        end,
                                        place.component))
          {
            const FacePlace<dim> from{moved<dim>(place.cell, axis, 1 - static_cast<int>(end)),
                                      one.part};
            value_at(result, place) +=
              value_at(amounts.staying[end], from) + value_at(amounts.leaving[end], from);
          }
    });
    return cells.transfer(result);
  }


  template <int dim>
  void
  DualTransfer<dim>::follow_passages(Halves            &result,
                                     Field<dim>        &excess,
                                     const unsigned int axis,
                                     const Amounts     &amounts) const
  {
    const auto &my_faces = grid.faces(axis)->owned();
    const auto &my_cells = grid.cells()->owned();
    for (const auto &one : passages[axis])
      {
        const double staying = one.share * value_at(amounts.staying[one.end], one.from);
        const double leaving = one.share * value_at(amounts.leaving[one.end], one.from);
        if (one.part && my_faces.contains(one.from.face))
          value_at(result[one.end], one.from.face, *one.part) += staying;
        if (my_cells.contains(one.to.cell))
          value_at(excess, one.to) += one.part ? leaving : leaving + staying;
      }
  }


  /// In proportion to the areas between them.
  template <int dim>
  void
  DualTransfer<dim>::find_relays()
  {
    const auto &open = now[0][0].topology();
    for (unsigned int axis = 0; open && axis < dim; ++axis)
      {
        Field<dim> ways(grid.cells(), open); // [m^(dim-1)]
        for (unsigned int d = 0; d < dim; ++d)
          for (int k = 0; k < static_cast<int>(open->pieces[d].size()); ++k)
            for (const unsigned int end : {0, 1})
              if (open->pieces[d][k].components[end] >= 0 &&
                  open->pieces[d][k].components[1 - end] != FluidTopology<dim>::outside)
                {
                  const auto from   = end_of_piece(*open, d, k, end),
                             to     = end_of_piece(*open, d, k, 1 - end);
                  const double area = open->faces[d].all()[k].measure;
                  if (!(area > 0) || value_at(around[axis], from) > 0 ||
                      !(value_at(around[axis], to) > 0))
                    continue;
                  if (grid.cells()->owned().contains(from.cell))
                    value_at(ways, from) += area;
                  if (grid.cells()->owned().contains(to.cell))
                    relays[axis].push_back({from, to, area});
                }
        ways.exchange(1);
        for (auto &one : relays[axis])
          one.share /= value_at(ways, one.from);
        has_relays[axis] =
          dealii::Utilities::MPI::max<unsigned int>(!relays[axis].empty(), grid.communicator()) > 0;
      }
  }


  template <int dim>
  void
  DualTransfer<dim>::relay(Field<dim> &excess, const unsigned int axis) const
  {
    if (!has_relays[axis])
      return;
    for (const auto &one : relays[axis])
      value_at(excess, one.to) += one.share * value_at(excess, one.from);
    excess.exchange(1);
  }


  template <int dim>
  void
  DualTransfer<dim>::distribute(Halves            &halves,
                                const unsigned int axis,
                                const Field<dim>  &excess,
                                const Halves      &weights,
                                const Field<dim>  &around) const
  {
    for (const unsigned int end : {0, 1})
      for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
        const auto cell = moved<dim>(face, axis, static_cast<int>(end) - 1);
        if (!excess.stored().contains(cell))
          return;
        for_each_place(halves[end].divided(), face, [&](const FacePlace<dim> &place) {
          const int    component = component_at(halves[end], place, end);
          const double surplus   = value_at(excess, cell, component);
          const double weight    = value_at(weights[end], place);
          if (surplus != 0 && weight != 0)
            value_at(halves[end], face, place.part) +=
              surplus * weight / value_at(around, cell, component);
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
    Halves  result;
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
        result[end] = Field<dim>(grid.faces(axis), now[end][axis].topology());
      }
    auto excess = excess_of_covered(axis, amounts);
    stay(result, excess, axis, amounts);
    follow_passages(result, excess, axis, amounts);
    excess.exchange(1);
    relay(excess, axis);
    distribute(result, axis, excess, {{now[0][axis], now[1][axis]}}, around[axis]);
    for (auto &half : result)
      half.exchange(1);
    return result;
  }


  template class DualTransfer<2>;
  template class DualTransfer<3>;
} // namespace undine
