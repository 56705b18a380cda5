// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_wall_contacts_h
#define undine_operators_wall_contacts_h

#include <undine/cutting/cut_workspace.h>
#include <undine/cutting/plane_chord.h>
#include <undine/fluid/viscosity/face_links.h>
#include <undine/operators/cut_topology.h>
#include <undine/surface/facet_geometry.h>

#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace undine
{
  /// The contacts of the fluid of faces with surfaces (I6). With the piece of a face moves the
  /// fluid from its plane to the middles of the cells beside it; the walls of this fluid are the
  /// fragments of the surface in those halves of cells. Each of them acts where its wall, or the
  /// plane that extends it, meets the plane of the face; if that is on the wrong side, at its own
  /// place on a velocity between those of both faces of the cell. Either has the right gradient if
  /// the velocity is linear in space.
  template <int dim>
  class WallContacts
  {
  public:
    /// `surfaces` knows the shapes of the pieces and gets their contacts. The references must
    /// outlive it.
    WallContacts(const MacGrid<dim>       &grid,
                 const CutCells<dim>      &cut,
                 const CutTopology<dim>   &parts,
                 const PlacedSurface<dim> &placed,
                 NoSlipSurfaces<dim>      &surfaces);

    /// Add the contacts and passages of the faces normal to `axis` that this rank owns.
    void
    add_of_faces(const unsigned int axis);

  private:
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
      Spot                   spot;
      double                 distance; ///< from the piece's centroid, along the wall's normal [m]
      dealii::Tensor<1, dim> offset;   ///< in the plane of the face [m]

      bool is_chord = false; ///< not an extension
    };

    /// By how much walls narrow openings [m^(dim-1)]: by the pieces before and behind it.
    using Screened = std::map<std::tuple<int, GridIndex<dim>, int>, double>;

    /// From where walls are seen: a piece of a face normal to `axis`, below (0) or above (1) which
    /// they are.
    struct View
    {
      unsigned int   axis;
      FacePlace<dim> piece;
      unsigned int   half;
    };

    void
    add_walls(const unsigned int axis, const int cell, const unsigned int end);
    double
    add_to_neighbour(const View &view, const Wall &wall, const double area, Screened &screened);
    void
    add_closed_openings(const unsigned int axis);
    void
    add_closed_opening(const FacePlace<dim>                   &piece,
                       const unsigned int                      axis,
                       const Side                             &side,
                       const typename FaceLinks<dim>::Opening &opening);
    void
    add(const unsigned int    axis,
        const FacePlace<dim> &place,
        const double          area,
        const Meeting        &meeting);

    void
    add_passages(const unsigned int axis);
    void
    add_passages(const unsigned int axis, const unsigned int half, std::vector<int> pieces);
    dealii::Tensor<1, dim>
    boundary_area(const unsigned int axis, const unsigned int half, const int piece) const;

    std::vector<Chord>
    chords(const unsigned int axis, const GridIndex<dim> &face) const;
    Wall
    wall(const int fragment, const unsigned int axis, const int cell, const unsigned int end) const;
    bool
    counts(const Wall &wall, const unsigned int axis, const int cell) const;
    bool
    is_wet(const int fragment) const;
    bool
    is_along_plane(const int facet, const unsigned int axis) const;
    std::vector<Wall>
    walls_behind(const unsigned int axis, const typename FaceLinks<dim>::Opening &opening) const;
    int
    piece_at(const unsigned int            axis,
             const GridIndex<dim>         &face,
             const unsigned int            half,
             const int                     component,
             const dealii::Point<dim>     &where,
             const dealii::Tensor<1, dim> &normal) const;

    const Chord *
    chord_of(const Wall                   &wall,
             const std::vector<Chord>     &chords,
             const dealii::Tensor<1, dim> &facing) const;
    Meeting
    at_chord(const View &view, const Chord &chord) const;
    Spot
    extension(const View &view, const Wall &wall) const;
    std::optional<Spot>
    nearest_spot(const dealii::Point<dim> &place,
                 const GridIndex<dim>     &face,
                 const unsigned int        axis,
                 const Side               &side) const;
    Meeting
    seen(const View &view, const dealii::Tensor<1, dim> &normal, const Spot &spot) const;
    double
    share_of(const View &view, const Wall &wall, const Meeting &meeting) const;
    double
    least_of_extensions(const View &view, const Wall &wall) const;
    Meeting
    meeting(const View &view, const Wall &wall, const std::vector<Chord> &chords) const;

    double
    plane(const unsigned int axis, const GridIndex<dim> &face) const
    {
      return cut.block.planes().position(axis, face[axis]);
    }

    FacetNodes<dim>
    corners(const int facet) const;
    dealii::Tensor<1, dim>
    unit_normal(const int facet) const;
    dealii::Point<dim>
    centroid(const unsigned int axis, const FacePlace<dim> &place) const;

    dealii::ArrayView<const dealii::Point<dim>>
    corners_of_fragment(const int fragment) const;

    const MacGrid<dim>       &grid;
    const CutCells<dim>      &cut;
    const CutTopology<dim>   &parts;
    const FluidTopology<dim> &open;
    const PlacedSurface<dim> &placed;
    NoSlipSurfaces<dim>      &surfaces;
  };
} // namespace undine

#endif
