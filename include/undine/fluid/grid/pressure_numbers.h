// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_pressure_numbers_h
#define undine_fluid_grid_pressure_numbers_h

#include <undine/fluid/grid/field.h>
#include <undine/fluid/grid/mac_grid.h>

#include <deal.II/base/index_set.h>

#include <memory>

namespace undine
{
  /// Where a pressure sits: in a whole cell or in a component of a divided one.
  template <int dim>
  struct PressurePlace
  {
    GridIndex<dim> cell;
    int            component; ///< number in FluidTopology::cells; -1: the cell is whole
  };

  /// The value of a field of cells where a pressure sits.
  template <int dim>
  double
  value_at(const Field<dim> &field, const PressurePlace<dim> &place)
  {
    return place.component < 0 ? field(place.cell) : field.parts()[place.component];
  }

  /// The end 0 (below) or 1 (above) of piece number `piece` of the faces normal to `axis`, unless
  /// it is outside.
  template <int dim>
  PressurePlace<dim>
  end_of_piece(const FluidTopology<dim> &open,
               const unsigned int        axis,
               const int                 piece,
               const unsigned int        end)
  {
    const auto &face      = open.faces[axis].all()[piece].index;
    const int   component = open.pieces[axis][piece].components[end];
    return {end == 0 ? moved<dim>(face, axis, -1) : face, component < 0 ? -1 : component};
  }

  /// Numbers of the pressures for matrices and vectors: those of rank 0 first; within a rank first
  /// the cells that are whole, then the components of divided ones, in the order of
  /// for_each_value(). What lies in bodies has none.
  template <int dim>
  class PressureNumbers
  {
  public:
    using Number = dealii::types::global_dof_index;

    /// Collective.
    PressureNumbers(const MacGrid<dim> &grid, std::shared_ptr<const FluidTopology<dim>> topology);

    /// The number of a pressure of this rank or next to one; images allowed. @{
    Number
    of(const PressurePlace<dim> &place) const
    {
      return open ? static_cast<Number>(value_at(numbers, place)) : lattice->number(place.cell);
    }

    Number
    of_cell(const GridIndex<dim> &whole_cell) const
    {
      return of({whole_cell, -1});
    }

    Number
    of_component(const int component) const
    {
      return of({{}, component});
    }
    /// @}

    /// The topology of the fluid; nullptr: nothing is cut.
    const std::shared_ptr<const FluidTopology<dim>> &
    topology() const
    {
      return open;
    }

    /// The numbers of the pressures that this rank owns.
    const dealii::IndexSet &
    owned() const
    {
      return mine;
    }

  private:
    std::shared_ptr<const Lattice<dim>>       lattice;
    std::shared_ptr<const FluidTopology<dim>> open;
    Field<dim>       numbers; ///< exact as numbers up to 2^53; unused if !open
    dealii::IndexSet mine;
  };


  /// Copy the owned values of a field of cells, in the order of the numbers, to a vector over
  /// owned() or back. Not collective. @{
  template <int dim, class Vector>
  void
  copy_to_vector(Vector &vector, const Field<dim> &field)
  {
    auto next = vector.begin();
    for_each_unplaced_value(field, [&](const double value) { *next++ = value; });
  }

  template <int dim, class Vector>
  void
  copy_from_vector(Field<dim> &field, const Vector &vector)
  {
    auto next = vector.begin();
    for_each_unplaced_value(field, [&](double &value) { value = *next++; });
  }
  /// @}
} // namespace undine

#endif
