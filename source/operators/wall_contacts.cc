// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/wall_contacts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace undine
{
  namespace
  {
    /// Contacts nearer than this share of a cell's width count as if they were that far away: at
    /// that distance fluid already moves with the wall, and the equations stay well conditioned.
    constexpr double least_distance = 0.01;

    /// Areas below this share of a face are rounding.
    constexpr double negligible_area = 1e-9;
  } // namespace


  template <int dim>
  WallContacts<dim>::WallContacts(const MacGrid<dim>       &grid,
                                  const CutCells<dim>      &cut,
                                  const CutTopology<dim>   &parts,
                                  const PlacedSurface<dim> &placed,
                                  NoSlipSurfaces<dim>      &surfaces)
    : grid(grid)
    , cut(cut)
    , parts(parts)
    , open(*parts.open)
    , placed(placed)
    , surfaces(surfaces)
    , meetings(grid, cut, parts, surfaces, placed)
  {
  }


  template <int dim>
  void
  WallContacts<dim>::add_of_faces(const unsigned int axis)
  {
    const auto &owned = grid.faces(axis)->owned(), &owned_cells = grid.cells()->owned();
    for (int cell = 0; cell < static_cast<int>(cut.cells.size()); ++cell)
      for (const unsigned int end : {0, 1})
        {
          const auto &index = cut.cells[cell].index;
          const auto  face  = moved<dim>(index, axis, end);
          // Above the last cell is an image of the first face, which is below that one alone.
          const bool is_image = end == 1 && grid.periodic(axis) &&
                                face[axis] == static_cast<int>(grid.cells_along()[axis]);
          if (is_image ? owned_cells.contains(index) : owned.contains(face))
            add_walls(axis, cell, end);
        }
    add_closed_openings(axis);
    add_passages(axis);
  }


  /// In the plane of a face.
  template <int dim>
  double
  WallContacts<dim>::least_distance_at(const unsigned int axis, const GridIndex<dim> &face) const
  {
    double width = std::numeric_limits<double>::infinity();
    for (unsigned int d = 0; d < dim; ++d)
      if (d != axis)
        width = std::min(width, grid.cell_width(d, face[d]));
    return least_distance * width;
  }


  template <int dim>
  void
  WallContacts<dim>::add(const unsigned int    axis,
                         const FacePlace<dim> &place,
                         const double          area,
                         const Meeting        &meeting)
  {
    surfaces.contacts[axis].push_back(
      {place,
       area,
       std::max(meeting.distance, least_distance_at(axis, place.face)),
       placed.surface.facets()[meeting.spot.facet],
       meeting.spot.weights});
  }


  /// The walls in the half of a cell next to its face at `end`.
  template <int dim>
  void
  WallContacts<dim>::add_walls(const unsigned int axis, const int cell, const unsigned int end)
  {
    const auto face  = moved<dim>(cut.cells[cell].index, axis, end);
    const auto lines = meetings.chords(axis, face);
    Screened   screened;
    for (int f = cut.cells[cell].first_fragment; f < cut.end_fragment(cell); ++f)
      if (const auto found = meetings.wall(f, axis, cell, end);
          is_wet(f) && counts(found, axis, cell))
        {
          const double area = found.area.norm();
          const int    part = piece_at(axis,
                                    face,
                                    1 - end,
                                    parts.open_components[cut.fragments[f].component],
                                    found.centroid,
                                    found.area / area);
          if (part < 0)
            continue;
          const View   view{axis, {face, part}, 1 - end};
          const auto   meeting = meetings.meeting(view, found, lines);
          const double own     = share_of(view, found, meeting) * area;
          const double beyond  = add_to_neighbour(view, found, area - own, screened);
          if (own > 0)
            add(axis, view.piece, own, meeting);
          if (const double left = area - own - beyond; left > negligible_area * area)
            add(axis,
                view.piece,
                left,
                {meetings.on_wall(found),
                 std::max(meeting.distance, least_of_extensions(view, found))});
        }
  }


  /// The extension of a wall may come close to the centroid of a piece, or pass it on the wrong
  /// side: the share of the wall that acts on the piece falls to zero before, so that its force is
  /// bounded and continuous.
  template <int dim>
  double
  WallContacts<dim>::share_of(const View &view, const Wall &wall, const Meeting &meeting) const
  {
    if (meeting.is_chord)
      return 1;
    return std::pow(std::clamp(meeting.distance / least_of_extensions(view, wall), 0., 1.), 2);
  }


  /// Half the width of the cell, or of what passes an edge.
  template <int dim>
  double
  WallContacts<dim>::least_of_extensions(const View &view, const Wall &wall) const
  {
    const unsigned int d    = main_direction(view.axis, wall.area);
    const auto        *edge = surfaces.past_edge(view.axis, view.piece);
    return grid.cell_width(d, view.piece.face[d]) / (edge ? edge->factor : 1.) / 2;
  }


  /// A part of a wall that acts on the piece in front of its own one, seen from the wall, and
  /// screens the one from the other. Returns how much of it does [m^(dim-1)].
  template <int dim>
  double
  WallContacts<dim>::add_to_neighbour(const View  &view,
                                      const Wall  &wall,
                                      const double area,
                                      Screened    &screened)
  {
    if (!(area > 0))
      return 0;
    const FaceLinks<dim> links(grid, view.axis, open, surfaces);
    const unsigned int   d = main_direction(view.axis, wall.area);
    const Side           side{d, wall.area[d] > 0 ? 0u : 1u};
    const double         projection = std::abs(wall.area[d]) / wall.area.norm();
    double               result     = 0;
    links.for_each_opening(view.piece, side, [&](const auto &opening) {
      if (result == area || opening.half != view.half || !opening.neighbour)
        return;
      const auto  &beyond  = *opening.neighbour;
      auto        &sum     = screened[{view.piece.part, beyond.face, beyond.part}];
      const double part    = std::min(area - result, (opening.area - sum) / projection);
      const auto   meeting = meetings.meeting({view.axis, beyond, view.half}, wall, {});
      if (!(part > 0) || !(meeting.distance > 0))
        return;
      result += part;
      sum += projection * part;
      add(view.axis, beyond, part, meeting);
      surfaces.passages[view.axis].push_back(
        {{{view.piece, beyond}},
         -surfaces.share_between(view.axis, view.piece, beyond, d) * projection * part,
         links.distance(view.piece, beyond, d)});
    });
    return result;
  }


  /// Is there more of a wall than rounding?
  template <int dim>
  bool
  WallContacts<dim>::counts(const Wall &wall, const unsigned int axis, const int cell) const
  {
    double largest = 0;
    for (unsigned int d = 0; d < dim; ++d)
      if (d != axis)
        largest = std::max(largest, cut.block.face_area(d, cut.cells[cell].index));
    return wall.area.norm() > negligible_area * largest;
  }


  /// Does a fragment bound fluid that moves?
  template <int dim>
  bool
  WallContacts<dim>::is_wet(const int fragment) const
  {
    const int component = cut.fragments[fragment].component;
    return component >= 0 && parts.open_components[component] >= 0;
  }


  /// The piece of a face that bounds a component on its side `half` and sees a wall; of several the
  /// nearest one on the fluid's side of the wall. -1 if there is none.
  template <int dim>
  int
  WallContacts<dim>::piece_at(const unsigned int            axis,
                              const GridIndex<dim>         &face,
                              const unsigned int            half,
                              const int                     component,
                              const dealii::Point<dim>     &where,
                              const dealii::Tensor<1, dim> &normal) const
  {
    const auto &divided     = open.faces[axis];
    int         result      = -1;
    bool        is_in_front = false;
    double      least       = std::numeric_limits<double>::infinity();
    for_each_part(divided, face, [&](const int part) {
      if (open.pieces[axis][part].components[half] != component)
        return;
      const auto   offset   = where - divided.all()[part].place;
      const bool   in_front = offset * normal > 0;
      const double distance = offset.norm();
      if (result >= 0 && (in_front == is_in_front ? distance >= least : is_in_front))
        return;
      result      = part;
      is_in_front = in_front;
      least       = distance;
    });
    return result;
  }


  template <int dim>
  void
  WallContacts<dim>::add_closed_openings(const unsigned int axis)
  {
    const FaceLinks<dim> links(grid, axis, open, surfaces);
    const auto           add_those_of = [&](const FacePlace<dim> &place, const Side &side) {
      links.for_each_opening(place, side, [&](const auto &opening) {
        if (!opening.neighbour &&
            opening.area > negligible_area * links.whole_area(place.face, side))
          add_closed_opening(place, axis, side, opening);
      });
    };
    for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
      for (unsigned int d = 0; d < dim; ++d)
        for (const unsigned int end : {0, 1})
          if (const Side side{d, end};
              d != axis && links.has_neighbour(face, side) &&
              !(links.is_whole(face) && links.is_whole(moved<dim>(face, d, side.sign()))))
            links.for_each_place(face, [&](const auto &place) { add_those_of(place, side); });
    });
  }


  /// Beyond an opening there is fluid that nothing in the plane moves: a wall there reaches the
  /// plane, or next to it. If it goes on into one that the piece touches, it acts where that meets
  /// the plane. Else what faces the opening acts where it would meet the plane; between the rest
  /// and the wall fluid sticks, and acts with the wall's velocity from the middle of the closed
  /// face.
  template <int dim>
  void
  WallContacts<dim>::add_closed_opening(const FacePlace<dim>                   &piece,
                                        const unsigned int                      axis,
                                        const Side                             &side,
                                        const typename FaceLinks<dim>::Opening &opening)
  {
    dealii::Tensor<1, dim> outward;
    outward[side.axis] = side.sign();
    const View view{axis, piece, opening.half};
    const auto walls = walls_behind(axis, opening);
    const auto lines = meetings.chords(axis, piece.face);
    double     left  = opening.area;
    add_shares(view, left, walls, [&](const Wall &wall) {
      const auto *line = meetings.chord_of(view, wall, lines, outward);
      return line ? std::make_pair(wall.size, meetings.at_chord(view, *line, lines))
                  : std::make_pair(0., Meeting());
    });
    const auto closed = moved<dim>(piece.face, side.axis, side.sign());
    // Of two facets that are as far off, that on the side of the piece.
    constexpr double tie      = 1e-8;
    const auto       centroid = meetings.middle(axis, piece);
    auto             stuck    = centroid;
    stuck[side.axis]          = grid.faces(axis)->point(closed)[side.axis];
    const double middle       = std::abs(stuck[side.axis] - centroid[side.axis]);
    add_shares(view, left, walls, [&](const Wall &wall) {
      const double facing = side.sign() * wall.area[side.axis];
      if (!(facing > 0))
        return std::make_pair(0., Meeting());
      const auto meeting = meetings.meeting(view, wall, {});
      return std::make_pair(meeting.distance < middle ? facing * share_of(view, wall, meeting) : 0.,
                            meeting);
    });
    if (left > negligible_area * opening.area)
      if (const auto spot =
            meetings.nearest_spot(stuck + tie * (centroid - stuck), closed, axis, side))
        add(axis, piece, left, {*spot, middle});
  }


  /// Add the contacts of walls with the areas and places that `of` says, all together no more than
  /// is `left`, which becomes less by that: in proportion, whatever the order of walls is.
  template <int dim>
  template <class Of>
  void
  WallContacts<dim>::add_shares(const View              &view,
                                double                  &left,
                                const std::vector<Wall> &walls,
                                const Of                &of)
  {
    std::vector<std::pair<double, Meeting>> all;
    double                                  sum = 0;
    for (const auto &wall : walls)
      {
        all.push_back(of(wall));
        sum += all.back().first;
      }
    const double share = sum > left ? left / sum : 1.;
    for (const auto &[area, meeting] : all)
      if (area > 0)
        add(view.axis, view.piece, share * area, meeting);
    left -= share * sum;
  }


  /// All walls of the half of a component behind an opening, also those along the plane.
  template <int dim>
  std::vector<typename WallContacts<dim>::Wall>
  WallContacts<dim>::walls_behind(const unsigned int                      axis,
                                  const typename FaceLinks<dim>::Opening &opening) const
  {
    std::vector<Wall> result;
    const int component = opening.component < 0 ? -1 : parts.cut_components[opening.component];
    if (component < 0)
      return result;
    const int cell = cut.components[component].cell;
    for (int f = cut.cells[cell].first_fragment; f < cut.end_fragment(cell); ++f)
      if (cut.fragments[f].component == component)
        result.push_back(meetings.wall(f, axis, cell, 1 - opening.half));
    return result;
  }


  template <int dim>
  void
  WallContacts<dim>::add_passages(const unsigned int axis)
  {
    const auto &divided = open.faces[axis];
    for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
      if (divided.kind(face) == SubLattice<dim>::Kind::divided &&
          divided.last(face) - divided.first(face) > 1)
        for (const unsigned int half : {0, 1})
          {
            std::map<int, std::vector<int>> of_component;
            for_each_part(divided, face, [&](const int part) {
              of_component[open.pieces[axis][part].components[half]].push_back(part);
            });
            for (const auto &[component, pieces] : of_component)
              if (component >= 0 && pieces.size() > 1)
                add_passages(axis, half, pieces);
          }
    });
  }


  /// Between pieces that bound one component: they lie one behind the other, as the body between
  /// them ends there, and what bounds the fluid of those on one side of a passage closes with it.
  template <int dim>
  void
  WallContacts<dim>::add_passages(const unsigned int axis,
                                  const unsigned int half,
                                  std::vector<int>   pieces)
  {
    const auto &all  = open.faces[axis].all();
    const auto  line = all[pieces.back()].place - all[pieces.front()].place;
    std::sort(pieces.begin(), pieces.end(), [&](const int a, const int b) {
      return line * (all[a].place - all[b].place) < 0;
    });
    dealii::Tensor<1, dim> sum;
    for (std::size_t k = 0; k + 1 < pieces.size(); ++k)
      {
        const auto   offset   = all[pieces[k + 1]].place - all[pieces[k]].place;
        const double distance = offset.norm();
        sum += boundary_area(axis, half, pieces[k]);
        if (const double area = -(sum * offset) / distance; distance > 0 && area > 0)
          {
            const auto &face = all[pieces[k]].index;
            surfaces.passages[axis].push_back({{{{face, pieces[k]}, {face, pieces[k + 1]}}},
                                               area,
                                               std::max(distance, least_distance_at(axis, face))});
          }
      }
  }


  /// Of the openings and walls of the fluid that moves with a piece, on one side of its face; out
  /// of the fluid, in the plane.
  template <int dim>
  dealii::Tensor<1, dim>
  WallContacts<dim>::boundary_area(const unsigned int axis,
                                   const unsigned int half,
                                   const int          piece) const
  {
    const FaceLinks<dim>   links(grid, axis, open, surfaces);
    const auto            &face      = open.faces[axis].all()[piece].index;
    const int              component = open.pieces[axis][piece].components[half];
    dealii::Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      for (const unsigned int end : {0, 1})
        if (const Side side{d, end}; d != axis)
          links.for_each_opening({face, piece}, side, [&](const auto &opening) {
            if (opening.half == half)
              result[d] += side.sign() * opening.area;
          });
    const int of_cut = parts.cut_components[component];
    const int cell   = of_cut < 0 ? -1 : cut.components[of_cut].cell;
    for (int f = cell < 0 ? 0 : cut.cells[cell].first_fragment;
         cell >= 0 && f < cut.end_fragment(cell);
         ++f)
      if (cut.fragments[f].component == of_cut)
        if (const auto found = meetings.wall(f, axis, cell, 1 - half);
            counts(found, axis, cell) &&
            piece_at(axis, face, half, component, found.centroid, found.area / found.area.norm()) ==
              piece)
          result += found.area;
    return result;
  }


  template class WallContacts<2>;
  template class WallContacts<3>;
} // namespace undine
