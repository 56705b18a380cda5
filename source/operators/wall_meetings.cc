// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/fragment_at_plane.h>
#include <undine/operators/mean_distance.h>
#include <undine/operators/wall_meetings.h>
#include <undine/surface/nearest_in_simplex.h>
#include <undine/surface/simplex.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    /// Areas below this share of a face are rounding.
    constexpr double negligible = 1e-9;

    /// Barycentric coordinates of extensions reach this far beyond the facet: what a small facet
    /// says of the velocity many of its lengths away is no more than its own noise.
    constexpr double reach = 2;


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


    /// The corners of a fragment on a plane, each once: two coincide where edges of surface and
    /// grid meet.
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
        if (corner[axis] == plane &&
            std::none_of(result.begin(), result.end(), [&](const auto &one) {
              return corner.distance(one) <= same * extent;
            }))
          result.push_back(corner);
      return result;
    }
  } // namespace


  template <int dim>
  WallMeetings<dim>::WallMeetings(const MacGrid<dim>        &grid,
                                  const CutCells<dim>       &cut,
                                  const CutTopology<dim>    &parts,
                                  const NoSlipSurfaces<dim> &surfaces,
                                  const PlacedSurface<dim>  &placed)
    : grid(grid)
    , cut(cut)
    , parts(parts)
    , open(*parts.open)
    , surfaces(surfaces)
    , placed(placed)
  {
  }


  template <int dim>
  FacetNodes<dim>
  WallMeetings<dim>::corners(const int facet) const
  {
    FacetNodes<dim> result;
    for (unsigned int k = 0; k < dim; ++k)
      result[k] = placed.positions[placed.surface.facets()[facet][k]];
    return result;
  }


  template <int dim>
  dealii::Tensor<1, dim>
  WallMeetings<dim>::unit_normal(const int facet) const
  {
    const auto normal = area_vector(corners(facet));
    return normal / std::max(normal.norm(), std::numeric_limits<double>::min());
  }


  template <int dim>
  dealii::Point<dim>
  WallMeetings<dim>::middle(const unsigned int axis, const FacePlace<dim> &place) const
  {
    auto result = place.part < 0 ? grid.faces(axis)->point(place.face)
                                 : open.faces[axis].all()[place.part].place;
    if (const auto *edge = surfaces.past_edge(axis, place))
      result += edge->shift;
    return result;
  }


  template <int dim>
  dealii::ArrayView<const dealii::Point<dim>>
  WallMeetings<dim>::corners_of_fragment(const int fragment) const
  {
    const int first = cut.corners.first[fragment];
    return {cut.corners.points.data() + first,
            static_cast<std::size_t>(cut.corners.first[fragment + 1] - first)};
  }


  /// What of a fragment is next to the face of its cell at `end`.
  template <int dim>
  typename WallMeetings<dim>::Wall
  WallMeetings<dim>::wall(const int          fragment,
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


  /// Is a facet parallel to the planes of an axis but for rounding? What of it lies in one is no
  /// chord.
  template <int dim>
  bool
  WallMeetings<dim>::is_along_plane(const int facet, const unsigned int axis) const
  {
    constexpr double rounding = 1e-9;
    return std::abs(unit_normal(facet)[axis]) >= 1 - rounding;
  }


  template <int dim>
  std::vector<typename WallMeetings<dim>::Chord>
  WallMeetings<dim>::chords(const unsigned int axis, const GridIndex<dim> &face) const
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


  /// The chord of a wall, or the nearest one of the smooth wall of its body that it belongs to,
  /// which faces the same side. One that a piece is not in front of bounds another piece.
  template <int dim>
  const typename WallMeetings<dim>::Chord *
  WallMeetings<dim>::chord_of(const View                   &view,
                              const Wall                   &wall,
                              const std::vector<Chord>     &chords,
                              const dealii::Tensor<1, dim> &facing) const
  {
    const auto   facet   = cut.fragments[wall.fragment].facet;
    const auto   of_wall = unit_normal(facet);
    const auto   centre  = middle(view.axis, view.piece);
    const Chord *result  = nullptr;
    double       least   = std::numeric_limits<double>::infinity();
    for (const auto &chord : chords)
      {
        if (chord.fragment == wall.fragment)
          return &chord;
        const double distance = chord.chord.middle.distance(wall.centroid);
        const auto   other    = cut.fragments[chord.fragment].facet;
        if (distance < least && chord.chord.normal * facing > 0 &&
            placed.surface.body(other) == placed.surface.body(facet) &&
            unit_normal(other) * of_wall >= smooth_wall &&
            (chord.chord.middle - centre) * chord.chord.normal > 0)
          {
            least  = distance;
            result = &chord;
          }
      }
    return result;
  }


  /// The wall acts where it meets the plane.
  template <int dim>
  typename WallMeetings<dim>::Meeting
  WallMeetings<dim>::at_chord(const View               &view,
                              const Chord              &chord,
                              const std::vector<Chord> &chords) const
  {
    const unsigned int facet    = cut.fragments[chord.fragment].facet;
    const auto         normal   = chord.chord.normal / chord.chord.normal.norm();
    const auto        *edge     = surfaces.past_edge(view.axis, view.piece);
    auto               distance = mean_distance_in_front(chord.chord, boundary(view, chords));
    if (distance && edge)
      *distance -= edge->shift * normal;
    return {{facet, nearest_point(corners(facet), chord.chord.middle)},
            distance.value_or((chord.chord.middle - middle(view.axis, view.piece)) * normal),
            true};
  }


  /// Of a piece, if it is the only one that bounds its component: chords and rims.
  template <int dim>
  std::vector<PlaneChord<dim>>
  WallMeetings<dim>::boundary(const View &view, const std::vector<Chord> &chords) const
  {
    const auto &[axis, piece, half] = view;
    std::vector<PlaneChord<dim>> result;
    const int component = piece.part < 0 ? -1 : open.pieces[axis][piece.part].components[half];
    int       n_pieces  = 0;
    for_each_part(open.faces[axis], piece.face, [&, half = half, axis = axis](const int part) {
      n_pieces += open.pieces[axis][part].components[half] == component;
    });
    if (component < 0 || n_pieces != 1)
      return result;
    for (const auto &chord : chords)
      if (parts.open_components[cut.fragments[chord.fragment].component] == component)
        result.push_back(chord.chord);
    for (unsigned int d = 0; d < dim; ++d)
      for (const unsigned int end : {0, 1})
        if (const auto &rim = surfaces.shapes[axis][piece.part].rims[2 * d + end]; rim.length > 0)
          {
            PlaneChord<dim> side;
            for (unsigned int along = 0; along < dim; ++along)
              side.middle[along] = rim.middle;
            side.middle[axis] = plane(axis, piece.face);
            side.middle[d]    = cut.block.planes().position(d, piece.face[d] + end);
            side.normal[d]    = end == 0 ? -rim.length : rim.length;
            result.push_back(side);
          }
    return result;
  }


  /// A place on the surface as seen from a piece.
  template <int dim>
  typename WallMeetings<dim>::Meeting
  WallMeetings<dim>::seen(const View                   &view,
                          const dealii::Tensor<1, dim> &normal,
                          const Spot                   &spot) const
  {
    const auto place = point_of<dim>(corners(spot.facet), spot.weights);
    return {spot, (place - middle(view.axis, view.piece)) * normal};
  }


  /// Where a wall, or the plane that extends its last facet, meets the plane of a face: along the
  /// surface, as far as the next cell. What is next to there if the surface turns away before.
  template <int dim>
  typename WallMeetings<dim>::Spot
  WallMeetings<dim>::extension(const View &view, const Wall &wall) const
  {
    constexpr int      most_steps = 4;
    constexpr double   rounding   = 1e-9;
    const unsigned int d          = main_direction<dim>(view.axis, wall.area);
    const Side         side{d, wall.area[d] > 0 ? 1u : 0u};
    const auto         normal = wall.area / wall.area.norm();
    const double       width  = grid.cell_width(d, view.piece.face[d]);
    const double       level  = plane(view.axis, view.piece.face);
    const auto         beyond = moved<dim>(view.piece.face, d, side.sign());
    auto               place  = wall.centroid;
    Spot               result{cut.fragments[wall.fragment].facet, {}};
    result.weights      = nearest_point(corners(result.facet), place);
    const double facing = unit_normal(result.facet) * normal > 0 ? 1 : -1; // not beyond a pole
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
        const auto   goes_on  = [&](const unsigned int facet) {
          const auto of_next = unit_normal(facet);
          return placed.surface.body(facet) == placed.surface.body(result.facet) &&
                 of_next * of_facet >= smooth_wall && facing * (of_next * normal) >= -rounding;
        };
        const auto near = nearest_spot(there, beyond, view.axis, side, goes_on);
        if (!near)
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
  typename WallMeetings<dim>::Meeting
  WallMeetings<dim>::meeting(const View               &view,
                             const Wall               &wall,
                             const std::vector<Chord> &chords) const
  {
    const auto *chord = chord_of(view, wall, chords, wall.area);
    return chord ? at_chord(view, *chord, chords)
                 : seen(view, wall.area / wall.area.norm(), extension(view, wall));
  }


  /// Of the facets in the cells around the side of a face that count, if there are any.
  template <int dim>
  std::optional<typename WallMeetings<dim>::Spot>
  WallMeetings<dim>::nearest_spot(const dealii::Point<dim>                &place,
                                  const GridIndex<dim>                    &face,
                                  const unsigned int                       axis,
                                  const Side                              &side,
                                  const std::function<bool(unsigned int)> &counts) const
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
              // What only touches a plane is in one cell or the other by chance.
              if (!(cut.fragments[f].area_vector.norm() >
                    negligible * cut.block.face_area(axis, cell)))
                continue;
              const unsigned int facet = cut.fragments[f].facet;
              if (counts && !counts(facet))
                continue;
              const auto   weights  = nearest_point(corners(facet), place);
              const double distance = place.distance(point_of<dim>(corners(facet), weights));
              if (distance < least)
                {
                  least  = distance;
                  result = Spot{facet, weights};
                }
            }
        }
    return result;
  }


  template class WallMeetings<2>;
  template class WallMeetings<3>;
} // namespace undine
