// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_face_links_h
#define undine_fluid_viscosity_face_links_h

#include <undine/fluid/boundary/no_slip_surfaces.h>
#include <undine/fluid/grid/face_place.h>
#include <undine/fluid/grid/fluid_topology.h>
#include <undine/fluid/grid/mac_grid.h>

#include <algorithm>

namespace undine
{
  /// Which faces normal to one axis, and which of their pieces, are neighbours in their plane, and
  /// the rim that they share.
  template <int dim>
  class FaceLinks
  {
  public:
    /// `rims` of the pieces of this axis. The references must outlive it.
    FaceLinks(const MacGrid<dim>           &grid,
              const unsigned int            axis,
              const FluidTopology<dim>     &open,
              const std::vector<Rims<dim>> &rims)
      : grid(grid)
      , axis(axis)
      , lattice(*grid.faces(axis))
      , divided(open.faces[axis])
      , rims(rims)
    {
    }

    /// Is a face open all over?
    bool
    is_whole(const GridIndex<dim> &face) const
    {
      return undine::is_whole(&divided, face);
    }

    /// action(FacePlace) for what is open of a face.
    template <class Action>
    void
    for_each_place(const GridIndex<dim> &face, const Action &action) const
    {
      undine::for_each_place(&divided, face, action);
    }

    /// Centroid [m].
    dealii::Point<dim>
    centroid(const FacePlace<dim> &place) const
    {
      return place.part < 0 ? lattice.point(place.face) : divided.all()[place.part].place;
    }

    /// The rim on the side `end` of `direction`, and where that side is [m]. @{
    Rim
    rim(const FacePlace<dim> &place, const unsigned int direction, const unsigned int end) const
    {
      if (place.part >= 0)
        return rims[place.part][2 * direction + end];
      Rim result{1, 0};
      for (unsigned int d = 0; d < dim; ++d)
        if (d != axis && d != direction)
          result = {grid.cell_width(d, place.face[d]), lattice.row(d).position(place.face[d])};
      return result;
    }

    double
    side(const FacePlace<dim> &place, const unsigned int direction, const unsigned int end) const
    {
      const double half = grid.cell_width(direction, place.face[direction]) / 2;
      return lattice.row(direction).position(place.face[direction]) + (end == 0 ? -half : half);
    }
    /// @}

    /// Is there a face beyond that side, or does the domain end there?
    bool
    has_neighbour(const GridIndex<dim> &face,
                  const unsigned int    direction,
                  const unsigned int    end) const
    {
      const int next = face[direction] + (end == 0 ? -1 : 1);
      return lattice.row(direction).periodic() ||
             (next >= 0 && next < lattice.row(direction).size());
    }

    /// action(FacePlace, length of the rim in common) for what a piece touches on that side.
    template <class Action>
    void
    for_each_neighbour(const FacePlace<dim> &place,
                       const unsigned int    direction,
                       const unsigned int    end,
                       const Action         &action) const
    {
      const Rim own = rim(place, direction, end);
      for_each_place(moved<dim>(place.face, direction, end == 0 ? -1 : 1),
                     [&](const FacePlace<dim> &next) {
                       const Rim    other = rim(next, direction, 1 - end);
                       const double common =
                         std::min(own.middle + own.length / 2, other.middle + other.length / 2) -
                         std::max(own.middle - own.length / 2, other.middle - other.length / 2);
                       if (own.length > 0 && other.length > 0 && common > 0)
                         action(next, common);
                     });
    }

  private:
    const MacGrid<dim>           &grid;
    const unsigned int            axis;
    const Lattice<dim>           &lattice;
    const SubLattice<dim>        &divided;
    const std::vector<Rims<dim>> &rims;
  };
} // namespace undine

#endif
