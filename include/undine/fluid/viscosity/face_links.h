// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_face_links_h
#define undine_fluid_viscosity_face_links_h

#include <undine/fluid/boundary/boundary.h>
#include <undine/fluid/boundary/no_slip_surfaces.h>
#include <undine/fluid/grid/face_place.h>
#include <undine/fluid/grid/fluid_topology.h>
#include <undine/fluid/grid/mac_grid.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace undine
{
  /// Which faces normal to one axis, and which of their pieces, move fluid that touches. With a
  /// piece moves the fluid from its plane to the middles of the cells beside it: a half of the
  /// component below and a half of that above. Where the fluid of two pieces touches are the
  /// halves, next to the plane, of the pieces of faces normal to the others that lie in the plane.
  template <int dim>
  class FaceLinks
  {
  public:
    /// Distances shorter than this share of the width of a cell count as that.
    static constexpr double least_share = 0.01;

    /// Where the fluid of a piece touches what is beyond a side.
    struct Opening
    {
      double       area;      ///< [m^(dim-1)]
      unsigned int half;      ///< 0: below the plane, 1: above it
      int          component; ///< beyond: number in FluidTopology::cells, `whole` or `outside`
      std::optional<FacePlace<dim>> neighbour; ///< that moves the fluid beyond, if any piece does
    };

    /// `surfaces` knows the shapes of all pieces. The references must outlive it.
    FaceLinks(const MacGrid<dim>        &grid,
              const unsigned int         axis,
              const FluidTopology<dim>  &open,
              const NoSlipSurfaces<dim> &surfaces)
      : grid(grid)
      , axis(axis)
      , open(open)
      , surfaces(surfaces)
    {
    }

    /// Is a face open all over? Then the cells beside it are.
    bool
    is_whole(const GridIndex<dim> &face) const
    {
      return undine::is_whole(divided(axis), face);
    }

    /// action(FacePlace) for what is open of a face.
    template <class Action>
    void
    for_each_place(const GridIndex<dim> &face, const Action &action) const
    {
      undine::for_each_place(divided(axis), face, action);
    }

    /// Centroid [m].
    dealii::Point<dim>
    centroid(const FacePlace<dim> &place) const
    {
      return centroid(axis, place);
    }

    /// Where the velocity acts: the centroid, or the middle of what flows past an edge [m].
    dealii::Point<dim>
    middle(const FacePlace<dim> &place) const
    {
      const auto *edge = surfaces.past_edge(axis, place);
      return edge ? centroid(place) + edge->shift : centroid(place);
    }

    /// Of the middles of two pieces along `d`, at least a hundredth of the narrower cell: what is
    /// nearer moves along anyway, and the equations keep their condition [m].
    double
    distance(const FacePlace<dim> &a, const FacePlace<dim> &b, const unsigned int d) const
    {
      return std::max(std::abs(middle(b)[d] - middle(a)[d]),
                      least_share *
                        std::min(grid.cell_width(d, a.face[d]), grid.cell_width(d, b.face[d])));
    }

    /// Where the side of a face is, along its normal [m].
    double
    position(const GridIndex<dim> &face, const Side &side) const
    {
      return grid.faces(axis)->row(side.axis).position(face[side.axis]) +
             side.sign() * grid.cell_width(side.axis, face[side.axis]) / 2;
    }

    /// Is there a face beyond that side, or does the domain end there?
    bool
    has_neighbour(const GridIndex<dim> &face, const Side &side) const
    {
      const auto &row  = grid.faces(axis)->row(side.axis);
      const int   next = face[side.axis] + side.sign();
      return row.periodic() || (next >= 0 && next < row.size());
    }

    /// action(Opening) for all openings on a side.
    template <class Action>
    void
    for_each_opening(const FacePlace<dim> &place, const Side &side, const Action &action) const;

    /// action(FacePlace, area [m^(dim-1)]) for what moves fluid that touches that of a piece on
    /// that side.
    template <class Action>
    void
    for_each_neighbour(const FacePlace<dim> &place, const Side &side, const Action &action) const;

    /// Over which the fluid of a piece touches a side of the domain [m^(dim-1)].
    double
    area_on_side(const FacePlace<dim> &place, const Side &side) const;

    /// The area of a side of the fluid that moves with a whole face [m^(dim-1)].
    double
    whole_area(const GridIndex<dim> &face, const Side &side) const
    {
      return grid.dual_width(axis, face[axis]) * whole_rim(axis, face, side.axis).length;
    }

    /// The shape of a face that is open all over.
    PieceShape<dim>
    whole_shape(const GridIndex<dim> &face) const;

    /// What is below (0) or above (1) a piece: as FluidTopology::Piece::components.
    int
    beside(const FacePlace<dim> &place, const unsigned int half) const
    {
      return beside(axis, place, half);
    }

  private:
    const SubLattice<dim> *
    divided(const unsigned int normal) const
    {
      return &open.faces[normal];
    }

    dealii::Point<dim>
    centroid(const unsigned int normal, const FacePlace<dim> &place) const
    {
      return place.part < 0 ? grid.faces(normal)->point(place.face)
                            : open.faces[normal].all()[place.part].place;
    }

    int
    beside(const unsigned int normal, const FacePlace<dim> &place, const unsigned int end) const
    {
      return place.part < 0 ? FluidTopology<dim>::whole
                            : open.pieces[normal][place.part].components[end];
    }

    Rim
    whole_rim(const unsigned int normal, const GridIndex<dim> &face, const unsigned int d) const;

    Rim
    rim(const unsigned int normal, const FacePlace<dim> &place, const Side &side) const
    {
      return place.part < 0 ? whole_rim(normal, place.face, side.axis)
                            : surfaces.shapes[normal][place.part].rims[2 * side.axis + side.end];
    }

    /// The area of the half of a piece, normal to `normal`, that is lower or upper along the axis.
    double
    half_area(const unsigned int normal, const FacePlace<dim> &place, const unsigned int end) const;

    /// Of the pieces of a face that bound `component`, below or above, the one that shares the
    /// longest part of the edge on its side with an opening, or else is nearest to it.
    std::optional<FacePlace<dim>>
    piece_at(const GridIndex<dim> &face,
             const Side           &side,
             const unsigned int    half,
             const int             component,
             const unsigned int    normal,
             const FacePlace<dim> &opening) const;

    const MacGrid<dim>        &grid;
    const unsigned int         axis;
    const FluidTopology<dim>  &open;
    const NoSlipSurfaces<dim> &surfaces;
  };


  template <int dim>
  template <class Action>
  void
  FaceLinks<dim>::for_each_opening(const FacePlace<dim> &place,
                                   const Side           &side,
                                   const Action         &action) const
  {
    const auto next = moved<dim>(place.face, side.axis, side.sign());
    for (const unsigned int half : {0, 1})
      {
        const auto cell      = moved<dim>(place.face, axis, half == 0 ? -1 : 0);
        const int  component = beside(place, half);
        if (!grid.periodic(axis) && (cell[axis] < 0 || cell[axis] >= int(grid.cells_along()[axis])))
          continue;
        undine::for_each_place(
          divided(side.axis), moved<dim>(cell, side.axis, side.end), [&](const auto &opening) {
            if (beside(side.axis, opening, 1 - side.end) != component)
              return;
            const auto own = piece_at(place.face, side, half, component, side.axis, opening);
            if (!own || own->part != place.part)
              return;
            const int  beyond = beside(side.axis, opening, side.end);
            const Side opposite{side.axis, 1 - side.end};
            action(Opening{half_area(side.axis, opening, 1 - half),
                           half,
                           beyond,
                           has_neighbour(place.face, side)
                             ? piece_at(next, opposite, half, beyond, side.axis, opening)
                             : std::nullopt});
          });
      }
  }


  template <int dim>
  template <class Action>
  void
  FaceLinks<dim>::for_each_neighbour(const FacePlace<dim> &place,
                                     const Side           &side,
                                     const Action         &action) const
  {
    const auto next = moved<dim>(place.face, side.axis, side.sign());
    if (place.part < 0 && is_whole(next))
      action(FacePlace<dim>{next, -1}, whole_area(place.face, side));
    else
      for_each_opening(place, side, [&](const Opening &opening) {
        if (opening.neighbour)
          action(*opening.neighbour, opening.area);
      });
  }
} // namespace undine

#endif
