// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_wall_meetings_h
#define undine_operators_wall_meetings_h

#include <undine/cutting/cut_workspace.h>
#include <undine/cutting/fragment_at_plane.h>
#include <undine/fluid/boundary/boundary.h>
#include <undine/fluid/boundary/no_slip_surfaces.h>
#include <undine/fluid/grid/face_place.h>
#include <undine/fluid/grid/fluid_topology.h>
#include <undine/fluid/grid/mac_grid.h>
#include <undine/operators/cut_topology.h>
#include <undine/surface/facet_geometry.h>
#include <undine/surface/nearest_in_simplex.h>

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

namespace undine
{
  /// Facets whose normals have at least this cosine belong to one smooth wall.
  constexpr double smooth_wall = 0.7;


  /// Along which axis a vector in a plane is longest.
  template <int dim>
  unsigned int
  main_direction(const unsigned int normal_axis, const dealii::Tensor<1, dim> &vector)
  {
    unsigned int result = normal_axis == 0 ? 1 : 0;
    for (unsigned int d = 0; d < dim; ++d)
      if (std::abs(vector[d]) > std::abs(vector[result]))
        result = d;
    return result;
  }


  /// Where the walls in cut cells meet the planes of faces, or would if they went on (I13). Only
  /// what any rank knows that owns a face beside is looked at: the cells around it.
  template <int dim>
  class WallMeetings
  {
  public:
    /// Of a fragment, in the half of its cell next to a plane.
    struct Wall
    {
      int                    fragment;
      dealii::Tensor<1, dim> area;     ///< out of the fluid, without its part normal to the plane
      double                 size;     ///< with that [m^(dim-1)]
      dealii::Point<dim>     centroid; ///< [m]
    };

    /// Where a fragment meets the plane of a face.
    struct Chord
    {
      int             fragment;
      PlaneChord<dim> chord;
    };

    /// A place on a facet, or in its plane, by its barycentric coordinates.
    struct Spot
    {
      unsigned int            facet;
      std::array<double, dim> weights;
    };

    /// Where a wall acts.
    struct Meeting
    {
      Spot   spot;
      double distance = 0; ///< from the piece's centroid in the plane, along the wall's normal, or
                           ///< that of what is in front of a chord in the mean [m]
      bool is_chord = false; ///< not an extension
    };

    /// From where walls are seen: a piece of a face normal to `axis`, below (0) or above (1) which
    /// they are.
    struct View
    {
      unsigned int   axis;
      FacePlace<dim> piece;
      unsigned int   half;
    };

    /// The references must outlive it.
    WallMeetings(const MacGrid<dim>        &grid,
                 const CutCells<dim>       &cut,
                 const CutTopology<dim>    &parts,
                 const NoSlipSurfaces<dim> &surfaces,
                 const PlacedSurface<dim>  &placed);

    /// The place of a wall itself.
    Spot
    on_wall(const Wall &wall) const
    {
      const unsigned int facet = cut.fragments[wall.fragment].facet;
      return {facet, nearest_point(corners(facet), wall.centroid)};
    }

    /// What of a fragment is next to the face of its cell at `end`.
    Wall
    wall(const int fragment, const unsigned int axis, const int cell, const unsigned int end) const;

    /// All chords on a face.
    std::vector<Chord>
    chords(const unsigned int axis, const GridIndex<dim> &face) const;

    /// The chord of a wall, or the nearest one of the smooth wall of its body that it belongs to,
    /// which faces the same side and which the piece is in front of; nullptr if there is none.
    const Chord *
    chord_of(const View                   &view,
             const Wall                   &wall,
             const std::vector<Chord>     &chords,
             const dealii::Tensor<1, dim> &facing) const;

    /// The wall acts where it meets the plane. `chords`: all on the face.
    Meeting
    at_chord(const View &view, const Chord &chord, const std::vector<Chord> &chords) const;

    /// Where a wall acts on a piece: at its chord, or where it would meet the plane.
    Meeting
    meeting(const View &view, const Wall &wall, const std::vector<Chord> &chords) const;

    /// The nearest place on the facets in the cells around the side of a face of which
    /// `counts(facet)`, all if it is not given; nothing if there are none.
    std::optional<Spot>
    nearest_spot(const dealii::Point<dim>                &place,
                 const GridIndex<dim>                    &face,
                 const unsigned int                       axis,
                 const Side                              &side,
                 const std::function<bool(unsigned int)> &counts = {}) const;

    /// Where the velocity of a piece, or of a whole face, acts: its centroid, or the middle of what
    /// flows past an edge [m].
    dealii::Point<dim>
    middle(const unsigned int axis, const FacePlace<dim> &place) const;

  private:
    Spot
    extension(const View &view, const Wall &wall) const;
    Meeting
    seen(const View &view, const dealii::Tensor<1, dim> &normal, const Spot &spot) const;
    std::vector<PlaneChord<dim>>
    boundary(const View &view, const std::vector<Chord> &chords) const;
    bool
    is_along_plane(const int facet, const unsigned int axis) const;

    double
    plane(const unsigned int axis, const GridIndex<dim> &face) const
    {
      return cut.block.planes().position(axis, face[axis]);
    }

    FacetNodes<dim>
    corners(const int facet) const;
    dealii::Tensor<1, dim>
    unit_normal(const int facet) const;
    dealii::ArrayView<const dealii::Point<dim>>
    corners_of_fragment(const int fragment) const;

    const MacGrid<dim>        &grid;
    const CutCells<dim>       &cut;
    const CutTopology<dim>    &parts;
    const FluidTopology<dim>  &open;
    const NoSlipSurfaces<dim> &surfaces;
    const PlacedSurface<dim>  &placed;
  };
} // namespace undine

#endif
