// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_cell_links_h
#define undine_fluid_grid_cell_links_h

#include <undine/fluid/grid/face_place.h>
#include <undine/fluid/grid/mac_grid.h>
#include <undine/fluid/grid/pressure_numbers.h>

namespace undine
{
  /// An open face, or a piece of one, between two cells or components, seen from the first.
  template <int dim>
  struct CellLink
  {
    PressurePlace<dim> from; ///< of this rank
    PressurePlace<dim> to;
    unsigned int       axis; ///< that the face is normal to
    FacePlace<dim>     face;
    int                sign; ///< 1: `to` is above, -1: below

    /// [m^(dim-1)]
    double
    area(const MacGrid<dim> &grid, const FluidTopology<dim> *topology) const
    {
      return face.part < 0 ? grid.face_area(axis, face.face)
                           : topology->faces[axis].all()[face.part].measure;
    }
  };


  /// action(CellLink) for what joins the cells and components of this rank to others; what joins
  /// two of them comes twice, once from either side. `topology`: of the fluid; nullptr: nothing is
  /// cut.
  template <int dim, class Action>
  void
  for_each_cell_link(const MacGrid<dim> &grid, const FluidTopology<dim> *topology, Action &&action)
  {
    for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      if (topology && topology->cells.kind(cell) != SubLattice<dim>::Kind::whole)
        return;
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (const int end : {0, 1})
          {
            const auto face = moved<dim>(cell, axis, end);
            if (grid.at_boundary(axis, face) ||
                !is_whole(topology ? &topology->faces[axis] : nullptr, face))
              continue;
            const int sign = 2 * end - 1;
            action(CellLink<dim>{
              {cell, -1}, {moved<dim>(cell, axis, sign), -1}, axis, {face, -1}, sign});
          }
    });
    if (!topology)
      return;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (int k = 0; k < static_cast<int>(topology->pieces[axis].size()); ++k)
        {
          const auto &ends = topology->pieces[axis][k].components;
          if (ends[0] == FluidTopology<dim>::outside || ends[1] == FluidTopology<dim>::outside)
            continue;
          for (const unsigned int end : {0, 1})
            {
              // Across periodic sides a rank may know a piece twice, but owns each end once.
              const auto place = end_of_piece(*topology, axis, k, end);
              if (grid.cells()->owned().contains(place.cell))
                action(CellLink<dim>{place,
                                     end_of_piece(*topology, axis, k, 1 - end),
                                     axis,
                                     {topology->faces[axis].all()[k].index, k},
                                     end == 0 ? 1 : -1});
            }
        }
  }


  /// action(PressurePlace) for the open cells and the components of this rank, in the order of
  /// for_each_value(); `field`: any of cells on the topology.
  template <int dim, class Action>
  void
  for_each_cell_place(const Field<dim> &field, Action &&action)
  {
    for_each(field.owned(), [&](const GridIndex<dim> &cell) {
      if (is_whole(field.divided(), cell))
        action(PressurePlace<dim>{cell, -1});
    });
    for_each_owned_part(field.divided(), [&](const unsigned int k, const auto &part) {
      action(PressurePlace<dim>{part.index, static_cast<int>(k)});
    });
  }


  /// The value of a field of cells there, to be changed.
  template <int dim>
  double &
  value_at(Field<dim> &field, const PressurePlace<dim> &place)
  {
    return value_at(field, place.cell, place.component);
  }
} // namespace undine

#endif
