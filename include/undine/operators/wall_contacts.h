// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_wall_contacts_h
#define undine_operators_wall_contacts_h

#include <undine/fluid/viscosity/face_links.h>
#include <undine/operators/cut_topology.h>
#include <undine/operators/wall_meetings.h>

#include <map>
#include <tuple>
#include <vector>

namespace undine
{
  /// The contacts of the fluid of faces with surfaces (I6). With the piece of a face moves the
  /// fluid from its plane to the middles of the cells beside it; the walls of this fluid are the
  /// fragments of the surface in those halves of cells (I13). Each of them acts where its wall, or
  /// the plane that extends it, meets the plane of the face: there a velocity that is linear in
  /// space has the gradient that it has. Walls around corners, which pass their piece by, act on
  /// its neighbours.
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
    using Wall    = typename WallMeetings<dim>::Wall;
    using Chord   = typename WallMeetings<dim>::Chord;
    using Meeting = typename WallMeetings<dim>::Meeting;
    using View    = typename WallMeetings<dim>::View;

    /// By how much walls narrow openings [m^(dim-1)]: by the pieces before and behind it.
    using Screened = std::map<std::tuple<int, GridIndex<dim>, int>, double>;

    double
    least_distance_at(const unsigned int axis, const GridIndex<dim> &face) const;
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
    template <class Of>
    void
    add_shares(const View &view, double &left, const std::vector<Wall> &walls, const Of &of);
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

    bool
    counts(const Wall &wall, const unsigned int axis, const int cell) const;
    bool
    is_wet(const int fragment) const;
    std::vector<Wall>
    walls_behind(const unsigned int axis, const typename FaceLinks<dim>::Opening &opening) const;
    int
    piece_at(const unsigned int            axis,
             const GridIndex<dim>         &face,
             const unsigned int            half,
             const int                     component,
             const dealii::Point<dim>     &where,
             const dealii::Tensor<1, dim> &normal) const;

    double
    share_of(const View &view, const Wall &wall, const Meeting &meeting) const;
    double
    least_of_extensions(const View &view, const Wall &wall) const;

    const MacGrid<dim>       &grid;
    const CutCells<dim>      &cut;
    const CutTopology<dim>   &parts;
    const FluidTopology<dim> &open;
    const PlacedSurface<dim> &placed;
    NoSlipSurfaces<dim>      &surfaces;
    const WallMeetings<dim>   meetings;
  };
} // namespace undine

#endif
