// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/convection/dual_halves.h>
#include <undine/fluid/convection/dual_transfer.h>
#include <undine/fluid/grid/field_algebra.h>

#include <algorithm>
#include <limits>
#include <optional>
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
                                  const std::shared_ptr<const FluidTopology<dim>> &topology_now,
                                  const BodyVicinity<dim>                         &vicinity)
    : grid(grid)
    , before(dual_halves(grid, topology_before))
    , now(dual_halves(grid, topology_now))
    , vicinity(vicinity)
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


  /// The places of a face on a topology.
  template <int dim>
  std::vector<typename DualTransfer<dim>::Opening>
  DualTransfer<dim>::openings(const SubLattice<dim> *divided,
                              const unsigned int     axis,
                              const GridIndex<dim>  &face) const
  {
    std::vector<Opening> result;
    for_each_place(divided, face, [&](const FacePlace<dim> &one) {
      if (one.part < 0)
        result.push_back(
          {one.part, vicinity.place(grid.faces(axis)->point(face)), grid.face_area(axis, face)});
      else
        result.push_back({one.part,
                          vicinity.place(divided->all()[one.part].place),
                          divided->all()[one.part].measure});
    });
    return result;
  }


  /// The place on the same face that a place has become; part `none`: there is no such. Places and
  /// successors are one to one, the nearest ones first. The only ones of a face are the same if
  /// they overlap and no surface has passed between: their centroids may lie in a body.
  template <int dim>
  FacePlace<dim>
  DualTransfer<dim>::successor(const unsigned int axis, const FacePlace<dim> &place) const
  {
    auto old_places = openings(before[0][axis].divided(), axis, place.face),
         new_places = openings(now[0][axis].divided(), axis, place.face);
    if (old_places.size() == 1 && new_places.size() == 1 &&
        old_places[0].area + new_places[0].area > grid.face_area(axis, place.face) &&
        !vicinity.parts(old_places[0].centre.point, new_places[0].centre.point))
      return {place.face, new_places[0].part};
    while (true)
      {
        std::size_t i = 0, j = 0;
        double      nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < old_places.size(); ++k)
          for (std::size_t l = 0; l < new_places.size(); ++l)
            if (const double distance =
                  old_places[k].centre.point.distance(new_places[l].centre.point);
                distance < nearest && vicinity.leads_to(old_places[k].centre, new_places[l].centre))
              {
                nearest = distance;
                i       = k;
                j       = l;
              }
        if (nearest == std::numeric_limits<double>::infinity())
          return {place.face, none};
        if (old_places[i].part == place.part)
          return {place.face, new_places[j].part};
        old_places.erase(old_places.begin() + i);
        new_places.erase(new_places.begin() + j);
      }
  }


  /// The nearest one of a cell now, `on_side`: on the same side of the surfaces, that has places
  /// along the axis; -1 if the cell is whole.
  template <int dim>
  int
  DualTransfer<dim>::component_for(const unsigned int                       axis,
                                   const GridIndex<dim>                    &cell,
                                   const typename BodyVicinity<dim>::Place &from,
                                   const bool                               on_side) const
  {
    const auto leads_to = [&](const dealii::Point<dim> &place) {
      return !on_side || vicinity.leads_to(from, vicinity.place(place));
    };
    const auto *divided = around[axis].divided();
    if (is_whole(divided, cell))
      return leads_to(grid.cells()->point(cell)) ? -1 : none;
    int    result  = none;
    double nearest = std::numeric_limits<double>::infinity();
    for_each_part(*divided, cell, [&](const int component) {
      const auto  &place    = divided->all()[component].place;
      const double distance = place.distance(from.point);
      if (around[axis].parts()[component] > 0 && distance < nearest && leads_to(place))
        {
          nearest = distance;
          result  = component;
        }
    });
    return result;
  }


  /// Where a half that does not stay goes: to what its cell has on its side of the surfaces, or the
  /// cell beyond the face. A centroid may lie in a body, which hides it, though no surface has
  /// passed over it: then the side does not count.
  template <int dim>
  typename DualTransfer<dim>::Destination
  DualTransfer<dim>::destination(const unsigned int    axis,
                                 const FacePlace<dim> &place,
                                 const unsigned int    end) const
  {
    const auto from   = vicinity.place(centre_before(axis, place, end));
    const auto home   = moved<dim>(place.face, axis, end == 0 ? -1 : 0);
    const auto beyond = moved<dim>(place.face, axis, end == 0 ? 0 : -1);
    const auto find   = [&](const bool on_side) -> std::optional<Destination> {
      for (const auto &cell : {home, beyond})
        if (cell == home || !grid.at_boundary(axis, place.face))
          if (const int component = component_for(axis, cell, from, on_side); component != none)
            return Destination{cell, component};
      return {};
    };
    auto result = find(true);
    if (!result && !vicinity.is_swept(from))
      result = find(false);
    return result.value_or(Destination{home, none});
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


  /// What stays goes to where its place is now.
  template <int dim>
  void
  DualTransfer<dim>::stay(Halves &result, const unsigned int axis, const Amounts &amounts) const
  {
    for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
      for_each_place(before[0][axis].divided(), face, [&](const FacePlace<dim> &place) {
        const auto to = is_uncut(axis, face) ? place : successor(axis, place);
        for (const unsigned int end : {0, 1})
          if (to.part != none)
            value_at(result[end], to.face, to.part) += value_at(amounts.staying[end], place);
      });
    });
  }


  /// What does not stay is the `excess` of cells and their components.
  template <int dim>
  void
  DualTransfer<dim>::collect(Field<dim>        &excess,
                             const unsigned int axis,
                             const Amounts     &amounts) const
  {
    for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      for (const unsigned int side : {0, 1})
        for (const unsigned int end : {0, 1})
          {
            const auto face = moved<dim>(cell, axis, side);
            for_each_place(before[0][axis].divided(), face, [&](const FacePlace<dim> &place) {
              double leaving = value_at(amounts.leaving[end], place);
              if (!is_uncut(axis, face) && successor(axis, place).part == none)
                leaving += value_at(amounts.staying[end], place);
              if (leaving == 0)
                return;
              const auto to = destination(axis, place, end);
              if (to.cell == cell && to.component != none)
                value_at(excess, cell, to.component) += leaving;
            });
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
    Field<dim> excess(grid.cells(), now[0][axis].topology());
    stay(result, axis, amounts);
    collect(excess, axis, amounts);
    excess.exchange(1);
    distribute(result, excess, axis);
    for (auto &half : result)
      half.exchange(1);
    return result;
  }


  template class DualTransfer<2>;
  template class DualTransfer<3>;
} // namespace undine
