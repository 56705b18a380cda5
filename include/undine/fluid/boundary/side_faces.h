// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_boundary_side_faces_h
#define undine_fluid_boundary_side_faces_h

#include <undine/fluid/boundary/boundary.h>
#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/grid/mac_grid.h>
#include <undine/fluid/grid/pressure_numbers.h>

#include <algorithm>

namespace undine
{
  /// A face of this rank on a side of the domain.
  template <int dim>
  struct SideFace
  {
    Side           side;
    GridIndex<dim> face;
    GridIndex<dim> cell;  ///< the one inside
    int            piece; ///< of a divided face: which one; else -1
  };

  /// action(SideFace, place) for all of them. `topology`: of the fluid; nullptr: nothing is cut.
  template <int dim, class Action>
  void
  for_each_side_face(const MacGrid<dim>       &grid,
                     const FluidTopology<dim> *topology,
                     const Action             &action)
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (unsigned int end = 0; end < 2 && !grid.periodic(axis); ++end)
        {
          const int   plane   = end == 0 ? 0 : grid.cells_along()[axis];
          const auto &lattice = *grid.faces(axis);
          auto        layer   = lattice.owned();
          layer.lower[axis]   = std::max(layer.lower[axis], plane);
          layer.upper[axis]   = std::min(layer.upper[axis], plane + 1);
          for_each(layer, [&](const GridIndex<dim> &face) {
            const auto  cell    = end == 0 ? face : moved<dim>(face, axis, -1);
            const auto *divided = topology ? &topology->faces[axis] : nullptr;
            if (!divided || divided->kind(face) == SubLattice<dim>::Kind::whole)
              action(SideFace<dim>{{axis, end}, face, cell, -1}, lattice.point(face));
            else
              for_each_part(*divided, face, [&](const int piece) {
                action(SideFace<dim>{{axis, end}, face, cell, piece}, divided->all()[piece].place);
              });
          });
        }
  }

  /// a n along the axis [m^(dim-1)].
  template <int dim>
  double
  signed_area(const MacGrid<dim>       &grid,
              const FluidTopology<dim> *topology,
              const SideFace<dim>      &face);

  /// The velocity along the axis [m/s].
  template <int dim>
  double
  value_on(const Velocity<dim> &velocity, const SideFace<dim> &face);

  /// a v.n [m^dim/s].
  template <int dim>
  double
  outward_flux(const MacGrid<dim> &grid, const Velocity<dim> &velocity, const SideFace<dim> &face);

  /// Where the pressure inside, next to a face on a side, sits.
  template <int dim>
  PressurePlace<dim>
  place_inside(const FluidTopology<dim> *topology, const SideFace<dim> &face);
} // namespace undine

#endif
