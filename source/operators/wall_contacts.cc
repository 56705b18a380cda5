// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/fragment_half.h>
#include <undine/operators/wall_contacts.h>
#include <undine/surface/nearest_in_simplex.h>
#include <undine/surface/simplex.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace undine
{
  namespace
  {
    /// Contacts nearer than this share of a cell's width count as if they were that far away: at
    /// that distance fluid already moves with the wall, and the equations stay well conditioned.
    constexpr double least_distance = 0.01;

    /// Areas below this share of a face are rounding.
    constexpr double negligible_area = 1e-9;

    /// Facets whose normals have at least this cosine belong to one smooth wall.
    constexpr double smooth = 0.7;

    /// Barycentric coordinates of extensions reach this far beyond the facet: what a small facet
    /// says of the velocity many of its lengths away is no more than its own noise.
    constexpr double reach = 2;


    /// Along which a vector in a plane is longest.
    template <int dim>
    unsigned int
    main_direction(const unsigned int axis, const dealii::Tensor<1, dim> &vector)
    {
      unsigned int result = axis == 0 ? 1 : 0;
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(vector[d]) > std::abs(vector[result]))
          result = d;
      return result;
    }


    template <int dim>
    dealii::Point<dim>
    point_of(const FacetNodes<dim> &nodes, const std::array<double, dim> &weights)
    {
      dealii::Point<dim> result;
      for (unsigned int k = 0; k < dim; ++k)
        result += weights[k] * nodes[k];
      return result;
    }


    /// The barycentric coordinates of a place in the plane of a facet.
    template <int dim>
    std::array<double, dim>
    weights_in_plane(const FacetNodes<dim> &nodes, const dealii::Point<dim> &place)
    {
      const auto              inverse = inverse_of_products<dim>(dim, nodes);
      const auto              segment = place - nodes[0];
      std::array<double, dim> weights{};
      weights[0] = 1;
      for (unsigned int a = 0; a + 1 < dim; ++a)
        for (unsigned int b = 0; b + 1 < dim; ++b)
          {
            const double share = inverse[a][b] * ((nodes[b + 1] - nodes[0]) * segment);
            weights[a + 1] += share;
            weights[0] -= share;
          }
      return weights;
    }
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
  {
  }


  template <int dim>
  void
  WallContacts<dim>::add_of_faces(const unsigned int axis)
  {
    const auto &owned = grid.faces(axis)->owned();
    for (int cell = 0; cell < static_cast<int>(cut.cells.size()); ++cell)
      for (const unsigned int end : {0, 1})
        if (owned.contains(moved<dim>(cut.cells[cell].index, axis, end)))
          add_walls(axis, cell, end);
    add_closed_openings(axis);
    add_passages(axis);
  }


  template <int dim>
  FacetNodes<dim>
  WallContacts<dim>::corners(const int facet) const
  {
    FacetNodes<dim> result;
    for (unsigned int k = 0; k < dim; ++k)
      result[k] = placed.positions[placed.surface.facets()[facet][k]];
    return result;
  }


  template <int dim>
  dealii::Tensor<1, dim>
  WallContacts<dim>::unit_normal(const int facet) const
  {
    const auto normal = area_vector(corners(facet));
    return normal / std::max(normal.norm(), std::numeric_limits<double>::min());
  }


  template <int dim>
  dealii::Point<dim>
  WallContacts<dim>::centroid(const unsigned int axis, const FacePlace<dim> &place) const
  {
    return place.part < 0 ? grid.faces(axis)->point(place.face)
                          : open.faces[axis].all()[place.part].place;
  }


  template <int dim>
  dealii::ArrayView<const dealii::Point<dim>>
  WallContacts<dim>::corners_of_fragment(const int fragment) const
  {
    const int first = cut.corners.first[fragment];
    return {cut.corners.points.data() + first,
            static_cast<std::size_t>(cut.corners.first[fragment + 1] - first)};
  }


  template <int dim>
  void
  WallContacts<dim>::add(const unsigned int    axis,
                         const FacePlace<dim> &place,
                         const double          area,
                         const Meeting        &meeting)
  {
    double width = std::numeric_limits<double>::infinity();
    for (unsigned int d = 0; d < dim; ++d)
      if (d != axis)
        width = std::min(width, grid.cell_width(d, place.face[d]));
    surfaces.contacts[axis].push_back({place,
                                       area,
                                       std::max(meeting.distance, least_distance * width),
                                       placed.surface.facets()[meeting.spot.facet],
                                       meeting.spot.weights});
  }


  /// The walls in the half of a cell next to its face at `end`.
  template <int dim>
  void
  WallContacts<dim>::add_walls(const unsigned int axis, const int cell, const unsigned int end)
  {
    const auto face  = moved<dim>(cut.cells[cell].index, axis, end);
    const auto lines = chords(axis, face);
    Screened   screened;
    for (int f = cut.cells[cell].first_fragment; f < cut.end_fragment(cell); ++f)
      if (const auto found = wall(f, axis, cell, end); is_wet(f) && counts(found, axis, cell))
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
          auto         meeting = this->meeting(view, found, lines);
          const double own     = share_of(view, found, meeting) * area;
          const double beyond  = add_to_neighbour(view, found, area - own, screened);
          if (own > 0)
            add(axis, view.piece, own, meeting);
          meeting.distance = std::max(meeting.distance, least_of_extensions(view, found));
          if (const double left = area - own - beyond; left > negligible_area * area)
            add(axis, view.piece, left, meeting);
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


  /// Half the width of the cell.
  template <int dim>
  double
  WallContacts<dim>::least_of_extensions(const View &view, const Wall &wall) const
  {
    const unsigned int d = main_direction(view.axis, wall.area);
    return grid.cell_width(d, view.piece.face[d]) / 2;
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
    const FaceLinks<dim> links(grid, view.axis, open, surfaces.shapes);
    const unsigned int   d = main_direction(view.axis, wall.area);
    const Side           side{d, wall.area[d] > 0 ? 0u : 1u};
    const double         projection = std::abs(wall.area[d]) / wall.area.norm();
    double               result     = 0;
    links.for_each_opening(view.piece, side, [&](const auto &opening) {
      if (result == area || opening.half != view.half || !opening.neighbour)
        return;
      const auto  &beyond  = *opening.neighbour;
      auto        &sum     = screened[{view.piece.part, beyond.face, beyond.part}];
      const double part    = std::min(area - result, opening.area / projection - sum);
      const auto   meeting = this->meeting({view.axis, beyond, view.half}, wall, {});
      if (!(part > 0) || !(meeting.distance > 0))
        return;
      result += part;
      sum += part;
      add(view.axis, beyond, part, meeting);
      surfaces.passages[view.axis].push_back(
        {{{view.piece, beyond}}, -projection * part, links.distance(view.piece, beyond, d)});
    });
    return result;
  }


  /// What of a fragment is next to the face of its cell at `end`.
  template <int dim>
  typename WallContacts<dim>::Wall
  WallContacts<dim>::wall(const int          fragment,
                          const unsigned int axis,
                          const int          cell,
                          const unsigned int end) const
  {
    const auto  &index  = cut.cells[cell].index;
    const double middle = cut.block.planes().position(axis, index[axis]) +
                          cut.block.planes().width(axis, index[axis]) / 2;
    const auto half = half_of_fragment(corners_of_fragment(fragment), axis, middle, end == 1);
    Wall       result{fragment, half.share * cut.fragments[fragment].area_vector, 0, half.centroid};
    result.size       = result.area.norm();
    result.area[axis] = 0;
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


  /// The corners of a fragment on a plane, each once: two coincide where edges of surface and grid
  /// meet.
  template <int dim>
  std::vector<dealii::Point<dim>>
  corners_on_plane(const dealii::ArrayView<const dealii::Point<dim>> &corners,
                   const unsigned int                                 axis,
                   const double                                       plane)
  {
    constexpr double                same = 1e-9; // in units of the facet's extent in the cell
    std::vector<dealii::Point<dim>> result;
    double                          extent = 0;
    for (const auto &corner : corners)
      extent = std::max(extent, corner.distance(corners[0]));
    for (const auto &corner : corners)
      if (corner[axis] == plane && std::none_of(result.begin(), result.end(), [&](const auto &one) {
            return corner.distance(one) <= same * extent;
          }))
        result.push_back(corner);
    return result;
  }


  /// Is a facet parallel to the planes of an axis but for rounding? What of it lies in one is no
  /// chord.
  template <int dim>
  bool
  WallContacts<dim>::is_along_plane(const int facet, const unsigned int axis) const
  {
    constexpr double rounding = 1e-9;
    return std::abs(unit_normal(facet)[axis]) >= 1 - rounding;
  }


  template <int dim>
  std::vector<typename WallContacts<dim>::Chord>
  WallContacts<dim>::chords(const unsigned int axis, const GridIndex<dim> &face) const
  {
    std::vector<Chord> result;
    for (const int below : {-1, 0})
      {
        const auto index = moved<dim>(face, axis, below);
        const int  cell  = cut.block.cells().contains(index) ? cut.cut_cell(index) : -1;
        for (int f = cell < 0 ? 0 : cut.cells[cell].first_fragment;
             cell >= 0 && f < cut.end_fragment(cell);
             ++f)
          if (const auto &fragment = cut.fragments[f];
              fragment.component >= 0 && !is_along_plane(fragment.facet, axis))
            if (const auto ends =
                  corners_on_plane<dim>(corners_of_fragment(f), axis, plane(axis, face));
                ends.size() == dim - 1)
              if (const auto chord = plane_chord(ends, axis, fragment.area_vector);
                  chord.normal.norm() > 0)
                result.push_back({f, chord});
      }
    return result;
  }


  /// The chord of a wall, or the nearest one of the smooth wall that it belongs to, which faces the
  /// same side.
  template <int dim>
  const typename WallContacts<dim>::Chord *
  WallContacts<dim>::chord_of(const Wall                   &wall,
                              const std::vector<Chord>     &chords,
                              const dealii::Tensor<1, dim> &facing) const
  {
    const auto   of_wall = unit_normal(cut.fragments[wall.fragment].facet);
    const Chord *result  = nullptr;
    double       least   = std::numeric_limits<double>::infinity();
    for (const auto &chord : chords)
      {
        if (chord.fragment == wall.fragment)
          return &chord;
        const double distance = chord.chord.middle.distance(wall.centroid);
        if (distance < least && chord.chord.normal * facing > 0 &&
            unit_normal(cut.fragments[chord.fragment].facet) * of_wall >= smooth)
          {
            least  = distance;
            result = &chord;
          }
      }
    return result;
  }


  /// The wall acts where it meets the plane.
  template <int dim>
  typename WallContacts<dim>::Meeting
  WallContacts<dim>::at_chord(const View &view, const Chord &chord) const
  {
    const unsigned int facet  = cut.fragments[chord.fragment].facet;
    const auto         normal = chord.chord.normal / chord.chord.normal.norm();
    Meeting            result{{facet, nearest_point(corners(facet), chord.chord.middle)}, 0};
    result.offset   = chord.chord.middle - centroid(view.axis, view.piece);
    result.distance = result.offset * normal;
    result.is_chord = true;
    return result;
  }


  /// A place on the surface as seen from a piece.
  template <int dim>
  typename WallContacts<dim>::Meeting
  WallContacts<dim>::seen(const View                   &view,
                          const dealii::Tensor<1, dim> &normal,
                          const Spot                   &spot) const
  {
    Meeting result{
      spot, 0, point_of<dim>(corners(spot.facet), spot.weights) - centroid(view.axis, view.piece)};
    result.offset[view.axis] = 0;
    result.distance          = result.offset * normal;
    return result;
  }


  /// Where a wall, or the plane that extends its last facet, meets the plane of a face: along the
  /// surface, as far as the next cell. What is next to there if the surface turns away before.
  template <int dim>
  typename WallContacts<dim>::Spot
  WallContacts<dim>::extension(const View &view, const Wall &wall) const
  {
    constexpr int      most_steps = 4;
    const unsigned int d          = main_direction(view.axis, wall.area);
    const Side         side{d, wall.area[d] > 0 ? 1u : 0u};
    const auto         normal = wall.area / wall.area.norm();
    const double       width  = grid.cell_width(d, view.piece.face[d]);
    const double       level  = plane(view.axis, view.piece.face);
    const auto         beyond = moved<dim>(view.piece.face, d, side.sign());
    auto               place  = wall.centroid;
    Spot               result{cut.fragments[wall.fragment].facet, {}};
    result.weights = nearest_point(corners(result.facet), place);
    for (int step = 0; step < most_steps; ++step)
      {
        const auto of_facet = unit_normal(result.facet);
        auto       along    = -of_facet[view.axis] * of_facet;
        along[view.axis] += 1;
        if (along[view.axis] <= 0)
          break;
        along *= (level - place[view.axis]) / along[view.axis];
        const auto weights = weights_in_plane<dim>(corners(result.facet), place + along);
        if (*std::min_element(weights.begin(), weights.end()) >= -reach)
          return {result.facet, weights};
        const double distance = std::abs(along * normal);
        const auto   there    = place + (distance > width ? width / distance : 1.) * along;
        const auto   near     = nearest_spot(there, beyond, view.axis, side);
        if (!near || unit_normal(near->facet) * of_facet < smooth)
          {
            result.weights = nearest_point(corners(result.facet), there);
            break;
          }
        result = *near;
        place  = point_of<dim>(corners(result.facet), result.weights);
      }
    return result;
  }


  template <int dim>
  typename WallContacts<dim>::Meeting
  WallContacts<dim>::meeting(const View               &view,
                             const Wall               &wall,
                             const std::vector<Chord> &chords) const
  {
    const auto *chord = chord_of(wall, chords, wall.area);
    return chord ? at_chord(view, *chord)
                 : seen(view, wall.area / wall.area.norm(), extension(view, wall));
  }


  template <int dim>
  void
  WallContacts<dim>::add_closed_openings(const unsigned int axis)
  {
    const FaceLinks<dim> links(grid, axis, open, surfaces.shapes);
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
    const auto lines = chords(axis, piece.face);
    double     left  = opening.area;
    for (const auto &wall : walls)
      if (const auto *line = chord_of(wall, lines, outward))
        if (const double part = std::min(left, wall.size); part > 0)
          {
            add(axis, piece, part, at_chord(view, *line));
            left -= part;
          }
    const auto closed   = moved<dim>(piece.face, side.axis, side.sign());
    auto       stuck    = centroid(axis, piece);
    const auto from     = stuck[side.axis];
    stuck[side.axis]    = grid.faces(axis)->point(closed)[side.axis];
    const double middle = std::abs(stuck[side.axis] - from);
    for (const auto &wall : walls)
      if (const double facing = side.sign() * wall.area[side.axis]; facing > 0)
        {
          const auto   meeting = this->meeting(view, wall, {});
          const double part    = std::min(left, facing * share_of(view, wall, meeting));
          if (part > 0 && meeting.distance < middle)
            {
              add(axis, piece, part, meeting);
              left -= part;
            }
        }
    if (left > negligible_area * opening.area)
      if (const auto spot = nearest_spot(stuck, closed, axis, side))
        add(axis, piece, left, {*spot, middle});
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
        result.push_back(wall(f, axis, cell, 1 - opening.half));
    return result;
  }


  /// Of the facets in the cells around the side of a face, if there are any.
  template <int dim>
  std::optional<typename WallContacts<dim>::Spot>
  WallContacts<dim>::nearest_spot(const dealii::Point<dim> &place,
                                  const GridIndex<dim>     &face,
                                  const unsigned int        axis,
                                  const Side               &side) const
  {
    std::optional<Spot> result;
    double              least = std::numeric_limits<double>::infinity();
    for (const int below : {-1, 0})
      for (const int before : {0, -side.sign()})
        {
          const auto cell = moved<dim>(moved<dim>(face, axis, below), side.axis, before);
          const int  slot = cut.block.cells().contains(cell) ? cut.cut_cell(cell) : -1;
          for (int f = slot < 0 ? 0 : cut.cells[slot].first_fragment;
               slot >= 0 && f < cut.end_fragment(slot);
               ++f)
            {
              const unsigned int facet    = cut.fragments[f].facet;
              const auto         weights  = nearest_point(corners(facet), place);
              const double       distance = place.distance(point_of<dim>(corners(facet), weights));
              if (distance < least)
                {
                  least  = distance;
                  result = Spot{facet, weights};
                }
            }
        }
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
            surfaces.passages[axis].push_back(
              {{{{face, pieces[k]}, {face, pieces[k + 1]}}}, area, distance});
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
    const FaceLinks<dim>   links(grid, axis, open, surfaces.shapes);
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
        if (const auto found = wall(f, axis, cell, 1 - half);
            counts(found, axis, cell) &&
            piece_at(axis, face, half, component, found.centroid, found.area / found.area.norm()) ==
              piece)
          result += found.area;
    return result;
  }


  template class WallContacts<2>;
  template class WallContacts<3>;
} // namespace undine
