// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/flow_past_edges.h>
#include <undine/operators/make_no_slip_surfaces.h>
#include <undine/operators/wall_contacts.h>

namespace undine
{
  namespace
  {
    /// Of the pieces of all faces. Collective.
    template <int dim>
    std::vector<PieceShape<dim>>
    shapes_of_pieces(const MacGrid<dim>     &grid,
                     const CutCells<dim>    &cut,
                     const CutTopology<dim> &parts,
                     const unsigned int      axis)
    {
      const auto                  &divided = parts.open->faces[axis];
      const NoSlipSurfaces<dim>    none;
      const FaceLinks<dim>         links(grid, axis, *parts.open, none);
      std::vector<PieceShape<dim>> result(divided.all().size());
      std::vector<double>          values(result.size());
      const auto                   exchange = [&](const auto &number) {
        for (std::size_t k = 0; k < result.size(); ++k)
          values[k] = number(result[k]);
        divided.exchange(values);
        for (std::size_t k = 0; k < result.size(); ++k)
          number(result[k]) = values[k];
      };
      for (std::size_t k = 0; k < result.size(); ++k)
        if (const int piece = parts.cut_pieces[axis][k]; piece >= 0)
          result[k] = cut.pieces[piece].shape;
        else if (divided.owns(k)) // on a periodic side, where faces are open all over
          result[k] = links.whole_shape(divided.all()[k].index);
      for (unsigned int d = 0; d < dim; ++d)
        if (d != axis)
          {
            exchange([&](auto &shape) -> double & { return shape.lower_half[d]; });
            for (const unsigned int end : {0, 1})
              for (double Rim::*number : {&Rim::length, &Rim::middle})
                exchange([&](auto &shape) -> double & { return shape.rims[2 * d + end].*number; });
          }
      return result;
    }
  } // namespace


  template <int dim>
  NoSlipSurfaces<dim>
  make_no_slip_surfaces(const MacGrid<dim>       &grid,
                        const CutCells<dim>      &cut,
                        const CutTopology<dim>   &parts,
                        const BoundaryFlux<dim>  &boundary_flux,
                        const PlacedSurface<dim> &placed)
  {
    NoSlipSurfaces<dim> walls;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        walls.shapes[axis]     = shapes_of_pieces(grid, cut, parts, axis);
        walls.past_edges[axis] = flow_past_edges(grid, cut, parts, placed, axis);
      }
    WallContacts<dim> contacts(grid, cut, parts, placed, walls);
    for (unsigned int axis = 0; axis < dim; ++axis)
      contacts.add_of_faces(axis);
    for (const auto &entry : boundary_flux.entries())
      if (const int component = parts.open_components[entry.component]; component >= 0)
        walls.patches.push_back({component, entry.node, entry.value});
    walls.n_nodes = placed.positions.size();
    return walls;
  }


  template NoSlipSurfaces<2>
  make_no_slip_surfaces(const MacGrid<2> &,
                        const CutCells<2> &,
                        const CutTopology<2> &,
                        const BoundaryFlux<2> &,
                        const PlacedSurface<2> &);
  template NoSlipSurfaces<3>
  make_no_slip_surfaces(const MacGrid<3> &,
                        const CutCells<3> &,
                        const CutTopology<3> &,
                        const BoundaryFlux<3> &,
                        const PlacedSurface<3> &);
} // namespace undine
