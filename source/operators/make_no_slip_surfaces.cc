// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/plane_chord.h>
#include <undine/fluid/boundary/boundary.h>
#include <undine/fluid/viscosity/face_links.h>
#include <undine/operators/make_no_slip_surfaces.h>
#include <undine/surface/facet_geometry.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    /// Contacts nearer than this share of a cell's width count as if they were that far away: at
    /// that distance fluid already moves with the wall, and the equations stay well conditioned.
    constexpr double least_distance = 0.01;


    template <int dim>
    class WallFinder
    {
    public:
      WallFinder(const MacGrid<dim>       &grid,
                 const CutCells<dim>      &cut,
                 const CutTopology<dim>   &parts,
                 const PlacedSurface<dim> &placed)
        : grid(grid)
        , cut(cut)
        , parts(parts)
        , open(*parts.open)
        , placed(placed)
      {
      }

      /// Of the pieces of all faces normal to `axis`. Collective.
      std::vector<Rims<dim>>
      rims(const unsigned int axis) const;

      /// Append the contacts of chords, then those of rims behind which nothing is open. @{
      void
      add_chords(NoSlipSurfaces<dim> &walls, const unsigned int axis) const;
      void
      add_closed_rims(NoSlipSurfaces<dim> &walls, const unsigned int axis) const;
      /// @}

    private:
      using Contact = typename NoSlipSurfaces<dim>::Contact;

      void
      add_chords_of_cell(NoSlipSurfaces<dim> &walls,
                         const unsigned int   axis,
                         const int            cell,
                         const unsigned int   end) const;
      std::vector<dealii::Point<dim>>
      corners_on_plane(const int fragment, const unsigned int axis, const double plane) const;
      int
      piece_at(const unsigned int     axis,
               const GridIndex<dim>  &face,
               const unsigned int     end,
               const int              component,
               const PlaneChord<dim> &chord) const;
      bool
      lies_among_whole_faces(const FaceLinks<dim> &links,
                             const unsigned int    axis,
                             const GridIndex<dim> &face) const;
      void
      add_closed_rim(NoSlipSurfaces<dim>  &walls,
                     const FaceLinks<dim> &links,
                     const FacePlace<dim> &place,
                     const unsigned int    axis,
                     const Side            side) const;
      int
      nearest_facet(const dealii::Point<dim> &place,
                    const GridIndex<dim>     &face,
                    const unsigned int        axis,
                    const Side                side) const;
      void
      add(std::vector<Contact>     &contacts,
          Contact                   contact,
          const unsigned int        axis,
          const int                 facet,
          const dealii::Point<dim> &place) const;

      FacetNodes<dim>
      corners(const int facet) const
      {
        FacetNodes<dim> result;
        for (unsigned int k = 0; k < dim; ++k)
          result[k] = placed.positions[placed.surface.facets()[facet][k]];
        return result;
      }

      dealii::Point<dim>
      point(const int facet, const std::array<double, dim> &weights) const
      {
        const auto         nodes = corners(facet);
        dealii::Point<dim> result;
        for (unsigned int k = 0; k < dim; ++k)
          result += weights[k] * nodes[k];
        return result;
      }

      const MacGrid<dim>       &grid;
      const CutCells<dim>      &cut;
      const CutTopology<dim>   &parts;
      const FluidTopology<dim> &open;
      const PlacedSurface<dim> &placed;
    };


    template <int dim>
    std::vector<Rims<dim>>
    WallFinder<dim>::rims(const unsigned int axis) const
    {
      const auto            &divided = open.faces[axis];
      std::vector<Rims<dim>> result(divided.all().size());
      const FaceLinks<dim>   links(grid, axis, open, result);
      for (std::size_t k = 0; k < result.size(); ++k)
        {
          const int piece = parts.cut_pieces[axis][k];
          if (piece >= 0)
            result[k] = cut.pieces[piece].rims;
          else if (divided.owns(k)) // on a periodic side
            for (unsigned int d = 0; d < dim; ++d)
              for (unsigned int end = 0; end < 2 && d != axis; ++end)
                result[k][2 * d + end] = links.rim({divided.all()[k].index, -1}, d, end);
        }
      std::vector<double> values(result.size());
      for (unsigned int side = 0; side < 2 * dim; ++side)
        for (double Rim::*number : {&Rim::length, &Rim::middle})
          {
            if (side / 2 == axis)
              continue;
            for (std::size_t k = 0; k < result.size(); ++k)
              values[k] = result[k][side].*number;
            divided.exchange(values);
            for (std::size_t k = 0; k < result.size(); ++k)
              result[k][side].*number = values[k];
          }
      return result;
    }


    template <int dim>
    void
    WallFinder<dim>::add(std::vector<Contact>     &contacts,
                         Contact                   contact,
                         const unsigned int        axis,
                         const int                 facet,
                         const dealii::Point<dim> &place) const
    {
      double width = std::numeric_limits<double>::infinity();
      for (unsigned int d = 0; d < dim; ++d)
        if (d != axis)
          width = std::min(width, grid.cell_width(d, contact.face[d]));
      contact.distance = std::max(contact.distance, least_distance * width);
      contact.nodes    = placed.surface.facets()[facet];
      contact.weights  = nearest_point(corners(facet), place);
      contacts.push_back(contact);
    }


    /// The piece of a face that joins a component on its side `end` and lies on the fluid's side of
    /// a chord; -1 if there is none.
    template <int dim>
    int
    WallFinder<dim>::piece_at(const unsigned int     axis,
                              const GridIndex<dim>  &face,
                              const unsigned int     end,
                              const int              component,
                              const PlaneChord<dim> &chord) const
    {
      const auto &divided = open.faces[axis];
      int         result  = -1;
      double      nearest = std::numeric_limits<double>::infinity();
      for_each_part(divided, face, [&](const int part) {
        const auto offset = chord.middle - divided.all()[part].place;
        if (open.pieces[axis][part].components[end] != component || offset * chord.normal <= 0 ||
            offset.norm() >= nearest)
          return;
        nearest = offset.norm();
        result  = part;
      });
      return result;
    }


    /// The corners on a plane, each once: two coincide where edges of surface and grid meet.
    template <int dim>
    std::vector<dealii::Point<dim>>
    WallFinder<dim>::corners_on_plane(const int          fragment,
                                      const unsigned int axis,
                                      const double       plane) const
    {
      constexpr double                same  = 1e-9; // in units of the facet's extent in the cell
      const int                       first = cut.corners.first[fragment];
      const int                       last  = cut.corners.first[fragment + 1];
      std::vector<dealii::Point<dim>> result;
      double                          extent = 0;
      for (int c = first; c < last; ++c)
        extent = std::max(extent, cut.corners.points[c].distance(cut.corners.points[first]));
      for (int c = first; c < last; ++c)
        {
          const auto &corner = cut.corners.points[c];
          if (corner[axis] == plane &&
              std::none_of(result.begin(), result.end(), [&](const auto &other) {
                return corner.distance(other) <= same * extent;
              }))
            result.push_back(corner);
        }
      return result;
    }


    /// On the face of a cell at `end` of `axis`.
    template <int dim>
    void
    WallFinder<dim>::add_chords_of_cell(NoSlipSurfaces<dim> &walls,
                                        const unsigned int   axis,
                                        const int            cell,
                                        const unsigned int   end) const
    {
      const auto   face  = moved<dim>(cut.cells[cell].index, axis, end);
      const double plane = cut.block.planes().position(axis, face[axis]);
      for (int f = cut.cells[cell].first_fragment; f < cut.end_fragment(cell); ++f)
        {
          const auto &fragment = cut.fragments[f];
          if (fragment.component < 0 || parts.open_components[fragment.component] < 0)
            continue;
          const auto ends = corners_on_plane(f, axis, plane);
          if (ends.size() != dim - 1)
            continue;
          const auto   chord  = plane_chord(ends, axis, fragment.area_vector);
          const double length = chord.normal.norm();
          const int    part =
            piece_at(axis, face, 1 - end, parts.open_components[fragment.component], chord);
          if (part < 0 || length == 0)
            continue;
          const auto offset = chord.middle - open.faces[axis].all()[part].place;
          add(walls.contacts[axis],
              {face, part, length, offset * chord.normal / length, {}, {}},
              axis,
              fragment.facet,
              chord.middle);
        }
    }


    template <int dim>
    void
    WallFinder<dim>::add_chords(NoSlipSurfaces<dim> &walls, const unsigned int axis) const
    {
      const auto &owned = grid.faces(axis)->owned();
      for (int cell = 0; cell < static_cast<int>(cut.cells.size()); ++cell)
        // Both cells at a plane know its chords: the one below counts, if there is one.
        for (const unsigned int end : {0, 1})
          if (const auto &index = cut.cells[cell].index;
              owned.contains(moved<dim>(index, axis, end)) && (end == 1 || index[axis] == 0))
            add_chords_of_cell(walls, axis, cell, end);
    }


    template <int dim>
    bool
    WallFinder<dim>::lies_among_whole_faces(const FaceLinks<dim> &links,
                                            const unsigned int    axis,
                                            const GridIndex<dim> &face) const
    {
      bool result = links.is_whole(face);
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int end = 0; end < 2 && d != axis; ++end)
          if (links.has_neighbour(face, d, end))
            result = result && links.is_whole(moved<dim>(face, d, end == 0 ? -1 : 1));
      return result;
    }


    template <int dim>
    void
    WallFinder<dim>::add_closed_rims(NoSlipSurfaces<dim> &walls, const unsigned int axis) const
    {
      const FaceLinks<dim> links(grid, axis, open, walls.rims[axis]);
      for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
        if (lies_among_whole_faces(links, axis, face))
          return;
        links.for_each_place(face, [&](const FacePlace<dim> &place) {
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int end = 0; end < 2 && d != axis; ++end)
              if (links.has_neighbour(face, d, end))
                add_closed_rim(walls, links, place, axis, {d, end});
        });
      });
    }


    /// What lies on a plane of the grid closes the faces behind it without a chord in them.
    template <int dim>
    void
    WallFinder<dim>::add_closed_rim(NoSlipSurfaces<dim>  &walls,
                                    const FaceLinks<dim> &links,
                                    const FacePlace<dim> &place,
                                    const unsigned int    axis,
                                    const Side            side) const
    {
      constexpr double negligible = 1e-9;
      const Rim        rim        = links.rim(place, side.axis, side.end);
      double           closed     = rim.length;
      links.for_each_neighbour(
        place, side.axis, side.end, [&](const FacePlace<dim> &, const double common) {
          closed -= common;
        });
      if (closed <= negligible * rim.length)
        return;
      auto         on_rim = links.centroid(place);
      const double at     = links.side(place, side.axis, side.end);
      const double offset = side.sign() * (at - on_rim[side.axis]);
      on_rim[side.axis]   = at;
      const int facet     = nearest_facet(on_rim, place.face, axis, side);
      if (facet >= 0)
        add(walls.contacts[axis],
            {place.face, place.part, closed, offset, {}, {}},
            axis,
            facet,
            on_rim);
    }


    /// Of those in the cells around the side of a face that bounds a rim; -1 if there are none.
    template <int dim>
    int
    WallFinder<dim>::nearest_facet(const dealii::Point<dim> &place,
                                   const GridIndex<dim>     &face,
                                   const unsigned int        axis,
                                   const Side                side) const
    {
      int    result  = -1;
      double nearest = std::numeric_limits<double>::infinity();
      for (const int below : {-1, 0})
        for (const int beyond : {0, side.sign()})
          {
            const auto cell = moved<dim>(moved<dim>(face, axis, below), side.axis, beyond);
            const int  slot = cut.block.cells().contains(cell) ? cut.cut_cell(cell) : -1;
            if (slot < 0)
              continue;
            for (int f = cut.cells[slot].first_fragment; f < cut.end_fragment(slot); ++f)
              {
                const int    facet    = cut.fragments[f].facet;
                const auto   weights  = nearest_point(corners(facet), place);
                const double distance = place.distance(point(facet, weights));
                if (distance < nearest)
                  {
                    nearest = distance;
                    result  = facet;
                  }
              }
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
    const WallFinder<dim> finder(grid, cut, parts, placed);
    NoSlipSurfaces<dim>   walls;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        walls.rims[axis] = finder.rims(axis);
        finder.add_chords(walls, axis);
        finder.add_closed_rims(walls, axis);
      }
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
